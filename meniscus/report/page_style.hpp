#pragma once

#include <string_view>

namespace meniscus::report {

/// The style sheet of the page outside the pictures, for light, dark and narrow screens and for
/// paper.
[[nodiscard]] std::string_view page_style();

}  // namespace meniscus::report
