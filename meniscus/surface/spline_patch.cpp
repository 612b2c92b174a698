#include "meniscus/surface/spline_patch.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <Eigen/Geometry>

#include "meniscus/surface/constants.hpp"
#include "meniscus/surface/trust.hpp"

namespace meniscus {

Mat3 curvature_tensor(const VertexCurvature& curvature, const Vec3& n) {
  const auto turn = Eigen::Quaterniond::FromTwoVectors(curvature.n, n);
  const Vec3 d1 = turn * curvature.d1, d2 = turn * curvature.d2;
  return curvature.k1 * d1 * d1.transpose() + curvature.k2 * d2 * d2.transpose();
}

OsculatingQuadric osculating_quadric(const HeightPatch& axes, const Mat3& curvature) {
  const double uu = axes.t1.dot(curvature * axes.t1), uv = axes.t1.dot(curvature * axes.t2),
               vv = axes.t2.dot(curvature * axes.t2), sum = uu + vv, K = uu * vv - uv * uv,
               squares = sum * sum - 2.0 * K;
  return {.uu = uu, .uv = uv, .vv = vv, .zz = squares > 0.0 ? sum * (squares - K) / squares : 0.0};
}

SplinePatch::SplinePatch(const HeightPatch& axes, const OsculatingQuadric& quadric,
                         std::span<const Vec3> points, Coordinates coordinates)
    : quadric_(quadric), coordinates_(coordinates) {
  std::array<Vec3, kMostPoints> local;
  std::size_t seen = 0;
  for (const Vec3& point : points) {
    if (seen == kMostPoints) break;
    const Vec3 d = point - axes.x;
    const Vec3 here(d.dot(axes.t1), d.dot(axes.t2), d.dot(axes.n));
    if (can_see(here)) local[seen++] = here;
  }
  if (seen < SplineEquations::kLeast) return;
  unit_ = local[seen - 1].norm();
  if (!(unit_ > 0.0)) return;  // all points in one place
  count_ = seen;
  std::array<SplineEquations::Place, kMostPoints> places;
  for (std::size_t i = 0; i < count_; ++i) {
    const Vec3 flat = this->coordinates(local[i]);
    places[i] = flat.head<2>();
    levels_[i] = flat.z();
  }
  equations_.set(std::span(places).first(count_));
}

SplinePatch::Level SplinePatch::level(double u, double v) const {
  if (count_ == 0) return {};
  std::array<double, kMostPoints> weights;
  equations_.weights({u, v}, std::span(weights).first(count_));
  double amplification = 0.0, g = 0.0;
  for (std::size_t i = 0; i < count_; ++i) {
    amplification += std::abs(weights[i]);
    g += weights[i] * levels_[i];
  }
  if (!(amplification < 2.0 * kMostAmplification)) return {};
  return {g, trust(amplification, kMostAmplification)};
}

/// Unrolled coordinates are one-to-one as far as this below the tangent plane: some 84° of a
/// sphere.
bool SplinePatch::can_see(const Vec3& point) const {
  constexpr double kDeepest = 0.9;  // in osculating radii 1/H
  return coordinates_ == Coordinates::flat || quadric_.half_sum() * point.z() > -kDeepest;
}

double SplinePatch::scale(double z) const {
  if (coordinates_ == Coordinates::flat) return 1.0;
  const double turned = quadric_.half_sum() * z;
  return std::sqrt(std::hypot(1.0, turned) - turned);
}

Vec3 SplinePatch::coordinates(const Vec3& point) const {
  const double s = scale(point.z());
  return {s * point.x(), s * point.y(), quadric_.level(point)};
}

Vec3 SplinePatch::point(double g, double u, double v) const {
  constexpr int kMostSteps = 30;
  const double bent = 0.5 * (quadric_.uu * u * u + quadric_.vv * v * v) + quadric_.uv * u * v;
  double z = 0.0, s = 1.0;
  for (int step = 0; step < kMostSteps; ++step) {
    // z + ½ S_zz z² = g − (the quadric's terms in u and v)/s² with the s of the z before.
    const double rest = g - bent / (s * s);
    const double next =
        2.0 * rest / (1.0 + std::sqrt(std::max(0.0, 1.0 + 2.0 * quadric_.zz * rest)));
    const bool is_found = std::abs(next - z) <= 1e-15 * unit_;
    z = next;
    s = scale(z);
    if (is_found) break;
  }
  return {u / s, v / s, z};
}

Vec3 point_on_spline(const HeightPatch& axes, const OsculatingQuadric& quadric,
                     std::vector<Vec3>& around, SplinePatch::Coordinates coordinates,
                     const Vec3& flat, double edge) {
  nearest_first(axes.x, around);
  const SplinePatch spline(axes, quadric, around, coordinates);
  const SplinePatch::Level at = spline.level(0.0, 0.0);
  const Vec3 shift = spline.point(at.trust * at.g, 0.0, 0.0).z() * axes.n;
  return axes.x + trust((axes.x + shift - flat).norm(), kHighestMiddle * edge) * shift;
}

void nearest_first(const Vec3& center, std::vector<Vec3>& points) {
  std::vector<std::tuple<double, double, double, double>> keys;
  keys.reserve(points.size());
  for (const Vec3& p : points) keys.emplace_back((p - center).squaredNorm(), p.x(), p.y(), p.z());
  std::ranges::sort(keys);
  keys.erase(std::ranges::unique(keys).begin(), keys.end());
  points.clear();
  for (const auto& [distance, x, y, z] : keys) points.emplace_back(x, y, z);
}

}  // namespace meniscus
