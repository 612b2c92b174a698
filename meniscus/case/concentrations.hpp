#pragma once

#include "meniscus/case/case.hpp"

namespace meniscus {

/// Throws InvalidInput, naming line, key, value and place, where the linear part of a species'
/// initial profile, or of the values on a patch, is a negative concentration in the case's scene.
void require_concentrations(const Case& c, const Scene& scene);

}  // namespace meniscus
