#pragma once

#include <span>
#include <string_view>

namespace meniscus {

/// A case file of examples/, embedded in the program. Some have a script that makes their surface.
struct ExampleCase {
  std::string_view name;  ///< "shear-subcritical": the file's name without .toml
  std::string_view text;
  std::string_view script = {};  ///< Python; the example's name with .py
};
[[nodiscard]] std::span<const ExampleCase> examples();
/// Throws InvalidInput listing the names when there is no such example.
[[nodiscard]] const ExampleCase& example(std::string_view name);

}  // namespace meniscus
