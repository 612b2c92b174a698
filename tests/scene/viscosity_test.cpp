#include "meniscus/scene/viscosity.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace meniscus {
namespace {

const CarreauYasuda carreau{
    .time_constant = 2.0, .power_index = 0.4, .yasuda_exponent = 2.0, .infinite_ratio = 0.1};
const PowerLaw power_law{.power_index = 0.5, .floor = 0.01, .ceiling = 20.0};

double value(const ViscosityLaw& law, double rate) { return relative_viscosity(law, rate).value; }
double slope(const ViscosityLaw& law, double rate) { return relative_viscosity(law, rate).slope; }

TEST(Viscosity, OfANewtonianLiquidIsConstant) {
  for (const double rate : {0.0, 1e-9, 1.0, 1e9}) {
    EXPECT_EQ(value(Newtonian{}, rate), 1.0);
    EXPECT_EQ(slope(Newtonian{}, rate), 0.0);
  }
}

TEST(Viscosity, OfCarreauPassesFromItsLimitAtRestToThatAtInfinity) {
  EXPECT_EQ(value(carreau, 0.0), 1.0);
  EXPECT_EQ(slope(carreau, 0.0), 0.0);
  // (2·1)² = 4: 0.1 + 0.9·5^(−0.3); rate 5: (2·5)² = 100
  EXPECT_NEAR(value(carreau, 1.0), 0.1 + 0.9 * std::pow(5.0, -0.3), 1e-15);
  EXPECT_NEAR(value(carreau, 5.0), 0.1 + 0.9 * std::pow(101.0, -0.3), 1e-15);
  EXPECT_NEAR(value(carreau, 1e30), 0.1, 1e-12);
  EXPECT_NEAR(slope(carreau, 1e30), 0.0, 1e-12);
  EXPECT_TRUE(std::isfinite(value(carreau, 1e300)));  // its square is not
  EXPECT_TRUE(std::isfinite(slope(carreau, 1e300)));
  // Without a limit at infinity the slope tends to n − 1; with a = 1 (Cross's form) slowly at rest.
  CarreauYasuda cross = carreau;
  cross.infinite_ratio = 0.0;
  cross.yasuda_exponent = 1.0;
  EXPECT_NEAR(slope(cross, 1e12), -0.6, 1e-12);
  EXPECT_NEAR(value(cross, 0.5), std::pow(2.0, -0.6), 1e-15);
}

TEST(Viscosity, OfAPowerLawStaysInItsBounds) {
  EXPECT_NEAR(value(power_law, 4.0), 0.5, 1e-15);
  EXPECT_EQ(slope(power_law, 4.0), -0.5);
  EXPECT_EQ(value(power_law, 0.0), 20.0);
  EXPECT_EQ(slope(power_law, 0.0), 0.0);
  EXPECT_EQ(value(power_law, 1e6), 0.01);
  EXPECT_EQ(slope(power_law, 1e6), 0.0);
  const PowerLaw thickening{.power_index = 1.5, .floor = 0.1, .ceiling = 10.0};
  EXPECT_EQ(value(thickening, 0.0), 0.1);
  EXPECT_NEAR(value(thickening, 4.0), 2.0, 1e-15);
  EXPECT_EQ(value(thickening, 1e6), 10.0);
}

// The slope is the derivative of the value, and the stress grows with the rate.
TEST(Viscosity, SlopesAreDerivativesAndExceedMinusOne) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> exponent(-3.0, 3.0), index(0.1, 2.0), yasuda(0.5, 4.0),
      ratio(0.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const CarreauYasuda law{.time_constant = std::exp(exponent(random)),
                            .power_index = index(random),
                            .yasuda_exponent = yasuda(random),
                            .infinite_ratio = ratio(random)};
    const double rate = std::exp(exponent(random)), step = 1e-5;
    const double difference = (std::log(value(law, rate * std::exp(step))) -
                               std::log(value(law, rate * std::exp(-step)))) /
                              (2.0 * step);
    // The error of central differences, step², and roundoff, 1e-16/step
    EXPECT_NEAR(slope(law, rate), difference, 1e-9) << "seed 11, draw " << i;
    EXPECT_GT(slope(law, rate), -1.0);
    EXPECT_GT(rate * 1.01 * value(law, rate * 1.01), rate * value(law, rate));
  }
}

TEST(Viscosity, LawsAreComparedByTheirNumbers) {
  EXPECT_EQ(ViscosityLaw{carreau}, ViscosityLaw{carreau});
  EXPECT_NE(ViscosityLaw{carreau}, ViscosityLaw{power_law});
  PowerLaw other = power_law;
  other.ceiling = 21.0;
  EXPECT_NE(ViscosityLaw{power_law}, ViscosityLaw{other});
  EXPECT_TRUE(is_newtonian(ViscosityLaw{}));
  EXPECT_FALSE(is_newtonian(ViscosityLaw{carreau}));
}

}  // namespace
}  // namespace meniscus
