#include "meniscus/evolve/chebyshev.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>

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

/// |P| at random places where the rates of waves lie.
double largest_at_random(const ChebyshevScheme& scheme, const WaveSpectrum& waves) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  double largest = 0.0;
  for (int k = 0; k < 20000; ++k) {
    const double decay = share(random) * waves.decay;
    const double fastest = std::min(waves.ratio * decay, waves.convection);
    largest = std::max(largest, std::abs(scheme.stability_polynomial(
                                    std::complex<double>(-decay, share(random) * fastest))));
  }
  return largest;
}

TEST(Chebyshev, IsStableForWavesThatAreConvected) {
  for (const WaveSpectrum& waves :
       {WaveSpectrum{9.0, 0.2, 2.0}, WaveSpectrum{6.0, 0.5, 3.0}, WaveSpectrum{3.0, 1.0, 3.4},
        WaveSpectrum{40.0, 0.1, 3.4}, WaveSpectrum{150.0, 0.05, 3.4},
        WaveSpectrum{42.3, 7.04, 1.894}, WaveSpectrum{200.0, 8.0, 1.9}}) {
    const ChebyshevScheme scheme = ChebyshevScheme::for_waves(waves, 24);
    EXPECT_LE(largest_at_random(scheme, waves), 1.0 + 1e-12) << waves.decay;
    EXPECT_LE(scheme.largest_growth(waves), 1.0 + 1e-12);
    const double corner = std::min(waves.decay, waves.convection / waves.ratio);
    EXPECT_LE(
        std::abs(scheme.stability_polynomial(std::complex<double>(-corner, waves.ratio * corner))),
        1.0 + 1e-12);
    const auto stages = static_cast<int>(scheme.stages().size());
    EXPECT_LT(stages, 24);
    // What is stable on the real axis alone lets such waves grow.
    const ChebyshevScheme least(ChebyshevScheme::num_stages_for(waves.decay));
    EXPECT_GT(largest_at_random(least, waves), 1.03) << waves.decay;
    EXPECT_GE(least.largest_growth(waves), largest_at_random(least, waves) - 1e-3);
  }
}

TEST(Chebyshev, WavesThatNoneBearsGrowAsLittleAsIsWorthTheStages) {
  const WaveSpectrum waves{11.76, 11.55, 1.969};
  const ChebyshevScheme scheme = ChebyshevScheme::for_waves(waves, 24);
  const double growth = scheme.largest_growth(waves);
  EXPECT_GT(growth, 1.0);
  EXPECT_LE(growth, ChebyshevScheme(3).largest_growth(waves));
  for (int s = 3; s <= 24; ++s)
    for (const double damping : {ChebyshevScheme::kLeastDamping, ChebyshevScheme::kMostDamping})
      EXPECT_GT(ChebyshevScheme(s, damping).largest_growth(waves), 0.98 * growth) << s;
}

TEST(Chebyshev, WavesAtRestTakeTheFewestStages) {
  for (const double decay : {0.0, 9.0, 40.0}) {
    const ChebyshevScheme scheme = ChebyshevScheme::for_waves({.decay = decay}, 24);
    EXPECT_EQ(static_cast<int>(scheme.stages().size()), ChebyshevScheme::num_stages_for(decay));
  }
}

TEST(Chebyshev, DampedSchemesAreOfSecondOrderToo) {
  for (const double damping : {1.0, ChebyshevScheme::kMostDamping}) {
    const ChebyshevScheme scheme(6, damping);
    const auto error = [&](double z) { return scheme.stability_polynomial(z) - std::exp(z); };
    EXPECT_NEAR(std::log2(error(-0.02) / error(-0.01)), 3.0, 0.1) << damping;
    for (const double z : {-0.3, -4.0, -11.0})
      EXPECT_NEAR(recursion(scheme, z), scheme.stability_polynomial(z), 1e-13) << damping;
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
