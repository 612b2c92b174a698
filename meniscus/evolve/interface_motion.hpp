#pragma once

#include <optional>
#include <span>
#include <vector>

#include "meniscus/evolve/options.hpp"
#include "meniscus/scene/scene.hpp"

namespace meniscus {

/// The velocities of the vertices of each interface of a scene [G R0].
using InterfaceMotion = std::vector<VertexField<Vec3>>;

/// Unit normals of the vertices of each interface, and speeds along them [G R0].
using InterfaceNormals = std::vector<VertexField<Vec3>>;
using NormalSpeeds = std::vector<VertexField<double>>;
[[nodiscard]] InterfaceNormals interface_normals(const Scene& scene, MotionNormal normal);
/// n·v
[[nodiscard]] NormalSpeeds normal_speeds(const InterfaceNormals& normals,
                                         std::span<const VertexField<Vec3>> velocity);
/// n n·v
[[nodiscard]] InterfaceMotion normal_motion(const InterfaceNormals& normals,
                                            const NormalSpeeds& speeds);

/// ẋ = n n·v at every interface vertex (eq. 23 of hooper2001), n the direction of the vertex's area
/// vector or of the paraboloid fit.
[[nodiscard]] InterfaceMotion normal_motion(const Scene& scene,
                                            std::span<const VertexField<Vec3>> velocity,
                                            MotionNormal normal);

/// x ← x + dt ẋ on every interface.
void move_interfaces(Scene& scene, const InterfaceMotion& motion, double dt);

/// The mean velocity that moves the interfaces of `start` to those of `end` within dt.
[[nodiscard]] InterfaceMotion mean_motion(const Scene& start, const Scene& end, double dt);

/// A fault if the motion changed a drop's volume beyond bounds: the flow was not solved. Remeshing
/// or mending would hide it.
[[nodiscard]] std::optional<Fault> find_wild_motion(const Scene& start, const Scene& end);

/// The centroid of all liquid that is not matrix [R0].
[[nodiscard]] Vec3 centroid_of_drops(const Scene& scene);

/// x ← x + shift on every interface.
void translate_interfaces(Scene& scene, const Vec3& shift);

/// Σ tension · dS/dt over the interfaces as triangulations, for vertices that move with `motion`:
/// the rate at which their energy grows [μ_out G² R0³].
[[nodiscard]] double surface_energy_rate(const Scene& scene, const InterfaceMotion& motion);

}  // namespace meniscus
