#include "meniscus/surface/curved_measures.hpp"

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/edge_interpolation.hpp"
#include "meniscus/surface/edge_middles.hpp"
#include "meniscus/surface/remesh.hpp"
#include "meniscus/surface/smooth_surface.hpp"

namespace meniscus {
namespace {

constexpr double kVolumeTolerance = 1e-12;  // relative
// The first step leaves the O(h²) part by which curved and flat volumes answer a shift differently;
// from then on the secant knows it, and three or four steps are enough.
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

/// The face at a point of the rule.
struct FacePoint {
  std::array<double, 6> shape;  ///< the quadratic functions
  Vec3 x, area;                 ///< area: n dS

  [[nodiscard]] Vec3 value(const ParabolicFace& nodes) const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < nodes.size(); ++k) sum += shape[k] * nodes[k];
    return sum;
  }
};

FacePoint face_point(const ParabolicFace& x, const RulePoint& at) {
  FacePoint point;
  Vec3 t1 = Vec3::Zero(), t2 = Vec3::Zero();
  const std::array<double, 3> by_1 = {-1, 1, 0}, by_2 = {-1, 0, 1};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const auto bi = at.barycentric[static_cast<Eigen::Index>(i)],
               bj = at.barycentric[static_cast<Eigen::Index>(j)];
    point.shape[i] = bi * (2.0 * bi - 1.0);
    point.shape[3 + i] = 4.0 * bi * bj;
    t1 += (4.0 * bi - 1.0) * by_1[i] * x[i] + 4.0 * (bi * by_1[j] + bj * by_1[i]) * x[3 + i];
    t2 += (4.0 * bi - 1.0) * by_2[i] * x[i] + 4.0 * (bi * by_2[j] + bj * by_2[i]) * x[3 + i];
  }
  point.x = point.value(x);
  point.area = 0.5 * at.share * t1.cross(t2);
  return point;
}

/// The volume may jump past what is asked as vertices shift: which vertices a fit takes hangs on
/// where they are. A similarity changes none of that, so V ∝ scale³. Returns how far the surface
/// moves on average, (scale − 1) 3V/A.
double scale_to_curved_volume(SurfaceMesh& mesh, double volume) {
  const CurvedMeasures measures = curved_measures(mesh);
  // A surface far off is crumpled; its curved volume says nothing.
  if (!(measures.volume > 0.5 * volume && measures.volume < 2.0 * volume)) return 0.0;
  const Vec3 center = enclosed_centroid(mesh);
  const double scale = std::cbrt(volume / measures.volume);
  for (Vec3& x : mesh.x) x = center + scale * (x - center);
  return (scale - 1.0) * 3.0 * measures.volume / measures.area;
}

}  // namespace

CurvedMeasures curved_measures(const SurfaceMesh& mesh) {
  const SurfaceTopology topology(mesh);
  CurvedMeasures measures;
  Vec3 first = Vec3::Zero();
  for (const ParabolicFace& face : parabolic_faces(mesh, topology, edge_middles(mesh, topology)))
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

SurfaceMoments curved_moments(const SurfaceMesh& mesh, const VertexField<Vec3>& u) {
  const SurfaceTopology topology(mesh);
  const std::vector<Vec3> middles = edge_middles(mesh, topology);
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
      moments.velocity += point.value(velocity[f]) * point.area.transpose();
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

double restore_curved_volume(SurfaceMesh& mesh, double volume) {
  double shift = 0.0, moved = 0.0, last = std::numeric_limits<double>::infinity();
  double gain = 1.0;  // what flat faces must gain for the curved ones to gain one
  VertexField<Vec3> before;
  for (int step = 0; step < kMaxSteps; ++step) {
    const double missing = volume - curved_measures(mesh).volume;
    if (std::abs(missing) <= kVolumeTolerance * volume) return shift;
    if (std::abs(missing) >= std::abs(last)) {
      mesh.x = before;
      shift -= moved;
      break;
    }
    if (step > 0) gain *= last / (last - missing);
    last = missing;
    before = mesh.x;
    moved = restore_volume(mesh, enclosed_volume(mesh) + gain * missing);
    shift += moved;
  }
  return shift + scale_to_curved_volume(mesh, volume);
}

}  // namespace meniscus
