#pragma once

#include <vector>

#include "meniscus/flow/bem/boundary_geometry.hpp"

namespace meniscus::bem {

/// What the single layer of the jump of traction misses of the pull of the interfaces, to be added
/// to it. Tension pulls on any part of a surface by its rim alone,
///
///   ∫ (σκ n − ∇_s σ) φ dS = ∫ σ ∇_s φ dS   for any φ,
///
/// but not with a curvature that is fitted vertex by vertex. Where a thin thread joins a
/// drop, 1 % of the curvature of the drop's end is 8 % of the thread's tension. The
/// difference of both sides for the six functions of each face is a force at its node. Forces at
/// middles go to the vertices that these are interpolated from. The force R_j of a vertex counts
/// spread over the radius ε_j, two roots of the vertex's area, as a regularised Stokeslet
/// (cortez2005):
///
///   Σ_j [R_j (r² + 2 ε_j²) + r (r·R_j)]/(r² + ε_j²)^{3/2},   r = x_j − x.
///
/// The flow of tension is the weak form's on scales above two edges and the strong form's below. A
/// smaller ε leaves J less well interpolated between the nodes. With half of it a relaxing
/// ellipsoid of 110 vertices is 1.6 % too slow, with this one 0.8 %.
class TensionBalance {
 public:
  TensionBalance(const Scene& scene, const BoundaryGeometry& geometry);

  [[nodiscard]] Vec3 operator()(const Vec3& x) const;

 private:
  SourcePoints forces_;         ///< R at the points
  std::vector<double> spread_;  ///< ε² at the points
};

}  // namespace meniscus::bem
