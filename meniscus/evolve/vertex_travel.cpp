#include "meniscus/evolve/vertex_travel.hpp"

#include <algorithm>
#include <limits>

#include "meniscus/core/error.hpp"
#include "meniscus/evolve/stability.hpp"
#include "meniscus/mesh/rigid_motion.hpp"
#include "meniscus/mesh/surface_tree.hpp"
#include "meniscus/surface/curvature.hpp"

namespace meniscus {
namespace {

/// A neck is where the surface bends this much less along than around it. A sphere has 1, a
/// cylinder 0 and the waist of a catenoid −1. Its other side is within so many radii: a round neck
/// has 2. The rim of a cap bends as a neck does, but has no other side.
constexpr double kMostAxialBend = 0.25, kFarthestSide = 6.0;

/// Largest fraction of its radius that a neck loses: half of what its sides come closer.
double neck_loss(const SurfaceMesh& mesh, const VertexField<Vec3>& w, double dt) {
  constexpr double kSkip = 1e-3;  // radii; of the faces where the ray starts
  const VertexField<VertexCurvature> curvature = fitted_curvature(mesh, SurfaceTopology(mesh));
  const SurfaceTree tree(mesh);
  double loss = 0.0;
  for (const VertexId v : w.ids()) {
    const VertexCurvature& at = curvature[v];
    if (at.k1 <= 0.0 || at.k2 > kMostAxialBend * at.k1) continue;
    const auto opposite =
        tree.first_hit(mesh.x[v] - kSkip / at.k1 * at.n, -at.n, kFarthestSide / at.k1);
    if (!opposite) continue;
    Vec3 there = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k)
      there += opposite->weights[static_cast<Eigen::Index>(k)] * w[mesh.faces[opposite->face][k]];
    loss = std::max(loss, 0.5 * at.n.dot(there - w[v]) * at.k1 * dt);
  }
  return loss;
}

}  // namespace

VertexField<double> shortest_edges(const SurfaceMesh& mesh) {
  VertexField<double> shortest(mesh.num_vertices(), std::numeric_limits<double>::infinity());
  for (const FaceVertices& v : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = v[k], b = v[(k + 1) % 3];
      const double length = (mesh.x[a] - mesh.x[b]).norm();
      shortest[a] = std::min(shortest[a], length);
      shortest[b] = std::min(shortest[b], length);
    }
  return shortest;
}

VertexTravel vertex_travel(const Scene& start, const InterfaceMotion& motion,
                           std::span<const VertexField<Vec3>> velocity, double dt) {
  MENISCUS_ASSERT(motion.size() == start.interfaces.size() && velocity.size() == motion.size(),
                  "{} motions and {} velocities of {} interfaces", motion.size(), velocity.size(),
                  start.interfaces.size());
  VertexTravel travel;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const SurfaceMesh& mesh = start.interfaces[i].mesh;
    const VertexField<Vec3>& w = motion[i];
    const VertexField<double> edge = shortest_edges(mesh);
    const double viscosities = start.liquids[start.interfaces[i].inside].viscosity +
                               start.liquids[start.interfaces[i].outside].viscosity;
    const RigidMotion rigid =
        RigidProjection(mesh)([&](VertexId v) -> const Vec3& { return w[v]; });
    for (const VertexId v : edge.ids()) {
      const Vec3 rest = w[v] - rigid.at(mesh.x[v]);
      travel.displacement = std::max(travel.displacement, rest.norm() * dt / edge[v]);
      const double past = (velocity[i][v] - w[v]).norm();
      travel.slip = std::max(
          travel.slip,
          past * dt / (edge[v] * aimed_slip(past, viscosities, start.interfaces[i].tension)));
    }
    travel.neck_loss = std::max(travel.neck_loss, neck_loss(mesh, w, dt));
  }
  return travel;
}

double courant_number(const TetMesh& mesh, const Field<TetVertexId, Vec3>& v,
                      const Field<TetVertexId, Vec3>& w, double dt) {
  Field<TetVertexId, double> shortest(mesh.num_vertices(), std::numeric_limits<double>::infinity());
  for (const CellVertices& cell : mesh.cells)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) {
        const double edge = (mesh.x[cell[i]] - mesh.x[cell[j]]).norm();
        for (const TetVertexId end : {cell[i], cell[j]})
          shortest[end] = std::min(shortest[end], edge);
      }
  double largest = 0.0;
  for (const TetVertexId i : v.ids())
    largest = std::max(largest, dt * (v[i] - w[i]).norm() / shortest[i]);
  return largest;
}

}  // namespace meniscus
