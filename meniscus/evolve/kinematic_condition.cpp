#include "meniscus/evolve/kinematic_condition.hpp"

#include <array>

#include "meniscus/core/error.hpp"
#include "meniscus/evolve/shape_motion.hpp"
#include "meniscus/geometry/quadratic_triangle.hpp"
#include "meniscus/geometry/quadrature.hpp"
#include "meniscus/surface/edge_interpolation.hpp"
#include "meniscus/surface/edge_middles.hpp"

namespace meniscus {
namespace {

/// Normals at the middles of the edges of each face, interpolated from those at the vertices.
FaceField<std::array<Vec3, 3>> middle_normals(const SurfaceMesh& mesh,
                                              const VertexField<Vec3>& normals,
                                              const FaceField<std::array<Vec3, 3>>& x) {
  const SurfaceTopology topology(mesh);
  const FaceField<std::array<std::size_t, 3>> edges = face_edges(mesh, topology);
  std::vector<Vec3> middles(topology.edges().size());
  for (const FaceId f : mesh.faces.ids())
    for (std::size_t k = 0; k < 3; ++k) middles[edges[f][k]] = x[f][k];
  std::vector<Vec3> of_edges;
  of_edges.reserve(middles.size());
  for (const Stencil& stencil : edge_stencils(mesh, topology, normals, middles)) {
    Vec3& sum = of_edges.emplace_back(Vec3::Zero());
    for (const VertexWeight& w : stencil) sum += w.weight * normals[w.vertex];
    sum.normalize();
  }
  FaceField<std::array<Vec3, 3>> result(mesh.num_faces());
  for (const FaceId f : mesh.faces.ids())
    for (std::size_t k = 0; k < 3; ++k) result[f][k] = of_edges[edges[f][k]];
  return result;
}

/// Position, velocity beyond the rigid motion and speed along n at the nodes of one face.
struct FaceNodes {
  TriangleNodes<kQuadraticNodes> x, u;
  std::array<double, kQuadraticNodes> speed;

  void set(std::size_t node, const Vec3& at, const Vec3& velocity, const Vec3& n) {
    x[node] = at;
    u[node] = velocity;
    speed[node] = n.dot(velocity);
  }
};

/// Adds ∫φ_k (u·ν − (n·u)_h) dS and ∫φ_k dS of each corner k of a face.
void add_excess(const FaceNodes& nodes, std::array<double, 3>& excess,
                std::array<double, 3>& area) {
  for (const QuadraturePoint<3>& point : kTriangleRule6) {
    const TriangleShape<kQuadraticNodes> shape = quadratic_shape(point.barycentric);
    const Vec3 normal_area = point.share * tangents(shape, nodes.x).area();
    const double dS = normal_area.norm();
    double speed = 0.0;
    for (std::size_t i = 0; i < kQuadraticNodes; ++i) speed += shape.value[i] * nodes.speed[i];
    const double flux = weighted_sum(shape.value, nodes.u).dot(normal_area);
    for (std::size_t k = 0; k < 3; ++k) {
      excess[k] += point.barycentric[k] * (flux - speed * dS);
      area[k] += point.barycentric[k] * dS;
    }
  }
}

}  // namespace

void follow_faces(const SurfaceMesh& mesh, const VertexField<Vec3>& normals,
                  const MiddleNodes& middles, VertexField<Vec3>& velocity) {
  MENISCUS_ASSERT(middles.x.size() == mesh.num_faces() && middles.v.size() == mesh.num_faces(),
                  "middles of {} faces, velocities of {}, for {}", middles.x.size(),
                  middles.v.size(), mesh.num_faces());
  const RigidMotion rigid = rigid_motion_of_shape(mesh, velocity);
  const FaceField<std::array<Vec3, 3>> normals_between = middle_normals(mesh, normals, middles.x);
  VertexField<double> excess(mesh.num_vertices(), 0.0), area(mesh.num_vertices(), 0.0);
  for (const FaceId f : mesh.faces.ids()) {
    const FaceVertices& corners = mesh.faces[f];
    FaceNodes nodes;
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId v = corners[k];
      nodes.set(k, mesh.x[v], velocity[v] - rigid.at(mesh.x[v]), normals[v]);
      const Vec3& middle = middles.x[f][k];
      nodes.set(3 + k, middle, middles.v[f][k] - rigid.at(middle), normals_between[f][k]);
    }
    std::array<double, 3> excess_at{}, area_at{};
    add_excess(nodes, excess_at, area_at);
    for (std::size_t k = 0; k < 3; ++k) {
      excess[corners[k]] += excess_at[k];
      area[corners[k]] += area_at[k];
    }
  }
  for (const VertexId v : velocity.ids()) velocity[v] += excess[v] / area[v] * normals[v];
}

}  // namespace meniscus
