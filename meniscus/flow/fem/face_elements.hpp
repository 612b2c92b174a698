#pragma once

#include <array>
#include <span>

#include "meniscus/flow/fem/node_positions.hpp"
#include "meniscus/geometry/quadrature.hpp"

namespace meniscus::fem {

/// A quadrature point of a face of 3 or 6 nodes.
struct FacePoint {
  Vec3 x = Vec3::Zero();           ///< [R0]
  Vec3 area = Vec3::Zero();        ///< n dS, out of the enclosed liquid [R0²]
  std::array<double, 6> value{};   ///< φ_i
  std::array<Vec3, 6> gradient{};  ///< (I − nn)·∇φ_i [1/R0]
};

/// The points of one face by the rule of degree 6.
using FacePoints = std::array<FacePoint, kTriangleRule6.size()>;
[[nodiscard]] FacePoints face_points(const Field<NodeId, Vec3>& x, std::span<const NodeId> nodes);

/// ∫φ_i n dS of every node of a surface, by node of the volume mesh; zero elsewhere [R0²].
[[nodiscard]] Field<NodeId, Vec3> node_area_vectors(const FaceNodeTable& faces,
                                                    const Field<NodeId, Vec3>& x);

}  // namespace meniscus::fem
