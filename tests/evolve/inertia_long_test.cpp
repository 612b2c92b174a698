#include <cmath>
#include <iostream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/evolve/boundary_integral_run.hpp"
#include "tests/evolve/oscillating_drop.hpp"

namespace meniscus::test {
namespace {

using Complex = std::complex<double>;

void expect_rate(const OscillatingDrop& drop, double tolerance) {
  const Complex exact = OscillationMode(drop.of, drop.guess).rate(), found = fitted_rate(drop);

  const auto text = [&] {
    return fmt::format(
        "La = {}, λ = {}, ρ̂ = {}, E0 = {}: s = {:.6g}, {:.6g} for {:.6g}, {:.6g}: "
        "{:+.3f} %, {:+.3f} %",
        drop.of.La, drop.of.lambda, drop.of.density_ratio, drop.of.E0, found.real(), found.imag(),
        exact.real(), exact.imag(), 100.0 * (found.real() / exact.real() - 1.0),
        100.0 * (found.imag() / exact.imag() - 1.0));
  };
  std::cout << text() << std::endl;
  EXPECT_NEAR(found.real() / exact.real(), 1.0, tolerance) << text();
  EXPECT_NEAR(found.imag() / exact.imag(), 1.0, tolerance) << text();
}

TEST(InertiaLong, OscillatesAtTheModesRate) {
  expect_rate({.of = {.La = 10.0, .b = 5.0}, .guess = {0.33, 0.31}}, 0.01);
  expect_rate({.of = {.La = 100.0, .b = 5.0}, .guess = {0.059, 0.174}}, 0.01);
  expect_rate({.of = {.La = 1000.0, .b = 5.0}, .guess = {0.0089, 0.062}, .nodes = 400}, 0.01);
}

// The layer within a drop of a tenth of the viscosity is 0.07 R0 thick. A drop of ten times the
// viscosity swings at La = 1000; at 100 its shape's rates are real.
TEST(InertiaLong, OscillatesWithOtherLiquids) {
  expect_rate({.of = {.La = 100.0, .lambda = 0.1, .b = 5.0}, .guess = {0.04, 0.18}, .nodes = 800},
              0.01);
  expect_rate({.of = {.La = 1000.0, .lambda = 10.0, .b = 5.0}, .guess = {0.0255, 0.0542}}, 0.01);
  expect_rate({.of = {.La = 100.0, .density_ratio = 0.1, .b = 5.0}, .guess = {0.09, 0.23}}, 0.01);
  expect_rate({.of = {.La = 100.0, .density_ratio = 10.0, .b = 5.0}, .guess = {0.0105, 0.08}},
              0.01);
}

TEST(InertiaLong, OscillatesWithSurfactant) {
  expect_rate({.of = {.La = 100.0, .b = 5.0, .E0 = 0.25}, .guess = {0.0755, 0.178}}, 0.01);
  expect_rate({.of = {.La = 100.0, .b = 5.0, .E0 = 0.5, .D_s = 0.1}, .guess = {0.0615, 0.1697}},
              0.01);
  expect_rate({.of = {.La = 100.0, .b = 5.0, .E0 = 5.0}, .guess = {0.0596, 0.158}}, 0.01);
}

// The balanced form gives a sphere's constant curvature no flow. After a hundred capillary times
// what is left is the solver's tolerance.
TEST(InertiaLong, AStaticDropStaysAtRest) {
  for (const double La : {12000.0, 1e6}) {
    const Case c = parse_case(
        fmt::format("[flow]\nkind = \"quiescent\"\nreynolds-number = {}\n[[drop]]\nradius = 1\n"
                    "nodes = 110\nviscosity-ratio = 1\ndensity-ratio = 1\n[interface]\n"
                    "surface-tension = \"balanced\"\n[domain]\nhalf-width = 4\n[time]\nend = {}\n"
                    "max-step = {}\n",
                    La, 100.0 * std::sqrt(La), 0.4 * std::sqrt(La)),
        "drop.toml");
    double largest = 0.0;
    const Report report = run(
        c, build_scene(c), [](EvolutionOptions&) {},
        [&](const Evolution& evolution) {
          largest = 0.0;
          for (const Vec3& v : evolution.flow().nodal->v) largest = std::max(largest, v.norm());
        });
    EXPECT_TRUE(report.ok()) << report.text();
    std::cout << "La = " << La << ": " << largest << std::endl;
    EXPECT_LT(largest, 1e-6);
  }
}

}  // namespace
}  // namespace meniscus::test
