#pragma once

#include <string>
#include <string_view>

namespace meniscus::report {

/// A page without outside references around its `content`: head, styles and, where the program was
/// built with it, the script that makes the page move. `data` are the elements the script reads; a
/// page that asks the server it came from for news says so with `is_live`.
struct PageParts {
  std::string title, content, data;
  bool is_live = false;
};
[[nodiscard]] std::string whole_page(const PageParts& parts);

}  // namespace meniscus::report
