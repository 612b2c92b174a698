#pragma once

#include <span>

#include "meniscus/scene/scene.hpp"

namespace meniscus {

/// How the vertices between the surfaces follow them (§4.4 of hooper2001).
enum class VolumeMotion { spines, lagrangian, harmonic };

/// Velocity of every mesh vertex: `interface_motion` on the interfaces, zero on the outer boundary,
/// and between them
///  * spines: along the ray from the drop's centre (one star-shaped drop; elsewhere harmonic),
///  * lagrangian: the fluid's velocity `fluid`,
///  * harmonic: the solution of ∇·(|K|⁻¹∇w) = 0.
[[nodiscard]] Field<TetVertexId, Vec3> volume_velocity(
    const Scene& scene, const TetMesh& mesh, std::span<const VertexField<Vec3>> interface_motion,
    const Field<TetVertexId, Vec3>& fluid, VolumeMotion motion);

}  // namespace meniscus
