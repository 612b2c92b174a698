#pragma once

#include <memory>

#include "meniscus/flow/fem/options.hpp"
#include "meniscus/flow/flow_solver.hpp"

namespace meniscus::fem {

/// Two-phase Stokes flow by P1–P1 PSPG finite elements on a conforming tetrahedral mesh, pressure
/// doubled on the interfaces (appendix of hooper2001).
[[nodiscard]] std::unique_ptr<FlowSolver> make_finite_element_flow(const Options& options);

}  // namespace meniscus::fem
