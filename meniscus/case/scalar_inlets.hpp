#pragma once

#include "meniscus/case/case.hpp"

namespace meniscus {

/// Throws InvalidInput, naming the line of the scalar and the patch. It does so where the imposed
/// velocity carries liquid in at t = 0 and a convected scalar has no value. Liquid that enters
/// later, by a schedule or an open patch, is not looked for.
void require_values_at_inlets(const Case& c, const OuterBoundary& boundary);

}  // namespace meniscus
