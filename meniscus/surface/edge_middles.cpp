#include "meniscus/surface/edge_middles.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>

#include <Eigen/LU>

#include "meniscus/core/error.hpp"
#include "meniscus/surface/polynomial_fit.hpp"
#include "meniscus/surface/rings.hpp"
#include "meniscus/surface/trust.hpp"

namespace meniscus {
namespace {

constexpr Eigen::Index kTerms = 1 + num_monomials(4);
// Vertices are taken in the order of their distance; more cost time and add nothing.
constexpr std::size_t kMostPoints = 32;

using Vec2 = Eigen::Vector2d;
// Of a spline's equations: of bounded size, so that no memory is allocated for each edge.
constexpr int kMostUnknowns = static_cast<int>(kMostPoints + kTerms);
using Matrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostUnknowns, kMostUnknowns>;
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostUnknowns, 1>;

double spline(const Vec2& d) {
  const double squared = d.squaredNorm();
  return squared * squared * squared * std::sqrt(squared);
}

/// The level function's coordinates around a point near the surface.
struct LevelFrame {
  HeightPatch axes;
  double half_sum = 0.0;

  [[nodiscard]] double g(const Vec3& x) const {
    const Vec3 d = x - axes.x;
    return d.dot(axes.n) + 0.5 * half_sum * d.squaredNorm();
  }
};

/// The spline's value at the frame's origin, Σ w_i g_i, the weights w solving [Φ P; Pᵀ 0] (w, ·) =
/// (φ(0 − x_i), p(0)). It is multiplied by how far it is to be trusted, 0 to 1.
double interpolated_level(const LevelFrame& frame, std::span<const Vec3> points) {
  const auto count = static_cast<Eigen::Index>(points.size());
  if (count < kTerms) return 0.0;
  const double h = (points.back() - frame.axes.x).norm();
  if (!(h > 0.0)) return 0.0;  // all points in one place
  std::vector<Vec2> at;
  for (const Vec3& p : points) {
    const Vec3 d = (p - frame.axes.x) / h;
    at.emplace_back(d.dot(frame.axes.t1), d.dot(frame.axes.t2));
  }
  Matrix matrix = Matrix::Zero(count + kTerms, count + kTerms);
  Vector side(count + kTerms);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Vec2& here = at[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < i; ++j)
      matrix(i, j) = matrix(j, i) = spline(here - at[static_cast<std::size_t>(j)]);
    matrix.row(i).tail<kTerms>() << 1.0, monomials<4>(here.x(), here.y()).transpose();
    matrix.col(i).tail<kTerms>() = matrix.row(i).tail<kTerms>();
    side[i] = spline(here);
  }
  side.tail<kTerms>() << 1.0, Eigen::Matrix<double, num_monomials(4), 1>::Zero();
  const Vector weights = matrix.partialPivLu().solve(side).head(count);
  const double amplification = weights.lpNorm<1>();
  // A singular matrix leaves weights that are large or not numbers.
  if (!(amplification < 2.0 * kMostAmplification)) return 0.0;
  double level = 0.0;
  for (Eigen::Index i = 0; i < count; ++i)
    level += weights[i] * frame.g(points[static_cast<std::size_t>(i)]);
  return trust(amplification, kMostAmplification) * level;
}

/// z of z + ½H z² = g.
double height_of_level(double g, double half_sum) {
  return 2.0 * g / (1.0 + std::sqrt(std::max(0.0, 1.0 + 2.0 * half_sum * g)));
}

/// The vertices in the two rings of both ends, each once, by distance from `center`.
void gather(RingGatherer& rings, const SurfaceEdge& edge, const Vec3& center,
            std::vector<Vec3>& points) {
  points.clear();
  for (const VertexId end : {edge.a, edge.b})
    for (const Vec3& p : rings.gather(end, true)) points.push_back(p);
  std::vector<std::tuple<double, double, double, double>> keys;
  keys.reserve(points.size());
  for (const Vec3& p : points) keys.emplace_back((p - center).squaredNorm(), p.x(), p.y(), p.z());
  std::ranges::sort(keys);
  keys.erase(std::ranges::unique(keys).begin(), keys.end());
  if (keys.size() > kMostPoints) keys.resize(kMostPoints);
  points.clear();
  for (const auto& [distance, x, y, z] : keys) points.emplace_back(x, y, z);
}

std::vector<Vec3> straight_middles(const SurfaceMesh& mesh, const SurfaceTopology& topology) {
  std::vector<Vec3> middles;
  middles.reserve(topology.edges().size());
  for (const SurfaceEdge& edge : topology.edges())
    middles.emplace_back(0.5 * (mesh.x[edge.a] + mesh.x[edge.b]));
  return middles;
}

}  // namespace

FaceField<std::array<std::size_t, 3>> face_edges(const SurfaceMesh& mesh,
                                                 const SurfaceTopology& topology) {
  FaceField<std::array<std::size_t, 3>> edges(mesh.num_faces());
  for (std::size_t e = 0; e < topology.edges().size(); ++e) {
    const SurfaceEdge& edge = topology.edges()[e];
    for (const auto& [f, from] : {std::pair{edge.left, edge.a}, std::pair{edge.right, edge.b}}) {
      const FaceVertices& v = mesh.faces[f];
      const auto k = static_cast<std::size_t>(std::ranges::find(v, from) - v.begin());
      MENISCUS_ASSERT(k < 3, "edge {} does not leave vertex {} of face {}", e, from.value, f.value);
      edges[f][k] = e;
    }
  }
  return edges;
}

std::vector<Vec3> edge_middles(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                               const SmoothSurface& smooth, SurfaceShape shape) {
  switch (shape) {
    case SurfaceShape::faceted:
      break;
    case SurfaceShape::patched:
      return middles_on_patches(smooth, topology);
    case SurfaceShape::splined:
      return middles_on_splines(mesh, topology, smooth);
  }
  return straight_middles(mesh, topology);
}

std::vector<Vec3> middles_on_patches(const SmoothSurface& smooth, const SurfaceTopology& topology) {
  std::vector<Vec3> middles;
  middles.reserve(topology.edges().size());
  for (const SurfaceEdge& edge : topology.edges())
    middles.push_back(smooth.edge_point(edge.a, edge.b, 0.5));
  return middles;
}

std::vector<Vec3> middles_on_splines(const SurfaceMesh& mesh, const SurfaceTopology& topology) {
  return middles_on_splines(mesh, topology, SmoothSurface(mesh, topology));
}

std::vector<Vec3> middles_on_splines(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                                     const SmoothSurface& smooth) {
  return middles_on_splines(mesh, topology, smooth, 0, topology.edges().size());
}

std::vector<Vec3> middles_on_splines(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                                     const SmoothSurface& smooth, std::size_t first,
                                     std::size_t end) {
  MENISCUS_ASSERT(first <= end && end <= topology.edges().size(), "edges {} to {} of {}", first,
                  end, topology.edges().size());
  const VertexField<VertexCurvature>& curvature = smooth.vertex_curvature();
  RingGatherer rings(mesh, topology);
  std::vector<Vec3> points, middles;
  middles.reserve(end - first);
  for (const SurfaceEdge& edge : std::span(topology.edges()).subspan(first, end - first)) {
    const VertexCurvature &at_a = curvature[edge.a], &at_b = curvature[edge.b];
    const LevelFrame frame{
        flat_patch(smooth.edge_point(edge.a, edge.b, 0.5), (at_a.n + at_b.n).normalized()),
        0.5 * (at_a.half_sum() + at_b.half_sum())};
    gather(rings, edge, frame.axes.x, points);
    const double z = height_of_level(interpolated_level(frame, points), frame.half_sum);
    const Vec3 lift = frame.axes.x + z * frame.axes.n - 0.5 * (mesh.x[edge.a] + mesh.x[edge.b]);
    const double limit = kHighestMiddle * (mesh.x[edge.b] - mesh.x[edge.a]).norm();
    middles.emplace_back(frame.axes.x + trust(lift.norm(), limit) * z * frame.axes.n);
  }
  return middles;
}

}  // namespace meniscus
