#pragma once

#include <string>
#include <string_view>

namespace meniscus::report {

/// What a page says of the units of its runs.
enum class PageUnits { of_rate, at_rest, both };

/// The parts of a page without outside references. The page adds head, styles and, where the
/// program was built with it, the interactive script. `data` holds the elements that the script
/// reads. A page with `is_live` asks its server for news.
struct PageParts {
  std::string title, content, data;
  bool is_live = false;
  PageUnits units = PageUnits::of_rate;
};
[[nodiscard]] std::string whole_page(const PageParts& parts);

}  // namespace meniscus::report
