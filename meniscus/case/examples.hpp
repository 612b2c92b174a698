#pragma once

#include <span>
#include <string_view>

namespace meniscus {

/// A case file of examples/, embedded in the program.
struct ExampleCase {
  std::string_view name;  ///< "shear-subcritical": the file's name without .toml
  std::string_view text;
};
[[nodiscard]] std::span<const ExampleCase> examples();
/// The text of an example. Throws InvalidInput listing the names when there is no such example.
[[nodiscard]] std::string_view example_text(std::string_view name);

}  // namespace meniscus
