#include "meniscus/evolve/chebyshev.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace meniscus {
namespace {

/// One step of the recursion on y' = z y, y(0) = 1, with a step of 1.
double recursion(const ChebyshevScheme& scheme, double z) {
  double before = 1.0, now = 1.0;
  bool is_first = true;
  for (const ChebyshevScheme::Stage& s : scheme.stages()) {
    const double next = (1.0 - s.mu - s.nu) + s.mu * now + s.nu * (is_first ? 1.0 : before) +
                        s.mu_F * z * now + s.gamma_F * z;
    before = now;
    now = next;
    is_first = false;
  }
  return now;
}

TEST(Chebyshev, RecursionIsTheStabilityPolynomial) {
  for (const int s : {3, 4, 5, 8, 13, 24}) {
    const ChebyshevScheme scheme(s);
    ASSERT_EQ(static_cast<int>(scheme.stages().size()), s);
    const double beta = ChebyshevScheme::stability_interval(s);
    for (int k = 0; k <= 40; ++k) {
      const double z = -beta * k / 40.0;
      // Round-off grows as s².
      EXPECT_NEAR(recursion(scheme, z), scheme.stability_polynomial(z), 1e-14 * s * s) << s;
    }
  }
}

// T_s in its trigonometric form, independent of the recurrences: P = a + b cos(s arccos(w0 + w1
// z)). It oscillates between a − b and a + b, where a + b w(0) = 1.
TEST(Chebyshev, PolynomialAlternatesBetweenItsBounds) {
  for (const int s : {3, 6, 11}) {
    const ChebyshevScheme scheme(s);
    const double beta = ChebyshevScheme::stability_interval(s), w0 = 1.0 + 2.0 / 13.0 / (s * s),
                 w1 = (1.0 + w0) / beta;
    const auto z_of = [&](double w) { return (w - w0) / w1; };
    const double top = scheme.stability_polynomial(z_of(std::cos(2.0 * M_PI / s))),
                 bottom = scheme.stability_polynomial(z_of(std::cos(M_PI / s)));
    const double a = 0.5 * (top + bottom), b = 0.5 * (top - bottom);
    for (int k = 0; k <= 60; ++k) {
      const double angle = M_PI * k / 60.0;
      EXPECT_NEAR(scheme.stability_polynomial(z_of(std::cos(angle))), a + b * std::cos(s * angle),
                  1e-12);
    }
    EXPECT_LT(top, 0.96);     // 1 − ε/3 and what is of higher order in ε
    EXPECT_GT(bottom, 0.30);  // a third: short waves are damped, and do not alternate
  }
}

TEST(Chebyshev, IsStableOnItsIntervalAndNotBeyond) {
  // β(s) = 2/3 (s² − 1)(1 − 2ε/15) [sommeijer1998]
  for (const int s : {3, 4, 6, 8, 16, 24}) {
    const double beta = ChebyshevScheme::stability_interval(s);
    EXPECT_NEAR(beta, 2.0 / 3.0 * (s * s - 1) * (1.0 - 2.0 / 15.0 * 2.0 / 13.0), 0.02 * beta);
    const ChebyshevScheme scheme(s);
    for (int k = 1; k <= 500; ++k)
      EXPECT_LT(std::abs(scheme.stability_polynomial(-beta * k / 500.0)), 1.0) << s << ' ' << k;
    // With an odd number of stages P leaves by its lower end, from a third to −1, a little later.
    if (s % 2 == 0) {
      EXPECT_GT(scheme.stability_polynomial(-1.1 * beta), 1.0);
    }
  }
}

TEST(Chebyshev, PolynomialIsTheExponentialToSecondOrder) {
  for (const int s : {3, 5, 9}) {
    const ChebyshevScheme scheme(s);
    const auto error = [&](double z) { return scheme.stability_polynomial(z) - std::exp(z); };
    EXPECT_NEAR(std::log2(error(-0.02) / error(-0.01)), 3.0, 0.1) << s;
  }
}

TEST(Chebyshev, TakesTheFewestStagesThatAreStable) {
  EXPECT_EQ(ChebyshevScheme::num_stages_for(0.0), 3);
  for (const double interval : {6.0, 9.0, 11.0, 40.0, 200.0}) {
    const int s = ChebyshevScheme::num_stages_for(interval);
    EXPECT_GE(ChebyshevScheme::stability_interval(s), interval);
    EXPECT_LT(ChebyshevScheme::stability_interval(s - 1), interval);
  }
}

TEST(Chebyshev, StagesLieInOrderWithinTheStep) {
  for (const int s : {3, 7, 24}) {
    double last = 0.0;
    const ChebyshevScheme scheme(s);
    for (const ChebyshevScheme::Stage& stage : scheme.stages()) {
      EXPECT_GT(stage.c, last);
      last = stage.c;
    }
    EXPECT_NEAR(last, 1.0, 1e-13);
  }
}

}  // namespace
}  // namespace meniscus
