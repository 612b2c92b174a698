#include "meniscus/surface/spline_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include <Eigen/LU>

#include "meniscus/core/error.hpp"
#include "meniscus/surface/constants.hpp"
#include "meniscus/surface/polynomial_fit.hpp"
#include "meniscus/surface/trust.hpp"

namespace meniscus {
namespace {

constexpr Eigen::Index kTerms = 1 + num_monomials(4);
// Vertices are taken in the order of their distance; more cost time and add nothing.
constexpr std::size_t kMostPoints = 32;

using Vec2 = Eigen::Vector2d;
// Of a spline's equations: of bounded size, so that no memory is allocated for each point.
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

/// The spline's value at the frame's origin, Σ w_i g_i, the weights w solving
/// [Φ P; Pᵀ 0] (w, ·) = (φ(0 − x_i), p(0)), times how far it is to be trusted, 0 to 1.
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

}  // namespace

SplineSurface::SplineSurface(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                             const SmoothSurface& smooth)
    : mesh_(mesh), smooth_(smooth), rings_(mesh, topology) {}

Vec3 SplineSurface::middle(const SurfaceEdge& edge) {
  const std::array corners{Corner{edge.a, 0.5}, Corner{edge.b, 0.5}};
  return lifted(smooth_.edge_point(edge.a, edge.b, 0.5), corners);
}

Vec3 SplineSurface::point(const SurfacePoint& location) {
  const FaceVertices& v = mesh_.faces[location.face];
  const std::array corners{Corner{v[0], location.weights[0]}, Corner{v[1], location.weights[1]},
                           Corner{v[2], location.weights[2]}};
  return lifted(smooth_.point(location), corners);
}

/// The spline's point on the normal through a point of the smooth surface.
Vec3 SplineSurface::lifted(const Vec3& smooth_point, std::span<const Corner> corners) {
  Vec3 n = Vec3::Zero(), flat = Vec3::Zero();
  double half_sum = 0.0, longest = 0.0;
  for (const auto& [v, weight] : corners) {
    const VertexCurvature& at = smooth_.vertex_curvature()[v];
    n += weight * at.n;
    half_sum += weight * at.half_sum();
    flat += weight * mesh_.x[v];
    for (const Corner& other : corners)
      longest = std::max(longest, (mesh_.x[other.vertex] - mesh_.x[v]).norm());
  }
  const LevelFrame frame{flat_patch(smooth_point, n.normalized()), half_sum};
  gather(corners, smooth_point);
  const double z = height_of_level(interpolated_level(frame, points_), half_sum);
  const double lift = (smooth_point + z * frame.axes.n - flat).norm();
  return smooth_point + trust(lift, kHighestMiddle * longest) * z * frame.axes.n;
}

/// The vertices in the two rings of all corners, each once, by distance from `center`.
void SplineSurface::gather(std::span<const Corner> corners, const Vec3& center) {
  points_.clear();
  for (const Corner& corner : corners)
    for (const Vec3& p : rings_.gather(corner.vertex, true)) points_.push_back(p);
  std::vector<std::tuple<double, double, double, double>> keys;
  keys.reserve(points_.size());
  for (const Vec3& p : points_) keys.emplace_back((p - center).squaredNorm(), p.x(), p.y(), p.z());
  std::ranges::sort(keys);
  keys.erase(std::ranges::unique(keys).begin(), keys.end());
  if (keys.size() > kMostPoints) keys.resize(kMostPoints);
  points_.clear();
  for (const auto& [distance, x, y, z] : keys) points_.emplace_back(x, y, z);
}

}  // namespace meniscus
