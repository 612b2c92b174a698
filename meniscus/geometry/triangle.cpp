#include "meniscus/geometry/triangle.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace meniscus {
namespace {

TrianglePoint point_with_weights(const Triangle& x, const Vec3& weights) {
  return {weights[0] * x[0] + weights[1] * x[1] + weights[2] * x[2], weights};
}

}  // namespace

TrianglePoint closest_point(const Triangle& x, const Vec3& p) {
  // With e_k the edge from corner k and r_k = p − x_k: `along` is r_k·e_k, zero at corner k and
  // |e_k|² at the next one; `inward` is (n × e_k)·r_k, negative where p lies beyond edge k.
  const std::array<Vec3, 3> e{x[1] - x[0], x[2] - x[1], x[0] - x[2]};
  const Vec3 n = e[0].cross(e[1]);
  std::array<double, 3> along{}, length{};
  Vec3 inward;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 r = p - x[k];
    along[k] = r.dot(e[k]);
    length[k] = e[k].squaredNorm();
    inward[static_cast<int>(k)] = n.cross(e[k]).dot(r);
  }
  const double squared_area = n.squaredNorm();
  if (squared_area > 0.0 && inward.minCoeff() >= 0.0) {
    // The weight of a corner is that of the edge opposite it.
    Vec3 weights(inward[1], inward[2], inward[0]);
    return point_with_weights(x, weights / weights.sum());
  }
  // Nearest of the edges that p lies beyond (of all, for a triangle without area).
  TrianglePoint best;
  double best_squared = HUGE_VAL;
  for (std::size_t k = 0; k < 3; ++k) {
    if (inward[static_cast<int>(k)] >= 0.0 && squared_area > 0.0) continue;
    const double s = length[k] > 0.0 ? std::clamp(along[k] / length[k], 0.0, 1.0) : 0.0;
    const Vec3 point = x[k] + s * e[k];
    const double squared = (point - p).squaredNorm();
    if (squared >= best_squared) continue;
    best_squared = squared;
    best.point = s == 1.0 ? x[(k + 1) % 3] : point;
    best.weights.setZero();
    best.weights[static_cast<int>(k)] = 1.0 - s;
    best.weights[static_cast<int>((k + 1) % 3)] = s;
  }
  return best;
}

std::optional<RayHit> intersect_ray(const Triangle& x, const Vec3& origin, const Vec3& direction) {
  constexpr double kTolerance = 1e-9;  // far above roundoff, far below any element
  const Vec3 u = x[1] - x[0], v = x[2] - x[0], across = direction.cross(v);
  const double determinant = u.dot(across);
  if (determinant == 0.0) return std::nullopt;  // parallel, or no area
  const Vec3 r = origin - x[0], q = r.cross(u);
  const double w1 = r.dot(across) / determinant, w2 = direction.dot(q) / determinant,
               t = v.dot(q) / determinant;
  const Vec3 weights(1.0 - w1 - w2, w1, w2);
  if (!(weights.minCoeff() >= -kTolerance) || !(t >= 0.0)) return std::nullopt;
  return RayHit{t, weights};
}

}  // namespace meniscus
