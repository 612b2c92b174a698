#pragma once

#include <vector>

#include "meniscus/flow/bem/boundary_geometry.hpp"

namespace meniscus::bem {

/// The single layer Σ_m ∮_m J·∇_s σ dS, J = I/r + rr/r³, with which a tension that varies
/// pulls the liquid along the interfaces. σ is quadratic on the curved triangles, from its
/// values at the vertices. A face that is far from a point counts by forces at its nodes,
/// between which J is interpolated. One that is near is integrated. The integrand is no more
/// singular than 1/r and needs no subtraction.
class MarangoniLayer {
 public:
  /// Of the interfaces that carry surfactant.
  MarangoniLayer(const Scene& scene, const BoundaryGeometry& geometry);

  /// At point i, of those of the geometry.
  [[nodiscard]] Vec3 operator()(std::int32_t i) const;

 private:
  struct FaceLoad {
    NodeValues tension{};  ///< σ at the nodes
    NodeVectors forces;    ///< ∫φ_a ∇_s σ dS
  };
  [[nodiscard]] Vec3 near_part(std::size_t m, FaceId f, std::int32_t i) const;

  const BoundaryGeometry& geometry_;
  std::vector<FaceField<FaceLoad>> loads_;  ///< by interface; empty without surfactant
  SourcePoints forces_;                     ///< at all nodes, the sums over faces
  std::vector<double> ones_;
};

}  // namespace meniscus::bem
