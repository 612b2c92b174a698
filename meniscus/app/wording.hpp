#pragma once

#include <string>

#include "meniscus/evolve/notices.hpp"

namespace meniscus {

/// A notice as a line of run.json's list of warnings.
[[nodiscard]] std::string text_of(const Notice& notice);
/// A change of topology at time t, for the log.
[[nodiscard]] std::string text_of(const TopologyEvent& event, double t);

/// Logs the excess of carried fields over their range when it has come to another power of two.
/// What is below the least size is round-off of values of order one.
void log_growth(const FieldExcess& before, const FieldExcess& now, double t);

/// Writes a notice to the log, where no other part of the program has.
void log_notice(const Notice& notice);

}  // namespace meniscus
