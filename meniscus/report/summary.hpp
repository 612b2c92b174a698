#pragma once

#include <string>

#include "meniscus/report/run_data.hpp"

namespace meniscus::report {

// The text parts of the page as HTML; empty when the run has no data for them.

/// Title, status, flow, and faults.
[[nodiscard]] std::string heading_html(const RunData& run);
/// The final values in large digits.
[[nodiscard]] std::string tiles_html(const RunData& run);
/// The table of drops at the end of the run.
[[nodiscard]] std::string drops_html(const RunData& run);
/// What ran, where and when.
[[nodiscard]] std::string facts_html(const RunData& run);
/// Wall time by phase, with bars.
[[nodiscard]] std::string phases_html(const RunData& run);
/// The case file and the case with all its defaults, folded up.
[[nodiscard]] std::string case_html(const RunData& run);

}  // namespace meniscus::report
