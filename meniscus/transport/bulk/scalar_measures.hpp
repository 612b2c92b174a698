#pragma once

#include "meniscus/flow/scalar_solver.hpp"
#include "meniscus/transport/bulk/transport_matrices.hpp"

namespace meniscus::bulk {

/// What tables say of scalar k (`ScalarMeasures`). What leaves a drop is what its balance over the
/// last step says. Where there was none, it is the mean of the fluxes on its interface's two sides.
[[nodiscard]] ScalarMeasures scalar_measures(const Scene& scene, const TetMesh& mesh,
                                             const ScalarSpace& space,
                                             const NodePositions& positions, const MassMatrix& mass,
                                             std::size_t k, const BulkScalar& scalar);

}  // namespace meniscus::bulk
