#pragma once

#include <memory>

#include "meniscus/flow/fem/options.hpp"
#include "meniscus/flow/flow_solver.hpp"

namespace meniscus::fem {

/// Two-phase Stokes flow by finite elements on a conforming tetrahedral mesh, pressure doubled on
/// the interfaces. They are P1–P1 with PSPG stabilisation (appendix of hooper2001), or P2–P1
/// (Taylor–Hood), curved at curved surfaces.
[[nodiscard]] std::unique_ptr<FlowSolver> make_finite_element_flow(const Options& options);

}  // namespace meniscus::fem
