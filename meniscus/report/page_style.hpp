#pragma once

#include <string_view>

namespace meniscus::report {

/// The style sheet of the page around the pictures: light, dark, narrow and on paper.
[[nodiscard]] std::string_view page_style();

}  // namespace meniscus::report
