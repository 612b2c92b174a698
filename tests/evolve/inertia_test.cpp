#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/evolve/boundary_integral_run.hpp"
#include "tests/evolve/oscillating_drop.hpp"

namespace meniscus::test {
namespace {

const OscillatingDrop kSmallDrop{
    .of = {.La = 100.0, .b = 5.0}, .guess = {0.059, 0.174}, .nodes = 60, .steps = 24.0};

TEST(InertialDrop, RelaxesAtTheModesRateWhereInertiaIsSmall) {
  const OscillatingDrop drop{.of = {.La = 0.01, .b = 5.0}, .guess = {0.46, 0.0}, .nodes = 110};
  const std::complex<double> exact = OscillationMode(drop.of, drop.guess).rate();
  EXPECT_NEAR(exact.imag(), 0.0, 1e-9);
  EXPECT_NEAR(decay_rate(drop, 0.1, 10) / exact.real(), 1.0, 0.01);
}

constexpr const char* kLinearElements = "[solver]\nelements = \"P1-P1\"\n";

// Large enough for flat faces, whose own shape of rest is no sphere.
TEST(InertialDrop, OfLinearElementsOscillatesNearTheModesRate) {
  OscillatingDrop drop = kSmallDrop;
  drop.nodes = 200;
  drop.height = 0.05;
  drop.more = kLinearElements;
  const std::complex<double> exact = OscillationMode(drop.of, drop.guess).rate(),
                             found = fitted_rate(drop);
  EXPECT_NEAR(found.real() / exact.real(), 1.0, 0.15);
  EXPECT_NEAR(found.imag() / exact.imag(), 1.0, 0.02);
}

OscillatingDrop with_surfactant(OscillatingDrop drop) {
  drop.of.E0 = 0.5;
  drop.of.D_s = 0.01;
  drop.guess = {0.07, 0.16};
  return drop;
}

TEST(InertialDrop, OscillatesNearlyAtTheModesRate) {
  OscillatingDrop drop = kSmallDrop;
  drop.nodes = 110;
  const std::complex<double> exact = OscillationMode(drop.of, drop.guess).rate(),
                             found = fitted_rate(drop);
  EXPECT_NEAR(found.real() / exact.real(), 1.0, 0.03);
  EXPECT_NEAR(found.imag() / exact.imag(), 1.0, 0.01);
}

// The surfactant is carried by linear elements, whose errors here are those of the flow thrice
// over.
TEST(InertialDrop, OscillatesWithSurfactantNearlyAtTheModesRate) {
  OscillatingDrop drop = with_surfactant(kSmallDrop);
  drop.nodes = 110;
  const std::complex<double> exact = OscillationMode(drop.of, drop.guess).rate(),
                             found = fitted_rate(drop);
  EXPECT_GT(exact.real(), 1.15 * OscillationMode(kSmallDrop.of, kSmallDrop.guess).rate().real());
  EXPECT_NEAR(found.real() / exact.real(), 1.0, 0.03);
  EXPECT_NEAR(found.imag() / exact.imag(), 1.0, 0.03);
}

void expect_second_order(OscillatingDrop drop) {
  std::vector<double> f;
  drop.periods = 0.5;
  for (const double steps : {12.0, 24.0, 48.0}) {
    drop.steps = steps;
    f.push_back(last_height(drop));
  }
  EXPECT_NEAR(std::log2((f[0] - f[1]) / (f[1] - f[2])), 2.0, 0.3);
}

TEST(InertialDrop, IsOfSecondOrderInTime) { expect_second_order(kSmallDrop); }

TEST(InertialDrop, IsOfSecondOrderInTimeWithSurfactant) {
  expect_second_order(with_surfactant(kSmallDrop));
}

constexpr const char* kBubble =
    "[flow]\nkind = \"quiescent\"\nreynolds-number = 20\ngravity = [0, -2, 0]\n"
    "[domain]\nhalf-width = 3\nnodes = 150\n[time]\nend = 4\nmax-step = 0.1\n"
    "[[drop]]\nradius = 1\nnodes = 60\nviscosity-ratio = 0.5\ndensity-ratio = 0.2\n";

// At the end, by quadratic elements of 220 vertices; by linear ones of 60 slower by a sixth.
constexpr double kSpeedOfBubble = 0.15646, kSpeedOfLinearBubble = 0.132;

Evolution evolution_of(const std::string& text) {
  const Case c = parse_case(text, "case.toml");
  return {build_scene(c), c.evolution, make_flow_solver(c), make_moving_mesh(c)};
}
/// `more` goes on with the bubble's table.
Evolution bubble(const std::string& more = "") { return evolution_of(kBubble + more); }

void step(Evolution& evolution) {
  const Report solved = evolution.solve();
  ASSERT_TRUE(solved.ok()) << solved.text();
  const Report advanced = evolution.advance();
  ASSERT_TRUE(advanced.ok()) << advanced.text();
}

/// The rows at the end.
Rows run_to_end(Evolution evolution) {
  EXPECT_TRUE(evolution.prepare().ok());
  while (!evolution.is_finished() && !testing::Test::HasFailure()) step(evolution);
  EXPECT_TRUE(evolution.solve().ok());
  return evolution.rows();
}
double speed(const Rows& rows) { return rows.drops[0].motion->velocity.y(); }

void expect_balance(const Rows& rows) {
  EXPECT_LT(std::abs(*rows.history.power_residual()), 0.03 * *rows.history.power_in);
}

TEST(InertialDrop, RisesWithTheBooksInBalance) {
  const Rows rows = run_to_end(bubble());
  EXPECT_NEAR(speed(rows), kSpeedOfBubble, 0.0005);
  EXPECT_GT(rows.drops[0].motion->reynolds, 0.4);
  EXPECT_GT(rows.history.kinetic->energy, 0.0);
  expect_balance(rows);
}

TEST(InertialDrop, OfLinearElementsRisesWithTheBooksInBalance) {
  const Rows rows = run_to_end(bubble(kLinearElements));
  EXPECT_NEAR(speed(rows), kSpeedOfLinearBubble, 0.002);
  EXPECT_NEAR(kSpeedOfLinearBubble, kSpeedOfBubble, 0.18 * kSpeedOfBubble);
  expect_balance(rows);
}

TEST(InertialDrop, OfLinearElementsStaysNearlyAtRest) {
  Evolution evolution = evolution_of(
      fmt::format("[flow]\nkind = \"quiescent\"\nreynolds-number = 12000\n[[drop]]\n"
                  "radius = 1\nnodes = 110\nviscosity-ratio = 1\ndensity-ratio = 1\n"
                  "[interface]\nsurface-tension = \"balanced\"\n[domain]\nhalf-width = 4\n"
                  "[time]\nend = 1095\nmax-step = 44\n{}",
                  kLinearElements));
  EXPECT_TRUE(evolution.prepare().ok());
  double largest = 0.0;
  while (!evolution.is_finished() && !HasFailure()) {
    step(evolution);
    largest = 0.0;
    for (const Vec3& v : evolution.state().flow->v) largest = std::max(largest, v.norm());
  }
  EXPECT_LT(largest, 1e-4);
}

/// How fast the bubble rises by some elements.
struct BubbleBy {
  const char* elements;
  double speed;
};
void PrintTo(const BubbleBy& of, std::ostream* out) {
  *out << (*of.elements == '\0' ? "P2-P1" : "P1-P1");
}
class BubbleByElements : public testing::TestWithParam<BubbleBy> {};
INSTANTIATE_TEST_SUITE_P(InertialDrop, BubbleByElements,
                         testing::Values(BubbleBy{"", kSpeedOfBubble},
                                         BubbleBy{kLinearElements, kSpeedOfLinearBubble}));

TEST_P(BubbleByElements, RisesFasterWhereTheMatrixThins) {
  const auto [elements, newtonian] = GetParam();
  const Rows rows =
      run_to_end(bubble("[matrix]\nviscosity-law = \"carreau-yasuda\"\npower-index = 0.5\n"
                        "time-constant = 30\n" +
                        std::string(elements)));
  expect_balance(rows);
  EXPECT_GT(speed(rows), 1.05 * newtonian);
}

TEST_P(BubbleByElements, RisesSlowerWithSurfactant) {
  const auto [elements, clean] = GetParam();
  const std::string surfactant =
      "[drop.surfactant]\nelasticity = 0.5\npeclet = 100\n" + std::string(elements);
  Evolution begun = bubble(surfactant);
  EXPECT_TRUE(begun.prepare().ok() && begun.solve().ok());
  const Rows rows = run_to_end(bubble(surfactant));
  EXPECT_NEAR(rows.drops[0].surfactant->amount, begun.rows().drops[0].surfactant->amount, 1e-11);
  EXPECT_LT(speed(rows), 0.97 * clean);
}

/// D of drop 0 at a time that the last step passes, from the parabola through the last three rows.
double deformation_at(double t, Evolution evolution) {
  std::vector<double> times, D;
  EXPECT_TRUE(evolution.prepare().ok());
  while (!testing::Test::HasFailure()) {
    EXPECT_TRUE(evolution.solve().ok());
    times.push_back(evolution.t());
    D.push_back(evolution.rows().drops[0].shape.D_inertia);
    if (evolution.is_finished()) break;
    EXPECT_TRUE(evolution.advance().ok());
  }
  double result = 0.0;
  for (std::size_t a = D.size() - 3; a < D.size(); ++a) {
    double weight = 1.0;
    for (std::size_t b = D.size() - 3; b < D.size(); ++b)
      if (b != a) weight *= (t - times[b]) / (times[a] - times[b]);
    result += weight * D[a];
  }
  return result;
}

TEST(InertialDrop, ThinsInShearAsInStokesFlowWhereInertiaIsSmall) {
  const auto deformation = [](const std::string& more) {
    return deformation_at(
        1.0,
        evolution_of("[flow]\nkind = \"simple-shear\"\ncapillary-number = 0.3\n" + more +
                     "[domain]\nhalf-width = 4\nnodes = 150\n[time]\nend = 1\ntolerance = 0.003\n"
                     "[[drop]]\nradius = 1\nnodes = 110\nviscosity-law = \"carreau-yasuda\"\n"
                     "power-index = 0.4\ntime-constant = 2\nviscosity-ratio = 3\n"));
  };
  EXPECT_NEAR(deformation("reynolds-number = 0.001\n") / deformation(""), 1.0, 0.003);
}

/// Steady speed of a drop at the centre of a sphere without slip, both liquids of one viscosity,
/// over what drives it, (4π/3)(ρ̂ − 1)Bo. Stream functions f(r) sin²θ with f = C/r + Dr + Er² + Fr⁴
/// outside and Ar⁴ + Br² within; the drag is 8πD.
double speed_in_sphere(double b) {
  Eigen::Matrix<double, 6, 6> conditions = Eigen::Matrix<double, 6, 6>::Zero();
  const auto outside = [](double r) {
    Eigen::Matrix<double, 3, 4> f;           // and its derivatives
    f << 1.0 / r, r, r * r, std::pow(r, 4),  //
        -1.0 / (r * r), 1.0, 2.0 * r, 4.0 * r * r * r, 2.0 / (r * r * r), 0.0, 2.0, 12.0 * r * r;
    return f;
  };
  Eigen::Matrix<double, 3, 2> inside;
  inside << 1.0, 1.0, 4.0, 2.0, 12.0, 2.0;
  conditions.block<2, 4>(0, 0) = outside(b).topRows(2);
  conditions.block<1, 4>(2, 0) = outside(1.0).row(0);
  conditions.block<1, 2>(3, 4) = inside.row(0);
  conditions.block<2, 4>(4, 0) = outside(1.0).bottomRows(2);
  conditions.block<2, 2>(4, 4) = -inside.bottomRows(2);
  Eigen::Vector<double, 6> right = Eigen::Vector<double, 6>::Zero();
  right[2] = right[3] = 0.5;
  return 1.0 / (8.0 * std::numbers::pi * conditions.fullPivLu().solve(right)[1]);
}

TEST(InertialDrop, SinksAsInStokesFlowWhereInertiaIsSmall) {
  const Case c = parse_case(
      "[flow]\nkind = \"quiescent\"\nreynolds-number = 0.01\ngravity = [0, 0, -0.1]\n[[drop]]\n"
      "radius = 1\nnodes = 110\nviscosity-ratio = 1\ndensity-ratio = 1.1\n[domain]\n"
      "shape = \"sphere\"\nradius = 5\n[time]\nend = 3\n",
      "sinking.toml");
  Evolution evolution(build_scene(c), c.evolution, make_flow_solver(c), make_moving_mesh(c));
  ASSERT_TRUE(evolution.prepare().ok());
  while (!evolution.is_finished()) step(evolution);
  ASSERT_TRUE(evolution.solve().ok());
  const double exact = -speed_in_sphere(5.0) * 4.0 / 3.0 * std::numbers::pi * 0.1 * 0.1;
  EXPECT_NEAR(exact, -0.001693013, 1e-9);
  EXPECT_NEAR(evolution.rows().drops[0].motion->velocity.z() / exact, 1.0, 0.005);
}

TEST(InertialDrop, AJumpOfTheFlowIsSaid) {
  const auto jumps = [](const std::string& ramp) {
    const Case c = parse_case(
        "[flow]\nkind = \"simple-shear\"\ncapillary-number = 0.2\nreynolds-number = 1\n"
        "[[flow.schedule]]\ntime = 2\nkind = \"quiescent\"\n" +
            ramp + "[[drop]]\nradius = 1\nnodes = 42\n[domain]\nhalf-width = 3\n[time]\nend = 4\n",
        "cessation.toml");
    Evolution evolution(build_scene(c), c.evolution, make_flow_solver(c), make_moving_mesh(c));
    EXPECT_TRUE(evolution.prepare().ok());
    return std::ranges::count_if(evolution.notices(), [](const Notice& notice) {
      return std::holds_alternative<FlowJump>(notice.what);
    });
  };
  EXPECT_EQ(jumps(""), 1);
  EXPECT_EQ(jumps("ramp = 0.5\n"), 0);
}

/// The bubble with another viscosity.
std::string bubble_of_viscosity(const std::string& value) {
  std::string text = kBubble;
  const std::string key = "viscosity-ratio = ";
  return text.replace(text.find(key) + key.size(), 3, value);
}

void expect_to_go_on_from_a_checkpoint(const std::string& text) {
  Evolution whole = evolution_of(text);
  ASSERT_TRUE(whole.prepare().ok());
  for (int k = 0; k < 3; ++k) step(whole);
  Archive archive;
  whole.save(archive);
  Evolution resumed = evolution_of(text);
  resumed.load(archive);
  Archive at_end, at_end_too;
  step(whole);
  step(resumed);
  whole.save(at_end);
  resumed.save(at_end_too);
  EXPECT_EQ(at_end.reals, at_end_too.reals);
  EXPECT_EQ(at_end.integers, at_end_too.integers);
}

TEST(InertialDrop, GoesOnFromACheckpointToTheSameBits) {
  expect_to_go_on_from_a_checkpoint(kBubble);
  expect_to_go_on_from_a_checkpoint(std::string(kBubble) + kLinearElements);
}

// Its slow motions are found by products in which the liquid convects.
TEST(InertialDrop, OfHighViscosityGoesOnFromACheckpointToTheSameBits) {
  expect_to_go_on_from_a_checkpoint(bubble_of_viscosity("100"));
  expect_to_go_on_from_a_checkpoint(bubble_of_viscosity("100") + kLinearElements);
}

}  // namespace
}  // namespace meniscus::test
