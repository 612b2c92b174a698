#pragma once

#include <string_view>

namespace meniscus::report {

/// The bundled script of the page and its style sheet, built from `web/`. Both are empty in a
/// program that was built without node and npm.
[[nodiscard]] std::string_view page_script();
[[nodiscard]] std::string_view page_sheet();
[[nodiscard]] inline bool has_page_bundle() { return !page_script().empty(); }

}  // namespace meniscus::report
