#pragma once

#include <optional>

#include "meniscus/flow/fem/options.hpp"
#include "meniscus/flow/fem/stokes_problem.hpp"
#include "meniscus/flow/flow_solver.hpp"

namespace meniscus::fem {

/// The problem's coefficients and forces; tractions and buoyancy apart, as their power is paid for
/// outside.
struct InstantProblem {
  StokesProblem stokes;
  Field<NodeId, Vec3> traction;
  std::optional<Fault> fault = {};
};

/// The problem of a domain at time t, with the inertia of its stage if it has one.
[[nodiscard]] InstantProblem instant_problem(const FlowDomain& domain, const FlowSpace& space,
                                             NodePositions positions, CapillaryForm form, double t);

/// A stage of liquids at rest, for its matrix alone.
[[nodiscard]] ImplicitStage stage_at_rest(const Scene& scene, double duration,
                                          const Field<NodeId, Vec3>& x);
/// The domain in that stage.
[[nodiscard]] FlowDomain with_stage(const FlowDomain& domain, const ImplicitStage& stage);

}  // namespace meniscus::fem
