#include "tests/flow/fem/lamb_mode.hpp"

#include <gtest/gtest.h>

namespace meniscus::fem {
namespace {

// Rates of linear relaxation in closed form,
// s_l = l(l−1)(l+1)(l+2)(2l+1)(λ+1)/{[2(λ+1)l² − 2λ + 1][2(λ+1)l² + 4(λ+1)l + 3λ]}.
double closed_form_rate(int l, double lambda) {
  const double k = lambda + 1.0;
  return l * (l - 1) * (l + 1) * (l + 2) * (2 * l + 1) * k /
         ((2 * k * l * l - 2 * lambda + 1) * (2 * k * l * l + 4 * k * l + 3 * lambda));
}

TEST(LambMode, RelaxesAtTheClosedFormRate) {
  for (const int l : {2, 3, 4, 5})
    for (const double lambda : {0.1, 1.0, 10.0})
      EXPECT_NEAR(relaxation_rate(l, lambda), closed_form_rate(l, lambda), 1e-12)
          << l << " " << lambda;
  EXPECT_NEAR(relaxation_rate(2, 1.0), 16.0 / 35.0, 1e-13);
  EXPECT_NEAR(relaxation_rate(3, 1.0), 16.0 / 21.0, 1e-13);
}

// Values of the closed rational function of λ and b for l = 2 inside a concentric sphere at rest,
// derived by computer algebra, to their printed digits.
TEST(LambMode, AConcentricWallSlowsIt) {
  EXPECT_NEAR(relaxation_rate(2, 1.0, 2.0), 0.27544643, 5e-9);
  EXPECT_NEAR(relaxation_rate(2, 1.0, 10.0), 0.45516677, 5e-9);
  EXPECT_NEAR(relaxation_rate(2, 0.1, 2.0), 0.41051841, 5e-9);
  EXPECT_NEAR(relaxation_rate(2, 0.1, 5.0), 0.73171643, 5e-9);
  EXPECT_NEAR(relaxation_rate(2, 10.0, 5.0), 0.0921217, 5e-8);
}

TEST(LambMode, IsDivergenceFreeAndAtRestOnTheWall) {
  const LambMode mode(3, 0.1, 5.0);
  const Vec3 x(1.3, -0.7, 2.1);
  const double step = 1e-4;
  double divergence = 0.0;
  for (int k = 0; k < 3; ++k)
    divergence +=
        (mode.velocity(x + step * Vec3::Unit(k))[k] - mode.velocity(x - step * Vec3::Unit(k))[k]) /
        (2 * step);
  EXPECT_NEAR(divergence, 0.0, 1e-8);  // step² times third derivatives of order one
  EXPECT_LT(mode.velocity(5.0 * x.normalized()).norm(), 1e-13);
}

}  // namespace
}  // namespace meniscus::fem
