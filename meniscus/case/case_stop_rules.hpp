#pragma once

#include "meniscus/case/case.hpp"
#include "meniscus/evolve/stop_rules.hpp"

namespace meniscus {

/// When a run of the case ends before its end time.
[[nodiscard]] StopRules stop_rules_of(const Case& c);

/// Reads [time.stop-when]. Rules that a case does not give leave no trace in its settings.
StopRules read_stop_rules(Settings& settings, const DomainCase& domain);

}  // namespace meniscus
