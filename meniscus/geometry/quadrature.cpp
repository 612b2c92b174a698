#include "meniscus/geometry/quadrature.hpp"

#include <cmath>
#include <numbers>

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

std::vector<QuadraturePoint<3>> duffy_rule(std::size_t corner) {
  // Radially the integrand is a low polynomial, along the far edge it is like 1/(1 + t²)^(5/2).
  const std::vector<GaussPoint> radial = gauss_legendre(4), lateral = gauss_legendre(7);
  std::vector<QuadraturePoint<3>> rule;
  for (const GaussPoint& s : radial)
    for (const GaussPoint& t : lateral) {
      QuadraturePoint<3>& point = rule.emplace_back();
      point.barycentric[corner] = 1.0 - s.x;
      point.barycentric[(corner + 1) % 3] = s.x * (1.0 - t.x);
      point.barycentric[(corner + 2) % 3] = s.x * t.x;
      point.share = 2.0 * s.x * s.weight * t.weight;
    }
  return rule;
}

}  // namespace

std::vector<GaussPoint> gauss_legendre(int count) {
  MENISCUS_ASSERT(count > 0, "{} points", count);
  // By Newton's method on the Legendre polynomial, on [−1, 1].
  std::vector<GaussPoint> points;
  for (int i = 0; i < count; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5)), slope = 1.0;
    for (int turn = 0; turn < 100; ++turn) {
      double p = x, before = 1.0;
      for (int k = 2; k <= count; ++k) {
        const double next = ((2.0 * k - 1.0) * x * p - (k - 1.0) * before) / k;
        before = p;
        p = next;
      }
      slope = count * (x * p - before) / (x * x - 1.0);
      const double step = p / slope;
      x -= step;
      if (std::abs(step) < 1e-15) break;
    }
    points.push_back({0.5 * (1.0 - x), 1.0 / ((1.0 - x * x) * slope * slope)});
  }
  return points;
}

std::span<const QuadraturePoint<3>> corner_rule(std::size_t corner) {
  MENISCUS_ASSERT(corner < 3, "corner {}", corner);
  static const std::array<std::vector<QuadraturePoint<3>>, 3> rules = {duffy_rule(0), duffy_rule(1),
                                                                       duffy_rule(2)};
  return rules[corner];
}

}  // namespace meniscus
