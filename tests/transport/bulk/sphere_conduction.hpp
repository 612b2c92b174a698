#pragma once

#include <cmath>
#include <complex>
#include <numbers>

namespace meniscus::bulk {

/// Conduction from a sphere of radius 1, T = 1 at t = 0, into a medium at 0 whose wall at radius b
/// keeps T = 0: the transform of `k` = k_in/k_out, `a` = α_in/α_out, inverted by the fixed rule of
/// Talbot (abate2004), to some 1e-9.
class SphereConduction {
 public:
  SphereConduction(double k, double a, double b) : k_(k), a_(a), b_(b) {}

  [[nodiscard]] double at(double r, double t) const {
    constexpr int kTerms = 24;
    const double rate = 2.0 * kTerms / (5.0 * t);
    double total = 0.5 * std::exp(rate * t) * transform(r, rate).real();
    for (int j = 1; j < kTerms; ++j) {
      const double theta = j * std::numbers::pi / kTerms, cot = 1.0 / std::tan(theta);
      const Complex s = rate * theta * Complex(cot, 1.0);
      const Complex slope(1.0, theta + (theta * cot - 1.0) * cot);
      total += (std::exp(t * s) * transform(r, s) * slope).real();
    }
    return rate / kTerms * total;
  }

 private:
  using Complex = std::complex<double>;

  /// sinh(q r)/sinh(q), r <= 1, without overflow.
  static Complex sinh_ratio(Complex q, double r) {
    return std::exp(q * (r - 1.0)) * (1.0 - std::exp(-2.0 * q * r)) / (1.0 - std::exp(-2.0 * q));
  }
  static Complex coth(Complex q) { return (1.0 + std::exp(-2.0 * q)) / (1.0 - std::exp(-2.0 * q)); }

  [[nodiscard]] Complex inside(double r, Complex s) const {
    const Complex q1 = std::sqrt(s / a_), q2 = std::sqrt(s);
    const Complex h = 1.0 + q2 * coth(q2 * (b_ - 1.0));
    const Complex shape =
        r < 1e-8 ? q1 * 2.0 * std::exp(-q1) / (1.0 - std::exp(-2.0 * q1)) : sinh_ratio(q1, r) / r;
    return 1.0 / s - h / s * shape / (k_ * (q1 * coth(q1) - 1.0) + h);
  }
  [[nodiscard]] Complex transform(double r, Complex s) const {
    if (r <= 1.0) return inside(r, s);
    const Complex q2 = std::sqrt(s);
    return inside(1.0, s) * sinh_ratio(q2 * (b_ - 1.0), (b_ - r) / (b_ - 1.0)) / r;
  }

  double k_, a_, b_;
};

}  // namespace meniscus::bulk
