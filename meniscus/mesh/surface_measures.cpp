#include "meniscus/mesh/surface_measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

namespace meniscus {
namespace {

/// Sums f(a, b, c) over the faces, positions taken relative to `origin`.
template <class Result, class Function>
Result sum_over_faces(const SurfaceMesh& mesh, const Vec3& origin, Result total, Function&& f) {
  for (const FaceVertices& v : mesh.faces)
    total +=
        f(Vec3(mesh.x[v[0]] - origin), Vec3(mesh.x[v[1]] - origin), Vec3(mesh.x[v[2]] - origin));
  return total;
}

}  // namespace

Vec3 face_area_vector(const SurfaceMesh& mesh, FaceId f) {
  const FaceVertices& v = mesh.faces[f];
  return 0.5 * (mesh.x[v[1]] - mesh.x[v[0]]).cross(mesh.x[v[2]] - mesh.x[v[0]]);
}

FaceField<double> face_areas(const SurfaceMesh& mesh) {
  FaceField<double> areas(mesh.num_faces());
  for (const FaceId f : areas.ids()) areas[f] = face_area_vector(mesh, f).norm();
  return areas;
}

double surface_area(const SurfaceMesh& mesh) {
  double area = 0.0;
  for (const FaceId f : mesh.faces.ids()) area += face_area_vector(mesh, f).norm();
  return area;
}

Vec3 mean_vertex(const SurfaceMesh& mesh) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& x : mesh.x) sum += x;
  return sum / std::max(1, mesh.num_vertices());
}

double enclosed_volume(const SurfaceMesh& mesh) {
  return sum_over_faces(
      mesh, mean_vertex(mesh), 0.0,
      [](const Vec3& a, const Vec3& b, const Vec3& c) { return a.dot(b.cross(c)) / 6.0; });
}

Vec3 enclosed_centroid(const SurfaceMesh& mesh) {
  const Vec3 origin = mean_vertex(mesh);
  const Vec3 moment = sum_over_faces(mesh, origin, Vec3(Vec3::Zero()),
                                     [](const Vec3& a, const Vec3& b, const Vec3& c) -> Vec3 {
                                       return a.dot(b.cross(c)) / 24.0 * (a + b + c);
                                     });
  return origin + moment / enclosed_volume(mesh);
}

Mat3 enclosed_second_moments(const SurfaceMesh& mesh) {
  // Over the tetrahedron (0, a, b, c): ∫ x xᵀ dV = det/120 (Σ v vᵀ + s sᵀ), s = a + b + c.
  return sum_over_faces(
      mesh, enclosed_centroid(mesh), Mat3(Mat3::Zero()),
      [](const Vec3& a, const Vec3& b, const Vec3& c) -> Mat3 {
        const Vec3 s = a + b + c;
        return a.dot(b.cross(c)) / 120.0 *
               (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
      });
}

VertexField<Vec3> vertex_area_vectors(const SurfaceMesh& mesh) {
  VertexField<Vec3> result(mesh.num_vertices(), Vec3::Zero());
  for (const FaceId f : mesh.faces.ids()) {
    const Vec3 third = face_area_vector(mesh, f) / 3.0;
    for (const VertexId v : mesh.faces[f]) result[v] += third;
  }
  return result;
}

VertexField<double> vertex_areas(const SurfaceMesh& mesh) {
  VertexField<double> result(mesh.num_vertices(), 0.0);
  for (const FaceId f : mesh.faces.ids()) {
    const double third = face_area_vector(mesh, f).norm() / 3.0;
    for (const VertexId v : mesh.faces[f]) result[v] += third;
  }
  return result;
}

VertexField<Vec3> area_gradient(const SurfaceMesh& mesh) {
  VertexField<Vec3> result(mesh.num_vertices(), Vec3::Zero());
  for (const FaceId f : mesh.faces.ids()) {
    const FaceVertices& v = mesh.faces[f];
    const Vec3 n = face_area_vector(mesh, f).normalized();
    for (std::size_t k = 0; k < 3; ++k)
      result[v[k]] += 0.5 * n.cross(mesh.x[v[(k + 2) % 3]] - mesh.x[v[(k + 1) % 3]]);
  }
  return result;
}

namespace {

template <class Function>
void for_each_edge_length(const SurfaceMesh& mesh, Function&& f) {
  for (const FaceVertices& v : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k)
      if (v[k] < v[(k + 1) % 3]) f((mesh.x[v[(k + 1) % 3]] - mesh.x[v[k]]).norm());
}

}  // namespace

double shortest_edge(const SurfaceMesh& mesh) {
  double shortest = std::numeric_limits<double>::infinity();
  for_each_edge_length(mesh, [&](double length) { shortest = std::min(shortest, length); });
  return shortest;
}

double mean_edge(const SurfaceMesh& mesh) {
  double sum = 0.0;
  std::int32_t count = 0;
  for_each_edge_length(mesh, [&](double length) { sum += length, ++count; });
  return sum / std::max(1, count);
}

double smallest_angle_deg(const SurfaceMesh& mesh) {
  // The corner of the largest signed square of the cosine; its angle alone is then taken.
  double largest = -2.0, angle = std::numbers::pi;
  for (const FaceVertices& v : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = mesh.x[v[(k + 1) % 3]] - mesh.x[v[k]],
                 q = mesh.x[v[(k + 2) % 3]] - mesh.x[v[k]];
      const double dot = p.dot(q),
                   squared = dot * std::abs(dot) / (p.squaredNorm() * q.squaredNorm());
      if (squared <= largest) continue;
      largest = squared;
      angle = std::atan2(p.cross(q).norm(), dot);
    }
  return angle * 180.0 / std::numbers::pi;
}

bool is_finite(const SurfaceMesh& mesh) {
  return std::ranges::all_of(mesh.x, [](const Vec3& x) { return x.allFinite(); });
}

}  // namespace meniscus
