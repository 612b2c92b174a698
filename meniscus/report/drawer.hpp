#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "meniscus/report/page_data.hpp"
#include "meniscus/report/program.hpp"

namespace meniscus::report {

/// A picture as the text of an .svg file.
struct Picture {
  std::string name, svg;
};

/// The page's drawing code (web/src/drawer.js), run by node: one start for all pictures of a
/// command.
class Drawer {
 public:
  /// Starts to draw pictures of the data: some of interface, deformation, mesh and history, or a
  /// film. Throws InvalidInput, beginning with `purpose`, where node is missing or the program was
  /// built without it.
  Drawer(std::string_view purpose, const DrawingData& data,
         const std::vector<std::string>& pictures);

  /// The next picture; nothing after the last. Pictures that the data have nothing for are left
  /// out. Throws RunFailure when drawing fails.
  [[nodiscard]] std::optional<Picture> next();

 private:
  Program node_;
};

}  // namespace meniscus::report
