#include "tests/evolve/oscillation_mode.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace meniscus::test {
namespace {

using Complex = std::complex<double>;

TEST(OscillationMode, HasTheKnownRates) {
  const auto expect = [](double La, double b, Complex rate, double tolerance) {
    const Complex s = OscillationMode({.La = La, .b = b}, 1.01 * rate).rate();
    EXPECT_NEAR(s.real(), rate.real(), tolerance) << La << ", " << b;
    EXPECT_NEAR(s.imag(), rate.imag(), tolerance) << La << ", " << b;
  };
  constexpr double kUnbounded = std::numeric_limits<double>::infinity();
  expect(10.0, kUnbounded, {0.332123, 0.313282}, 6e-7);
  expect(10.0, 5.0, {0.332183, 0.313199}, 6e-7);
  expect(100.0, kUnbounded, {0.0586175, 0.1741579}, 6e-8);
  expect(100.0, 5.0, {0.0586540, 0.1741185}, 6e-8);
  expect(1000.0, kUnbounded, {0.00893097, 0.0618567}, 6e-8);
  expect(1000.0, 5.0, {0.00893550, 0.0618434}, 6e-8);
}

TEST(OscillationMode, TendsToLambsFrequency) {
  const double La = 1e8, lamb = std::sqrt(24.0 / (5.0 * La));
  const Complex s = OscillationMode({.La = La}, {0.01 * lamb, lamb}).rate();
  EXPECT_NEAR(s.imag() / lamb, 1.0, 0.02);
  EXPECT_LT(s.real() / lamb, 0.02);
}

/// The eigenvalues of a drop with surfactant in Stokes flow, l = 2 and 3.
TEST(OscillationMode, TendsToTheRatesOfStokesFlowWithSurfactant) {
  const auto expect = [](const Oscillation& of, double rate) {
    EXPECT_NEAR(OscillationMode(of, 1.02 * rate).rate().real() / rate, 1.0, 1e-3) << rate;
  };
  expect({.La = 1e-4, .lambda = 0.1, .E0 = 0.5, .D_s = 0.1}, 0.6879279371);
  expect({.La = 1e-4, .lambda = 0.1, .E0 = 0.5, .D_s = 0.1}, 1.2790413367);
  expect({.La = 1e-4, .lambda = 1.0, .E0 = 0.5, .D_s = 1.0}, 0.4560280867);
  expect({.La = 1e-4, .lambda = 0.1, .E0 = 2.0}, 2.4904445817);
}

TEST(OscillationMode, HasTheVelocityOfItsConditions) {
  const OscillationMode mode({.La = 100.0, .lambda = 0.5, .density_ratio = 2.0, .b = 5.0},
                             {0.05, 0.14});
  const double f0 = 0.02;
  const auto v = [&](const Vec3& x) { return mode.velocity(x, f0); };
  for (const Vec3& x : {Vec3(0.3, 0.4, -0.2), Vec3(1.0, 2.0, -0.5), Vec3(0.1, 0.0, 0.2)}) {
    double divergence = 0.0;
    for (int k = 0; k < 3; ++k) {
      const Vec3 step = 1e-5 * Vec3::Unit(k);
      divergence += (v(x + step) - v(x - step))[k] / 2e-5;
    }
    EXPECT_NEAR(divergence, 0.0, 1e-9);
  }
  const Vec3 n = Vec3(0.5, 0.3, -0.7).normalized();
  EXPECT_LT(v(5.0 * n).norm(), 1e-12);
  EXPECT_LT((v((1.0 - 1e-12) * n) - v((1.0 + 1e-12) * n)).norm(), 1e-12);
  EXPECT_NEAR(v(n).dot(n), -mode.rate().real() * f0 * std::legendre(2, n.x()), 1e-13);
}

}  // namespace
}  // namespace meniscus::test
