#pragma once

#include <span>
#include <vector>

#include "meniscus/evolve/interface_motion.hpp"
#include "meniscus/mesh/rigid_motion.hpp"

namespace meniscus {

/// A motion of interfaces' vertices, ẋ = U + n (n·v − n·U): the shape's rigid motion U, and what is
/// left along the normal. The normal speed is that of n n·v, while vertices keep their places on a
/// shape that is carried along or turns. So is the rate of change of a faceted volume, as rigid
/// motions have none.
struct ShapeMotion {
  std::vector<RigidMotion> rigid;  ///< U by interface
  InterfaceMotion rest;            ///< n (n·v − n·U)
};
[[nodiscard]] ShapeMotion shape_motion(const Scene& scene, const InterfaceNormals& normals,
                                       std::span<const VertexField<Vec3>> velocity);

/// The velocity ∮(x − x_c) n·v dS/V of the enclosed centroid x_c [G R0]. `swept` is the volume that
/// each vertex sweeps per time, ∂V/∂x_v·v_v [G R0³].
[[nodiscard]] Vec3 centroid_velocity(const SurfaceMesh& mesh, const VertexField<double>& swept);

/// The rigid motion of an interface's shape. It has the velocity of the enclosed centroid, ∮x n·v
/// dS/V. It has the part sΩ, 0 ≤ s ≤ 1, of the mean spin Ω of v with which its normal speeds agree
/// best. A drop that stands while its liquid goes round has none; one that is carried and turns has
/// all of v.
[[nodiscard]] RigidMotion rigid_motion_of_shape(const SurfaceMesh& mesh,
                                                const VertexField<Vec3>& velocity);

/// ẋ in the scene that the motion was made for.
[[nodiscard]] InterfaceMotion velocity_of(const ShapeMotion& motion, const Scene& scene);
/// The constant velocities that take the vertices of `start` for `duration` along with a motion
/// found on the way. Shapes turn about the centers of `first`, the motion at the start, by
/// rotations, not along tangents.
[[nodiscard]] InterfaceMotion mean_motion(const Scene& start, const ShapeMotion& first,
                                          const ShapeMotion& motion, double duration);

}  // namespace meniscus
