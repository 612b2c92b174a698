#include "meniscus/mesh/surface_quality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_pieces.hpp"

namespace meniscus {
namespace {

constexpr double kLowQuantile = 0.05;

void measure_edges(const SurfaceMesh& mesh, const SurfaceTopology& topology, SurfaceQuality& q) {
  q.min_edge = std::numeric_limits<double>::infinity();
  double sum = 0.0;
  for (const SurfaceEdge& e : topology.edges()) {
    const double length = (mesh.x[e.b] - mesh.x[e.a]).norm();
    q.min_edge = std::min(q.min_edge, length);
    q.max_edge = std::max(q.max_edge, length);
    sum += length;
  }
  q.mean_edge = sum / static_cast<double>(topology.edges().size());
}

struct FaceShape {
  std::array<double, 3> angles_deg;
  double radius_ratio;
};

FaceShape face_shape(const SurfaceMesh& mesh, FaceId f) {
  const FaceVertices& v = mesh.faces[f];
  FaceShape shape{};
  std::array<double, 3> edge{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 p = mesh.x[v[(k + 1) % 3]] - mesh.x[v[k]], q = mesh.x[v[(k + 2) % 3]] - mesh.x[v[k]];
    shape.angles_deg[k] = std::atan2(p.cross(q).norm(), p.dot(q)) * 180.0 / std::numbers::pi;
    edge[k] = p.norm();
  }
  // r = 2A/(a + b + c), R = abc/(4A).
  const double area = face_area_vector(mesh, f).norm();
  shape.radius_ratio =
      16.0 * area * area / (edge[0] * edge[1] * edge[2] * (edge[0] + edge[1] + edge[2]));
  return shape;
}

void measure_faces(const SurfaceMesh& mesh, SurfaceQuality& q) {
  std::vector<double> angles;
  angles.reserve(3 * static_cast<std::size_t>(mesh.num_faces()));
  q.min_radius_ratio = 1.0;
  for (const FaceId f : mesh.faces.ids()) {
    const FaceShape shape = face_shape(mesh, f);
    angles.insert(angles.end(), shape.angles_deg.begin(), shape.angles_deg.end());
    q.mean_min_angle_deg += *std::ranges::min_element(shape.angles_deg);
    q.min_radius_ratio = std::min(q.min_radius_ratio, shape.radius_ratio);
    q.mean_radius_ratio += shape.radius_ratio;
  }
  q.mean_min_angle_deg /= mesh.num_faces();
  q.mean_radius_ratio /= mesh.num_faces();
  const auto [least, most] = std::ranges::minmax_element(angles);
  q.min_angle_deg = *least;
  q.max_angle_deg = *most;
  const auto low = angles.begin() +
                   static_cast<std::ptrdiff_t>(kLowQuantile * static_cast<double>(angles.size()));
  std::ranges::nth_element(angles, low);
  q.low_angle_deg = *low;
}

void measure_valences(const SurfaceMesh& mesh, const SurfaceTopology& topology, SurfaceQuality& q) {
  q.min_valence = std::numeric_limits<int>::max();
  std::int32_t num_six = 0;
  for (const VertexId v : mesh.x.ids()) {
    const std::int32_t valence = topology.valence(v);
    q.min_valence = std::min(q.min_valence, valence);
    q.max_valence = std::max(q.max_valence, valence);
    if (valence == 6) ++num_six;
  }
  q.share_of_valence_6 = static_cast<double>(num_six) / mesh.num_vertices();
}

}  // namespace

SurfaceQuality surface_quality(const SurfaceMesh& mesh, const SurfaceTopology& topology) {
  MENISCUS_ASSERT(2 * topology.edges().size() == 3 * static_cast<std::size_t>(mesh.num_faces()),
                  "{} edges, {} faces", topology.edges().size(), mesh.num_faces());
  SurfaceQuality q;
  q.num_vertices = mesh.num_vertices();
  q.num_faces = mesh.num_faces();
  q.num_pieces = static_cast<std::int32_t>(connected_pieces(mesh).size());
  const auto num_edges = static_cast<std::int32_t>(topology.edges().size());
  q.genus = q.num_pieces - (q.num_vertices - num_edges + q.num_faces) / 2;
  q.volume = enclosed_volume(mesh);
  q.area = surface_area(mesh);
  measure_edges(mesh, topology, q);
  measure_faces(mesh, q);
  measure_valences(mesh, topology, q);
  return q;
}

}  // namespace meniscus
