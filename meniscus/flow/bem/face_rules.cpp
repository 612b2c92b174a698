#include "meniscus/flow/bem/face_rules.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace meniscus::bem {
namespace {

struct GaussPoint {
  double x, weight;
};

/// Gauss-Legendre on [0, 1], by Newton's method on the Legendre polynomial.
std::vector<GaussPoint> gauss(int count) {
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

std::array<RulePoint, 7> radon_rule() {
  const double root = std::sqrt(15.0);
  const double near = (6.0 - root) / 21.0, far = (6.0 + root) / 21.0;
  std::array<RulePoint, 7> rule;
  rule[0] = {Vec3::Constant(1.0 / 3.0), 9.0 / 40.0};
  for (int k = 0; k < 3; ++k) {
    Vec3 a = Vec3::Constant(near), b = Vec3::Constant(far);
    a[k] = 1.0 - 2.0 * near;
    b[k] = 1.0 - 2.0 * far;
    rule[static_cast<std::size_t>(1 + k)] = {a, (155.0 - root) / 1200.0};
    rule[static_cast<std::size_t>(4 + k)] = {b, (155.0 + root) / 1200.0};
  }
  return rule;
}

std::vector<RulePoint> duffy_rule(int corner) {
  // Radially the integrand is a low polynomial, along the far edge it is like 1/(1 + t²)^(5/2).
  const std::vector<GaussPoint> radial = gauss(4), lateral = gauss(7);
  std::vector<RulePoint> rule;
  for (const GaussPoint& s : radial)
    for (const GaussPoint& t : lateral) {
      Vec3 b;
      b[corner] = 1.0 - s.x;
      b[(corner + 1) % 3] = s.x * (1.0 - t.x);
      b[(corner + 2) % 3] = s.x * t.x;
      rule.push_back({b, 2.0 * s.x * s.weight * t.weight});
    }
  return rule;
}

}  // namespace

std::span<const RulePoint> smooth_rule() {
  static const std::array<RulePoint, 7> rule = radon_rule();
  return rule;
}

std::span<const RulePoint> corner_rule(int corner) {
  static const std::array<std::vector<RulePoint>, 3> rules = {duffy_rule(0), duffy_rule(1),
                                                              duffy_rule(2)};
  return rules[static_cast<std::size_t>(corner)];
}

}  // namespace meniscus::bem
