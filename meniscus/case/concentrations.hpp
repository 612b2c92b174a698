#pragma once

#include "meniscus/case/case.hpp"

namespace meniscus {

/// Throws InvalidInput where a concentration is negative in the case's scene; names line, key,
/// value, place. It judges the linear parts of species' initial profiles and of values on patches.
void require_concentrations(const Case& c, const Scene& scene);

}  // namespace meniscus
