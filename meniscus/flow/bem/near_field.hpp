#pragma once

#include <vector>

#include "meniscus/flow/bem/boundary_geometry.hpp"
#include "meniscus/flow/bem/shared_points.hpp"

namespace meniscus::bem {

/// What the plain sums over all nodes miss at one point. Faces near it are integrated over their
/// curved triangles instead of their nodes. The density's value at the point, or at the nearest
/// point of another surface close by, is subtracted under the integral. Its known integral is
/// added. Linear in the densities.
struct NearRow {
  std::vector<std::int32_t> columns;    ///< nodes of the geometry
  std::vector<Symmetric> double_layer;  ///< to be multiplied by the nodes' u, in double_layer_sum
  Vec3 single = Vec3::Zero();           ///< to be added to single_layer_sum
};

/// Rows of this process's own points, the others' being empty. `q` is the density of the single
/// layer at the nodes; the double layer is left out of surfaces where `has_double_layer` is false.
[[nodiscard]] std::vector<NearRow> near_rows(const BoundaryGeometry& geometry,
                                             const std::vector<double>& q,
                                             const std::vector<bool>& has_double_layer,
                                             const SharedPoints& shared);

}  // namespace meniscus::bem
