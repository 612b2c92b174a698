#include "meniscus/surface/spline_patch.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "meniscus/surface/constants.hpp"
#include "meniscus/surface/trust.hpp"

namespace meniscus {
namespace {

double spline(const Eigen::Vector2d& d) {
  const double squared = d.squaredNorm();
  return squared * squared * squared * std::sqrt(squared);
}

}  // namespace

/// Sets up [Φ P; Pᵀ 0], whose solutions are the weights of the vertices' levels at a point.
SplinePatch::SplinePatch(const HeightPatch& axes, double half_sum, std::span<const Vec3> points)
    : half_sum_(half_sum) {
  points = points.first(std::min(points.size(), kMostPoints));
  const auto count = static_cast<Eigen::Index>(points.size());
  if (count < kTerms) return;
  unit_ = (points.back() - axes.x).norm();
  if (!(unit_ > 0.0)) return;  // all points in one place
  levels_.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Vec3 d = points[static_cast<std::size_t>(i)] - axes.x;
    at_.emplace_back(d.dot(axes.t1) / unit_, d.dot(axes.t2) / unit_);
    levels_[i] = d.dot(axes.n) + 0.5 * half_sum * d.squaredNorm();
  }
  Matrix matrix = Matrix::Zero(count + kTerms, count + kTerms);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Vec2& here = at_[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < i; ++j)
      matrix(i, j) = matrix(j, i) = spline(here - at_[static_cast<std::size_t>(j)]);
    matrix.row(i).tail<kTerms>() << 1.0, monomials<4>(here.x(), here.y()).transpose();
    matrix.col(i).tail<kTerms>() = matrix.row(i).tail<kTerms>();
  }
  equations_.compute(matrix);
}

SplinePatch::Height SplinePatch::height(double u, double v) const {
  if (!(unit_ > 0.0)) return {0.0, z(0.0, u, v), 0.0};
  const Vec2 here(u / unit_, v / unit_);
  const Eigen::Index count = levels_.size();
  Vector side(count + kTerms);
  for (Eigen::Index i = 0; i < count; ++i)
    side[i] = spline(here - at_[static_cast<std::size_t>(i)]);
  side.tail<kTerms>() << 1.0, monomials<4>(here.x(), here.y());
  const Vector weights = equations_.solve(side).head(count);
  const double amplification = weights.lpNorm<1>();
  // A singular matrix leaves weights that are large or not numbers.
  if (!(amplification < 2.0 * kMostAmplification)) return {0.0, z(0.0, u, v), 0.0};
  const double level = weights.dot(levels_);
  return {level, z(level, u, v), trust(amplification, kMostAmplification)};
}

/// z of z + ½H (u² + v² + z²) = g.
double SplinePatch::z(double level, double u, double v) const {
  const double rest = level - 0.5 * half_sum_ * (u * u + v * v);
  return 2.0 * rest / (1.0 + std::sqrt(std::max(0.0, 1.0 + 2.0 * half_sum_ * rest)));
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
