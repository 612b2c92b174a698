#pragma once

#include <string>
#include <string_view>

namespace meniscus::report {

/// The parts of a page without outside references. The page adds head, styles and, where the
/// program was built with it, the interactive script. `data` holds the elements that the script
/// reads. A page with `is_live` asks its server for news.
struct PageParts {
  std::string title, content, data;
  bool is_live = false;
};
[[nodiscard]] std::string whole_page(const PageParts& parts);

}  // namespace meniscus::report
