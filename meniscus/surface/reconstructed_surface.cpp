#include "meniscus/surface/reconstructed_surface.hpp"

#include <algorithm>

#include "meniscus/core/error.hpp"
#include "meniscus/geometry/quadrature.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/edge_interpolation.hpp"

namespace meniscus {
namespace {

using QuadraticFace = TriangleNodes<kQuadraticNodes>;
using Shapes = std::array<TriangleShape<kQuadraticNodes>, kTriangleRule4.size()>;

/// Shape functions at the points of the rule, which is exact for the volume under a quadratic face.
constexpr Shapes kShapes = [] {
  Shapes shapes;
  for (std::size_t q = 0; q < shapes.size(); ++q)
    shapes[q] = quadratic_shape(kTriangleRule4[q].barycentric);
  return shapes;
}();

/// Values at the nodes of every face from those at the vertices and at the middles of the edges.
FaceField<QuadraticFace> quadratic_faces(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                                         const VertexField<Vec3>& corners,
                                         std::span<const Vec3> middles) {
  MENISCUS_ASSERT(middles.size() == topology.edges().size(), "{} middles of {} edges",
                  middles.size(), topology.edges().size());
  const FaceField<std::array<std::size_t, 3>> edges = face_edges(mesh, topology);
  FaceField<QuadraticFace> faces(mesh.num_faces());
  for (const FaceId f : mesh.faces.ids())
    for (std::size_t k = 0; k < 3; ++k) {
      faces[f][k] = corners[mesh.faces[f][k]];
      faces[f][3 + k] = middles[edges[f][k]];
    }
  return faces;
}

/// Sums f(x, n dS) over the points of the rule on every face.
template <class Result, class Function>
Result sum_over_points(const FaceField<QuadraticFace>& faces, Result total, Function&& f) {
  for (const QuadraticFace& face : faces)
    for (std::size_t q = 0; q < kShapes.size(); ++q)
      total += f(weighted_sum(kShapes[q].value, face),
                 Vec3(kTriangleRule4[q].share * tangents(kShapes[q], face).area()));
  return total;
}

/// nn dS from n dS.
Mat3 normal_product(const Vec3& area) {
  const double size = area.norm();
  if (size > 0.0) return area * area.transpose() / size;
  return Mat3::Zero();
}

/// ∫ un dS of linear u on flat faces is Σ_i u_i A_i.
Mat3 flat_velocity_moment(const SurfaceMesh& mesh, const VertexField<Vec3>& u) {
  const VertexField<Vec3> area = vertex_area_vectors(mesh);
  Mat3 sum = Mat3::Zero();
  for (const VertexId v : u.ids()) sum += u[v] * area[v].transpose();
  return sum;
}

double flat_area_rate(const SurfaceMesh& mesh, const VertexField<Vec3>& motion) {
  const VertexField<Vec3> gradient = area_gradient(mesh);
  double rate = 0.0;
  for (const VertexId v : gradient.ids()) rate += gradient[v].dot(motion[v]);
  return rate;
}

}  // namespace

ReconstructedSurface::ReconstructedSurface(const SurfaceMesh& mesh, SurfaceShape shape)
    : mesh_(mesh), shape_(shape) {
  if (is_flat()) return;
  topology_.emplace(mesh);
  smooth_.emplace(mesh, *topology_);
  middles_ = edge_middles(mesh, *topology_, *smooth_, shape);
  faces_ = quadratic_faces(mesh, *topology_, mesh.x, middles_);
  const Vec3 origin = mean_vertex(mesh);
  for (QuadraticFace& face : faces_)
    for (Vec3& x : face) x -= origin;
}

// By the divergence theorem: div x = 3, div (x_i x) = 4 x_i, div (x_i x_j x) = 5 x_i x_j.

double ReconstructedSurface::volume() const {
  if (is_flat()) return enclosed_volume(mesh_);
  return sum_over_points(faces_, 0.0,
                         [](const Vec3& x, const Vec3& area) { return x.dot(area) / 3.0; });
}

double ReconstructedSurface::area() const {
  if (is_flat()) return surface_area(mesh_);
  return sum_over_points(faces_, 0.0, [](const Vec3&, const Vec3& area) { return area.norm(); });
}

Mat3 ReconstructedSurface::second_moments() const {
  if (is_flat()) return enclosed_second_moments(mesh_);
  const Vec3 first = sum_over_points(
      faces_, Vec3(Vec3::Zero()),
      [](const Vec3& x, const Vec3& area) -> Vec3 { return x.dot(area) / 4.0 * x; });
  const Mat3 second =
      sum_over_points(faces_, Mat3(Mat3::Zero()), [](const Vec3& x, const Vec3& area) -> Mat3 {
        return x.dot(area) / 5.0 * x * x.transpose();
      });
  return second - first * first.transpose() / volume();
}

Mat3 ReconstructedSurface::normal_moment() const {
  Mat3 sum = Mat3::Zero();
  if (is_flat()) {
    for (const FaceId f : mesh_.faces.ids()) sum += normal_product(face_area_vector(mesh_, f));
    return sum;
  }
  return sum_over_points(faces_, sum,
                         [](const Vec3&, const Vec3& area) { return normal_product(area); });
}

FaceField<QuadraticFace> ReconstructedSurface::node_velocities(const VertexField<Vec3>& u) const {
  std::vector<Vec3> u_middles;
  u_middles.reserve(middles_.size());
  for (const Stencil& stencil :
       edge_stencils(mesh_, *topology_, smooth_->vertex_normals(), middles_)) {
    Vec3& sum = u_middles.emplace_back(Vec3::Zero());
    for (const VertexWeight& w : stencil) sum += w.weight * u[w.vertex];
  }
  return quadratic_faces(mesh_, *topology_, u, u_middles);
}

Mat3 ReconstructedSurface::velocity_moment(const VertexField<Vec3>& u) const {
  MENISCUS_ASSERT(u.size() == mesh_.num_vertices(), "{} velocities of {} vertices", u.size(),
                  mesh_.num_vertices());
  if (is_flat()) return flat_velocity_moment(mesh_, u);
  const FaceField<QuadraticFace> velocity = node_velocities(u);
  Mat3 sum = Mat3::Zero();
  for (const FaceId f : mesh_.faces.ids())
    for (std::size_t q = 0; q < kShapes.size(); ++q)
      sum += weighted_sum(kShapes[q].value, velocity[f]) *
             (kTriangleRule4[q].share * tangents(kShapes[q], faces_[f]).area()).transpose();
  return sum;
}

double ReconstructedSurface::area_rate(const VertexField<Vec3>& motion) const {
  MENISCUS_ASSERT(motion.size() == mesh_.num_vertices(), "{} velocities of {} vertices",
                  motion.size(), mesh_.num_vertices());
  if (is_flat()) return flat_area_rate(mesh_, motion);
  const FaceField<QuadraticFace> velocity = node_velocities(motion);
  double rate = 0.0;
  for (const FaceId f : mesh_.faces.ids())
    for (std::size_t q = 0; q < kShapes.size(); ++q) {
      const TriangleTangents x = tangents(kShapes[q], faces_[f]),
                             u = tangents(kShapes[q], velocity[f]);
      const Vec3 area_rate = 0.5 * (u.t1.cross(x.t2) + x.t1.cross(u.t2));
      rate += kTriangleRule4[q].share * x.area().normalized().dot(area_rate);
    }
  return rate;
}

}  // namespace meniscus
