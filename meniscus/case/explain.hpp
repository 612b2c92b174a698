#pragma once

#include <string>
#include <string_view>

namespace meniscus {

/// What a key or table of the case file means: sentence, type, unit, range or words, default.
/// Takes "drop.nodes", "drop[0].nodes", a bare "nodes" (all keys of that name) or a table "drop".
/// Throws InvalidInput with the nearest key for any other.
[[nodiscard]] std::string explain(std::string_view key);
/// One line for each key of the case file, by tables.
[[nodiscard]] std::string explain();
/// The reference page docs/case-file.md.
[[nodiscard]] std::string reference_page();

}  // namespace meniscus
