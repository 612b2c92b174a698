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
template <class Value>
FaceField<std::array<Value, kQuadraticNodes>> faces_with_values(const SurfaceMesh& mesh,
                                                                const SurfaceTopology& topology,
                                                                const VertexField<Value>& corners,
                                                                const std::vector<Value>& middles) {
  MENISCUS_ASSERT(middles.size() == topology.edges().size(), "{} middles of {} edges",
                  middles.size(), topology.edges().size());
  const FaceField<std::array<std::size_t, 3>> edges = face_edges(mesh, topology);
  FaceField<std::array<Value, kQuadraticNodes>> faces(mesh.num_faces());
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

double face_mean(const FaceVertices& v, const VertexField<double>& values) {
  return (values[v[0]] + values[v[1]] + values[v[2]]) / 3.0;
}

double dot(const std::array<double, kQuadraticNodes>& a,
           const std::array<double, kQuadraticNodes>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// div_s u dS per share of the area, from the tangents of x and of u.
double stretching(const TriangleTangents& x, const TriangleTangents& u) {
  return x.area().normalized().dot(0.5 * (u.t1.cross(x.t2) + x.t1.cross(u.t2)));
}

double flat_area_rate(const SurfaceMesh& mesh, const VertexField<Vec3>& motion) {
  const VertexField<Vec3> gradient = area_gradient(mesh);
  double rate = 0.0;
  for (const VertexId v : gradient.ids()) rate += gradient[v].dot(motion[v]);
  return rate;
}

using NodeValues = std::array<double, kQuadraticNodes>;

/// The value of a quadratic face function where it is stationary within the face, or along one of
/// its edges.
std::vector<double> stationary_values(const NodeValues& f) {
  std::vector<double> values;
  for (std::size_t k = 0; k < 3; ++k) {
    // Along edge k with s from 0 to 1: f_a + s (4 f_m − 3 f_a − f_b) + 2 s² (f_a + f_b − 2 f_m).
    const double a = f[k], b = f[(k + 1) % 3], m = f[3 + k], half = a + b - 2.0 * m;
    const double s = (3.0 * a + b - 4.0 * m) / (4.0 * half);
    if (s > 0.0 && s < 1.0) values.push_back(a - 2.0 * half * s * s);
  }
  const TriangleShape<kQuadraticNodes> at_0 = quadratic_shape({1.0, 0.0, 0.0});
  const double g1 = dot(at_0.by_1, f), g2 = dot(at_0.by_2, f),
               h11 = 4.0 * (f[0] + f[1] - 2.0 * f[3]), h22 = 4.0 * (f[0] + f[2] - 2.0 * f[5]),
               h12 = 4.0 * (f[0] + f[4] - f[3] - f[5]), det = h11 * h22 - h12 * h12;
  const double b1 = (h12 * g2 - h22 * g1) / det, b2 = (h12 * g1 - h11 * g2) / det;
  if (b1 > 0.0 && b2 > 0.0 && b1 + b2 < 1.0) values.push_back(f[0] + 0.5 * (g1 * b1 + g2 * b2));
  return values;
}

}  // namespace

ReconstructedSurface::ReconstructedSurface(const SurfaceMesh& mesh, SurfaceShape shape)
    : mesh_(mesh), shape_(shape) {
  if (is_flat()) return;
  topology_.emplace(mesh);
  smooth_.emplace(mesh, *topology_);
  middles_ = edge_middles(mesh, *topology_, *smooth_, shape);
  make_faces();
}

ReconstructedSurface::ReconstructedSurface(const SurfaceMesh& mesh, SurfaceTopology topology,
                                           SmoothSurface smooth, std::vector<Vec3> middles,
                                           SurfaceShape shape)
    : mesh_(mesh),
      shape_(shape),
      topology_(std::move(topology)),
      smooth_(std::move(smooth)),
      middles_(std::move(middles)) {
  MENISCUS_ASSERT(shape != SurfaceShape::faceted, "middles of flat faces");
  make_faces();
}

ReconstructedSurface ReconstructedSurface::scaled(const Dilation& dilation) const {
  const SurfaceMesh mesh = meniscus::scaled(mesh_, dilation);
  if (is_flat()) return {mesh, shape_};
  std::vector<Vec3> middles = middles_;
  for (Vec3& x : middles) x = dilation(x);
  return {mesh, *topology_, smooth_->scaled(dilation), std::move(middles), shape_};
}

void ReconstructedSurface::make_faces() {
  faces_ = faces_with_values(mesh_, *topology_, mesh_.x, middles_);
  const Vec3 origin = mean_vertex(mesh_);
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

Vec3 ReconstructedSurface::centroid() const {
  if (is_flat()) return enclosed_centroid(mesh_);
  return mean_vertex(mesh_) + first_moment() / volume();
}

/// ∫ x dV, seen from the mean vertex.
Vec3 ReconstructedSurface::first_moment() const {
  return sum_over_points(faces_, Vec3(Vec3::Zero()), [](const Vec3& x, const Vec3& area) -> Vec3 {
    return x.dot(area) / 4.0 * x;
  });
}

Mat3 ReconstructedSurface::second_moments() const {
  if (is_flat()) return enclosed_second_moments(mesh_);
  const Vec3 first = first_moment();
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

template <class Value>
FaceField<std::array<Value, kQuadraticNodes>> ReconstructedSurface::node_values(
    const VertexField<Value>& values) const {
  return faces_with_values(
      mesh_, *topology_, values,
      interpolated(edge_stencils(mesh_, *topology_, smooth_->vertex_normals(), middles_), values));
}

Mat3 ReconstructedSurface::tension_moment(const VertexField<double>& tension) const {
  MENISCUS_ASSERT(tension.size() == mesh_.num_vertices(), "{} {}", tension.size(),
                  mesh_.num_vertices());
  Mat3 sum = Mat3::Zero();
  const auto add = [&sum](double sigma, const Vec3& area) {
    sum += sigma * (area.norm() * Mat3::Identity() - normal_product(area));
  };
  if (is_flat()) {
    for (const FaceId f : mesh_.faces.ids())
      add(face_mean(mesh_.faces[f], tension), face_area_vector(mesh_, f));
    return sum;
  }
  const auto sigma = node_values(tension);
  for (const FaceId f : mesh_.faces.ids())
    for (std::size_t q = 0; q < kShapes.size(); ++q)
      add(dot(kShapes[q].value, sigma[f]),
          kTriangleRule4[q].share * tangents(kShapes[q], faces_[f]).area());
  return sum;
}

Mat3 ReconstructedSurface::velocity_moment(const VertexField<Vec3>& u) const {
  MENISCUS_ASSERT(u.size() == mesh_.num_vertices(), "{} velocities of {} vertices", u.size(),
                  mesh_.num_vertices());
  if (is_flat()) return flat_velocity_moment(mesh_, u);
  const FaceField<QuadraticFace> velocity = node_values(u);
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
  const FaceField<QuadraticFace> velocity = node_values(motion);
  double rate = 0.0;
  for (const FaceId f : mesh_.faces.ids())
    for (std::size_t q = 0; q < kShapes.size(); ++q)
      rate += kTriangleRule4[q].share *
              stretching(tangents(kShapes[q], faces_[f]), tangents(kShapes[q], velocity[f]));
  return rate;
}

ReconstructedSurface::ValueRange ReconstructedSurface::range_of(
    const VertexField<double>& values) const {
  MENISCUS_ASSERT(values.size() == mesh_.num_vertices(), "{} {}", values.size(),
                  mesh_.num_vertices());
  const auto [least, most] = std::ranges::minmax(values);
  ValueRange range{least, most};
  if (is_flat()) return range;
  const auto widen = [&range](std::span<const double> some) {
    for (const double value : some) {
      range.least = std::min(range.least, value);
      range.most = std::max(range.most, value);
    }
  };
  for (const NodeValues& nodes : node_values(values)) {
    widen(nodes);
    widen(stationary_values(nodes));
  }
  return range;
}

double ReconstructedSurface::tension_power(const VertexField<double>& tension,
                                           const VertexField<Vec3>& u) const {
  MENISCUS_ASSERT(tension.size() == u.size(), "{} {}", tension.size(), u.size());
  double power = 0.0;
  if (is_flat()) {
    for (const FaceId f : mesh_.faces.ids()) {
      const FaceVertices& v = mesh_.faces[f];
      const TriangleTangents x{mesh_.x[v[1]] - mesh_.x[v[0]], mesh_.x[v[2]] - mesh_.x[v[0]]},
          du{u[v[1]] - u[v[0]], u[v[2]] - u[v[0]]};
      power += face_mean(v, tension) * stretching(x, du);
    }
    return power;
  }
  const auto sigma = node_values(tension);
  const FaceField<QuadraticFace> velocity = node_values(u);
  for (const FaceId f : mesh_.faces.ids())
    for (std::size_t q = 0; q < kShapes.size(); ++q)
      power += kTriangleRule4[q].share * dot(kShapes[q].value, sigma[f]) *
               stretching(tangents(kShapes[q], faces_[f]), tangents(kShapes[q], velocity[f]));
  return power;
}

}  // namespace meniscus
