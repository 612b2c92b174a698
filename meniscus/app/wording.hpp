#pragma once

#include <string>

#include "meniscus/evolve/notices.hpp"

namespace meniscus {

/// A notice as a line of run.json's list of warnings.
[[nodiscard]] std::string text_of(const Notice& notice);
/// A topology event at time t as a line of the log.
[[nodiscard]] std::string text_of(const TopologyEvent& event, double t);

/// Logs the excess of carried fields over their range whenever it reaches another power of two.
/// Excesses below the round-off of values of order one are not logged.
void log_growth(const FieldExcess& before, const FieldExcess& now, double t);

/// Writes a notice to the log, unless another part of the program has logged it.
void log_notice(const Notice& notice);

}  // namespace meniscus
