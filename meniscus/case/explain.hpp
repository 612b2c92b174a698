#pragma once

#include <string>
#include <string_view>

namespace meniscus {

/// Explains a key or table of the case file: sentence, type, unit, range or words, default. Takes
/// "drop.nodes", "drop[0].nodes", a bare "nodes" (all keys of that name) or a table "drop". Throws
/// InvalidInput with the nearest key for anything else.
[[nodiscard]] std::string explain(std::string_view key);
/// Lists all keys of the case file by table, one line each.
[[nodiscard]] std::string explain();
/// The reference page docs/case-file.md.
[[nodiscard]] std::string reference_page();

}  // namespace meniscus
