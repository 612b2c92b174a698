#pragma once

#include <memory>

#include "meniscus/flow/bem/options.hpp"
#include "meniscus/flow/flow_solver.hpp"

namespace meniscus::bem {

/// Stokes flow around and inside the drops of an unbounded scene from integrals over their
/// interfaces alone (rallison1978; pozrikidis1992, chapter 5). Viscosities, body forces and nesting
/// are free, the imposed flow is v = G(t)·x. The equation is that of `integral_equation.hpp`. A
/// scene that is not unbounded is refused by `rebuild`. There is no volume mesh to move.
[[nodiscard]] std::unique_ptr<FlowSolver> make_boundary_integral_flow(const Options& options);

}  // namespace meniscus::bem
