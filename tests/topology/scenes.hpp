#pragma once

#include <functional>
#include <span>
#include <vector>

#include "meniscus/scene/scene.hpp"
#include "meniscus/topology/apply_topology.hpp"

namespace meniscus::test {

/// A surface of revolution about the x-axis, x = a ξ, r = profile(ξ), −1 ≤ ξ ≤ 1, remeshed with C0;
/// its volume is that of the smooth shape. The profile ends like √(1 − ξ²).
[[nodiscard]] SurfaceMesh revolved(double a, const std::function<double(double)>& profile,
                                   double C0);
/// r = b √(1 − ξ^power) (1 + amplitude cos(waves π ξ)).
[[nodiscard]] SurfaceMesh wavy_thread(double a, double b, int power, double amplitude, int waves,
                                      double C0);

/// A scene of drops of viscosity ratio 1 and tension 1 in an unbounded matrix; nested as they lie.
[[nodiscard]] Scene scene_of(std::span<const SurfaceMesh> meshes, double C0 = 8.75);

/// The vertices of a mesh numbered otherwise, and its faces in another order.
[[nodiscard]] SurfaceMesh shuffled(const SurfaceMesh& mesh, unsigned seed);

/// The motion of every vertex of a scene by v(x).
[[nodiscard]] SurfaceMotion motion_of(const Scene& scene,
                                      const std::function<Vec3(const Vec3&)>& v);

/// What every event must leave: sound interfaces that do not meet, ids that were never used,
/// volumes that add up to 1e-12, and an area that has not risen by more than 1e-3 of 4π. One line,
/// or empty.
[[nodiscard]] std::string fault_after(const Scene& before, const Scene& after,
                                      const TopologyReport& report);

}  // namespace meniscus::test
