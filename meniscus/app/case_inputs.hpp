#pragma once

#include <map>
#include <string>

#include "meniscus/case/case.hpp"

namespace meniscus {

/// Checksums of the files that a case reads its shapes from, by the keys that name them:
/// drop[i].surface, drop[i].from-run (that run's newest checkpoint), domain.surface. A file that
/// cannot be read has none.
[[nodiscard]] std::map<std::string, std::string> case_inputs(const Case& c);

}  // namespace meniscus
