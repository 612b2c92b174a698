#include "meniscus/surface/curved_measures.hpp"

#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/edge_middles.hpp"
#include "meniscus/surface/remesh.hpp"
#include "meniscus/surface/smooth_surface.hpp"

namespace meniscus {
namespace {

constexpr double kVolumeTolerance = 1e-12;  // relative
// Each step leaves the O(h²) part by which curved and flat volumes answer a shift differently.
constexpr int kMaxSteps = 30;

/// Degree 4 on triangles, 6 points (dunavant1985): exact for the volume under a parabolic face.
struct RulePoint {
  Vec3 barycentric;
  double share;
};
const std::array<RulePoint, 6> kRule = [] {
  std::array<RulePoint, 6> rule;
  constexpr std::array<std::array<double, 2>, 2> orbits = {
      {{0.445948490915964886, 0.223381589678011466},
       {0.0915762135097707435, 0.109951743655321868}}};
  std::size_t q = 0;
  for (const auto& [a, share] : orbits)
    for (int k = 0; k < 3; ++k, ++q) {
      rule[q] = {Vec3::Constant(a), share};
      rule[q].barycentric[k] = 1.0 - 2.0 * a;
    }
  return rule;
}();

/// Corners, then the middles of the edges 01, 12, 20.
using ParabolicFace = std::array<Vec3, 6>;

FaceField<ParabolicFace> parabolic_faces(const SurfaceMesh& mesh, const Vec3& origin) {
  const SurfaceTopology topology(mesh);
  const std::vector<Vec3> middles = edge_middles(mesh, topology);
  FaceField<ParabolicFace> faces(mesh.num_faces());
  for (const FaceId f : mesh.faces.ids())
    for (std::size_t k = 0; k < 3; ++k) faces[f][k] = mesh.x[mesh.faces[f][k]] - origin;
  for (std::size_t e = 0; e < middles.size(); ++e) {
    const SurfaceEdge& edge = topology.edges()[e];
    for (const auto& [f, from] : {std::pair{edge.left, edge.a}, std::pair{edge.right, edge.b}})
      for (std::size_t k = 0; k < 3; ++k)
        if (mesh.faces[f][k] == from) faces[f][3 + k] = middles[e] - origin;
  }
  return faces;
}

/// Adds ⅓∫x·n dS and ∫dS of a face.
void add_face(const ParabolicFace& x, CurvedMeasures& measures) {
  for (const auto& [b, share] : kRule) {
    Vec3 point = Vec3::Zero(), t1 = Vec3::Zero(), t2 = Vec3::Zero();
    const std::array<double, 3> by_1 = {-1, 1, 0}, by_2 = {-1, 0, 1};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const auto bi = b[static_cast<Eigen::Index>(i)], bj = b[static_cast<Eigen::Index>(j)];
      point += bi * (2.0 * bi - 1.0) * x[i] + 4.0 * bi * bj * x[3 + i];
      t1 += (4.0 * bi - 1.0) * by_1[i] * x[i] + 4.0 * (bi * by_1[j] + bj * by_1[i]) * x[3 + i];
      t2 += (4.0 * bi - 1.0) * by_2[i] * x[i] + 4.0 * (bi * by_2[j] + bj * by_2[i]) * x[3 + i];
    }
    const Vec3 area = 0.5 * share * t1.cross(t2);
    measures.volume += point.dot(area) / 3.0;
    measures.area += area.norm();
  }
}

}  // namespace

CurvedMeasures curved_measures(const SurfaceMesh& mesh) {
  CurvedMeasures measures;
  for (const ParabolicFace& face : parabolic_faces(mesh, mean_vertex(mesh)))
    add_face(face, measures);
  return measures;
}

VertexField<Vec3> smooth_normals(const SurfaceMesh& mesh) {
  const SmoothSurface smooth(mesh, SurfaceTopology(mesh));
  VertexField<Vec3> normals(mesh.num_vertices());
  for (const VertexId v : normals.ids()) normals[v] = smooth.patch(v).curvature().n;
  return normals;
}

double restore_curved_volume(SurfaceMesh& mesh, double volume) {
  double shift = 0.0, last = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kMaxSteps; ++step) {
    const double missing = volume - curved_measures(mesh).volume;
    if (std::abs(missing) <= kVolumeTolerance * volume || std::abs(missing) >= last) break;
    last = std::abs(missing);
    shift += restore_volume(mesh, enclosed_volume(mesh) + missing);
  }
  return shift;
}

}  // namespace meniscus
