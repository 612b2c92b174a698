#pragma once

#include "meniscus/flow/fem/stokes_problem.hpp"
#include "meniscus/flow/flow_solver.hpp"

namespace meniscus::fem {

/// The factor exp(−Σ exponent (T − reference)) of the viscosity in every cell, by the scalars'
/// means over straight cells; of second order.
[[nodiscard]] CellField<double> viscosity_factors(const Scene& scene, const TetMesh& mesh,
                                                  const FlowSpace& space,
                                                  const BulkScalars& scalars);
[[nodiscard]] bool has_varying_viscosity(const Scene& scene);
/// The least viscosity of the cells of each region [μ_out].
[[nodiscard]] std::vector<double> least_viscosities(const StokesProblem& problem);
/// Adds the body force Σ buoyancy (T − reference): in the mean of every cell to linear elements, as
/// ∫f·φ_i to `force` of quadratic ones.
void add_buoyancy(const Scene& scene, const BulkScalars& scalars, StokesProblem& problem,
                  Field<NodeId, Vec3>& force);

}  // namespace meniscus::fem
