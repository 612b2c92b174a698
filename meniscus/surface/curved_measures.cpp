#include "meniscus/surface/curved_measures.hpp"

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/edge_interpolation.hpp"
#include "meniscus/surface/remesh.hpp"
#include "meniscus/surface/smooth_surface.hpp"

namespace meniscus {
namespace {

constexpr double kVolumeTolerance = 1e-12;  // relative
// The first shift leaves the O(h²) part by which curved and flat volumes answer it differently, a
// hundredth or so; from then on the secant knows it.
constexpr int kMostShifts = 30;
// What is left of the missing volume after the shifts is made up for by a change of scale, which is
// exact and costs no more middles.
constexpr double kLeftToScale = 0.1;

/// A point of a rule on a parabolic triangle: the quadratic functions, corners first, and their
/// derivatives by the second and the third barycentric coordinate.
struct RulePoint {
  std::array<double, 6> shape{}, by_1{}, by_2{};
  double share = 0.0;  ///< of the face's area
};

RulePoint rule_point(const std::array<double, 3>& b, double share) {
  RulePoint point;
  point.share = share;
  constexpr std::array<double, 3> by_1 = {-1, 1, 0}, by_2 = {-1, 0, 1};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    point.shape[i] = b[i] * (2.0 * b[i] - 1.0);
    point.by_1[i] = (4.0 * b[i] - 1.0) * by_1[i];
    point.by_2[i] = (4.0 * b[i] - 1.0) * by_2[i];
    point.shape[3 + i] = 4.0 * b[i] * b[j];
    point.by_1[3 + i] = 4.0 * (b[i] * by_1[j] + b[j] * by_1[i]);
    point.by_2[3 + i] = 4.0 * (b[i] * by_2[j] + b[j] * by_2[i]);
  }
  return point;
}

/// Degree 4 on triangles, 6 points (dunavant1985): exact for the volume under a parabolic face.
const std::array<RulePoint, 6> kRule = [] {
  std::array<RulePoint, 6> rule;
  constexpr std::array<std::array<double, 2>, 2> orbits = {
      {{0.445948490915964886, 0.223381589678011466},
       {0.0915762135097707435, 0.109951743655321868}}};
  std::size_t q = 0;
  for (const auto& [a, share] : orbits)
    for (std::size_t k = 0; k < 3; ++k, ++q) {
      std::array<double, 3> barycentric = {a, a, a};
      barycentric[k] = 1.0 - 2.0 * a;
      rule[q] = rule_point(barycentric, share);
    }
  return rule;
}();

/// Values at the corners, then at the middles of the edges 01, 12, 20.
using ParabolicFace = std::array<Vec3, 6>;

FaceField<ParabolicFace> parabolic_faces(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                                         const VertexField<Vec3>& corners,
                                         std::span<const Vec3> middles) {
  FaceField<ParabolicFace> faces(mesh.num_faces());
  for (const FaceId f : mesh.faces.ids())
    for (std::size_t k = 0; k < 3; ++k) faces[f][k] = corners[mesh.faces[f][k]];
  for (std::size_t e = 0; e < middles.size(); ++e) {
    const SurfaceEdge& edge = topology.edges()[e];
    for (const auto& [f, from] : {std::pair{edge.left, edge.a}, std::pair{edge.right, edge.b}})
      for (std::size_t k = 0; k < 3; ++k)
        if (mesh.faces[f][k] == from) faces[f][3 + k] = middles[e];
  }
  return faces;
}

/// As seen from the mean vertex, for the sake of round-off in volumes.
FaceField<ParabolicFace> parabolic_faces(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                                         std::span<const Vec3> middles) {
  const Vec3 origin = mean_vertex(mesh);
  FaceField<ParabolicFace> faces = parabolic_faces(mesh, topology, mesh.x, middles);
  for (ParabolicFace& face : faces)
    for (Vec3& x : face) x -= origin;
  return faces;
}

Vec3 combined(const std::array<double, 6>& weights, const ParabolicFace& nodes) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < nodes.size(); ++k) sum += weights[k] * nodes[k];
  return sum;
}

/// The face at a point of the rule.
struct FacePoint {
  Vec3 x, area;  ///< area: n dS
};

FacePoint face_point(const ParabolicFace& x, const RulePoint& at) {
  return {combined(at.shape, x), 0.5 * at.share * combined(at.by_1, x).cross(combined(at.by_2, x))};
}

double curved_volume(const SurfaceMesh& mesh, const SurfaceTopology& topology, SurfaceShape shape) {
  double volume = 0.0;
  for (const ParabolicFace& face :
       parabolic_faces(mesh, topology, edge_middles(mesh, topology, shape)))
    for (const RulePoint& at : kRule) {
      const FacePoint point = face_point(face, at);
      volume += point.x.dot(point.area) / 3.0;
    }
  return volume;
}

/// From the volume that the curved surface has, by a change of scale about the centroid, which
/// moves the middles as it moves the vertices, so that V ∝ scale³ exactly. Returns how far the
/// surface moves on average, (scale − 1) 3V/A.
double scale_to_volume(SurfaceMesh& mesh, double from, double to) {
  // A surface far off is crumpled; its curved volume says nothing.
  if (!(from > 0.5 * to && from < 2.0 * to)) return 0.0;
  const Vec3 center = enclosed_centroid(mesh);
  const double scale = std::cbrt(to / from);
  for (Vec3& x : mesh.x) x = center + scale * (x - center);
  return (scale - 1.0) * 3.0 * from / surface_area(mesh);
}

}  // namespace

CurvedMeasures curved_measures(const SurfaceMesh& mesh, SurfaceShape shape) {
  const SurfaceTopology topology(mesh);
  CurvedMeasures measures;
  Vec3 first = Vec3::Zero();
  const std::vector<Vec3> middles = edge_middles(mesh, topology, shape);
  for (const ParabolicFace& face : parabolic_faces(mesh, topology, middles))
    for (const RulePoint& at : kRule) {
      const FacePoint point = face_point(face, at);
      const double flux = point.x.dot(point.area);
      // By the divergence theorem: div x = 3, div (x_i x) = 4 x_i, div (x_i x_j x) = 5 x_i x_j.
      measures.volume += flux / 3.0;
      measures.area += point.area.norm();
      first += flux / 4.0 * point.x;
      measures.second_moments += flux / 5.0 * point.x * point.x.transpose();
    }
  measures.second_moments -= first * first.transpose() / measures.volume;
  return measures;
}

SurfaceMoments curved_moments(const SurfaceMesh& mesh, const VertexField<Vec3>& u,
                              SurfaceShape shape) {
  const SurfaceTopology topology(mesh);
  const std::vector<Vec3> middles = edge_middles(mesh, topology, shape);
  std::vector<Vec3> u_middles;
  for (const Stencil& stencil : edge_stencils(mesh, topology, smooth_normals(mesh), middles)) {
    Vec3& sum = u_middles.emplace_back(Vec3::Zero());
    for (const VertexWeight& w : stencil) sum += w.weight * u[w.vertex];
  }
  const FaceField<ParabolicFace> faces = parabolic_faces(mesh, topology, middles),
                                 velocity = parabolic_faces(mesh, topology, u, u_middles);
  SurfaceMoments moments;
  for (const FaceId f : mesh.faces.ids())
    for (const RulePoint& at : kRule) {
      const FacePoint point = face_point(faces[f], at);
      moments.volume += point.x.dot(point.area) / 3.0;
      moments.velocity += combined(at.shape, velocity[f]) * point.area.transpose();
      if (const double size = point.area.norm(); size > 0.0)
        moments.normals += point.area * point.area.transpose() / size;
    }
  return moments;
}

VertexField<Vec3> smooth_normals(const SurfaceMesh& mesh) {
  const SmoothSurface smooth(mesh, SurfaceTopology(mesh));
  VertexField<Vec3> normals(mesh.num_vertices());
  for (const VertexId v : normals.ids()) normals[v] = smooth.patch(v).curvature().n;
  return normals;
}

double restore_curved_volume(SurfaceMesh& mesh, double volume, SurfaceShape shape) {
  const SurfaceTopology topology(mesh);
  double enclosed = curved_volume(mesh, topology, shape);
  const double first = std::abs(volume - enclosed);
  double shift = 0.0;
  double gain = 1.0;  // what flat faces must gain for the curved ones to gain one
  for (int step = 0; step < kMostShifts; ++step) {
    const double missing = volume - enclosed;
    if (std::abs(missing) <= kVolumeTolerance * volume) return shift;
    if (step > 0 && std::abs(missing) <= kLeftToScale * first) break;
    const VertexField<Vec3> before = mesh.x;
    const double moved = restore_volume(mesh, enclosed_volume(mesh) + gain * missing);
    const double shifted = curved_volume(mesh, topology, shape), left = volume - shifted;
    if (!(std::abs(left) < std::abs(missing))) {
      mesh.x = before;
      break;
    }
    gain *= missing / (missing - left);
    shift += moved;
    enclosed = shifted;
  }
  return shift + scale_to_volume(mesh, enclosed, volume);
}

}  // namespace meniscus
