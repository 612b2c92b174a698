#pragma once

#include <string>

#include "meniscus/report/run_data.hpp"

namespace meniscus::report {

// Parts of the page that are text, each as HTML; empty when the run has nothing for them.

/// Title, status, what flows, and what went wrong.
[[nodiscard]] std::string heading_html(const RunData& run);
/// The last values in large figures.
[[nodiscard]] std::string tiles_html(const RunData& run);
/// Each drop at the end of the run.
[[nodiscard]] std::string drops_html(const RunData& run);
/// What ran, where and when.
[[nodiscard]] std::string facts_html(const RunData& run);
/// Wall time by phase, with bars.
[[nodiscard]] std::string phases_html(const RunData& run);
/// The case file and the case with all its defaults, folded up.
[[nodiscard]] std::string case_html(const RunData& run);

}  // namespace meniscus::report
