#pragma once

#include <string_view>

namespace meniscus::report {

// What cmake/PageBundle.cmake makes of web/src; empty where node or npm was not found.

/// The page's script and style sheet, for a browser.
[[nodiscard]] std::string_view page_script();
[[nodiscard]] std::string_view page_sheet();
/// The same drawing code for node (web/src/drawer.js).
[[nodiscard]] std::string_view drawer_script();
[[nodiscard]] inline bool has_page_bundle() { return !page_script().empty(); }

}  // namespace meniscus::report
