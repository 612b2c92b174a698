#pragma once

#include "meniscus/core/fault.hpp"
#include "meniscus/flow/scalar_solver.hpp"
#include "meniscus/transport/bulk/transport_matrices.hpp"

namespace meniscus::bulk {

/// The heat of viscous dissipation, 2μ D:D [μ_out G² R0³].
struct DissipatedHeat {
  std::vector<double> by_node;    ///< ∫2μ D:D φ_i
  std::vector<double> by_region;  ///< ∫2μ D:D
};
/// The viscosity is that at the values of the scalars.
[[nodiscard]] DissipatedHeat dissipated_heat(const Scene& scene, const TetMesh& mesh,
                                             const ScalarSpace& space,
                                             const NodePositions& positions,
                                             const Field<NodeId, Vec3>& v,
                                             const BulkScalars& scalars);

/// What moves a scalar through one step.
struct ScalarMotion {
  const Scene& start;
  const Scene& end;
  const TetMesh& mesh;  ///< any of the two: only its connectivity counts
  const ScalarSpace& space;
  const NodePositions& at_start;
  const NodePositions& at_end;
  const MassMatrix& mass_at_start;  ///< of the scalar
  const MassMatrix& mass_at_end;
  const Field<NodeId, Vec3>& v;  ///< of the liquid, at the nodes [G R0]
  const DissipatedHeat& heat;    ///< empty where no scalar takes it
  double duration;
  std::span<const VertexField<double>> expected_adsorption = {};  ///< as in `ScalarPath`
};

/// Takes scalar number `k` of the scene through one step, L-stable and of second order
/// (alexander1977, two stages). Finite elements are upstream weighted as a whole (SUPG). The mass
/// matrix is taken to change linearly. Amounts change by boundaries, sources and interfaces alone;
/// a constant stays.
ScalarAdvance convect(const ScalarMotion& motion, std::size_t k, BulkScalar& scalar);
/// Solves ∇·(k∇T) = 0 for scalar k, at Pe = 0; `heat` is Pe q + Br 2μ D:D, by node ∫φ_i.
Report conduct(const Scene& scene, const TetMesh& mesh, const ScalarSpace& space,
               const NodePositions& positions, std::size_t k, std::span<const double> heat,
               BulkScalar& scalar);
/// γ of scalar k by region.
[[nodiscard]] std::vector<double> capacities(const Scene& scene, std::size_t k);

}  // namespace meniscus::bulk
