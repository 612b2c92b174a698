// Generalised-Newtonian liquids between plates and in a pipe, against the exact profiles.
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "meniscus/flow/fem/elements.hpp"
#include "meniscus/flow/fem/stokes_residual.hpp"
#include "meniscus/flow/fem/stokes_solver.hpp"
#include "tests/flow/fem/as_quadratic.hpp"
#include "tests/flow/fem/pipe_mesh.hpp"
#include "tests/flow/fem/straight_space.hpp"

namespace meniscus::fem {
namespace {

/// A law as the program has it, and its viscosity written down once more for the exact profile.
struct TestLaw {
  ViscosityLaw law;
  std::function<double(double)> viscosity;
};

const TestLaw carreau{
    CarreauYasuda{.time_constant = 2.0, .power_index = 0.4, .infinite_ratio = 0.05},
    [](double rate) { return 0.05 + 0.95 * std::pow(1.0 + 4.0 * rate * rate, -0.3); }};
const TestLaw power_law{
    PowerLaw{.power_index = 0.5, .floor = 1e-3, .ceiling = 1e3},
    [](double rate) { return std::min(1e3, std::max(1e-3, 1.0 / std::sqrt(rate))); }};

/// Flow driven by a pressure gradient whose shear stress at distance s from the middle is
/// slope · s, at rest at s = 1: v(s) = ∫_s^1 γ̇ ds with μ(γ̇) γ̇ = slope · s.
class Profile {
 public:
  Profile(const std::function<double(double)>& viscosity, double slope) {
    std::vector<double> rate;
    for (std::size_t i = 0; i <= kPanels + kBeyond; ++i)
      for (const double part : {0.0, 0.5})
        rate.push_back(rate_at((double(i) + part) * kWidth * slope, viscosity));
    rate_.resize(kPanels + kBeyond + 1);
    for (std::size_t i = 0; i < rate_.size(); ++i) rate_[i] = rate[2 * i];
    // Simpson's rule on each panel, from the wall.
    velocity_.assign(rate_.size(), 0.0);
    const auto panel = [&](std::size_t i) {
      return kWidth / 6.0 * (rate[2 * i] + 4.0 * rate[2 * i + 1] + rate[2 * i + 2]);
    };
    for (std::size_t i = kPanels; i > 0; --i) velocity_[i - 1] = velocity_[i] + panel(i - 1);
    for (std::size_t i = kPanels; i + 1 < rate_.size(); ++i)
      velocity_[i + 1] = velocity_[i] - panel(i);
  }
  /// By the cubic that has the values and slopes of the panel's ends.
  [[nodiscard]] double operator()(double s) const {
    const auto i = std::min(static_cast<std::size_t>(s / kWidth), rate_.size() - 2);
    const double t = s / kWidth - double(i), u = 1.0 - t;
    return u * u * (1.0 + 2.0 * t) * velocity_[i] + t * t * (1.0 + 2.0 * u) * velocity_[i + 1] +
           kWidth * t * u * (t * rate_[i + 1] - u * rate_[i]);
  }

 private:
  static constexpr std::size_t kPanels = 4000, kBeyond = 40;  // curved faces reach past the wall
  static constexpr double kWidth = 1.0 / kPanels;

  static double rate_at(double stress, const std::function<double(double)>& viscosity) {
    double low = 0.0, high = 1.0;
    while (viscosity(high) * high < stress) high *= 2.0;
    for (int k = 0; k < 200 && low < high; ++k) {
      const double middle = 0.5 * (low + high);
      if (middle == low || middle == high) break;
      (viscosity(middle) * middle < stress ? low : high) = middle;
    }
    return high;
  }

  std::vector<double> rate_, velocity_;
};

/// v(s) for liquids whose profile is known in closed form.
TEST(GeneralisedProfile, IsThatOfTheTextbooks) {
  const Profile newtonian([](double) { return 2.0; }, 3.0);
  const Profile thinning([](double rate) { return 1.0 / std::sqrt(rate); }, 2.0);
  for (const double s : {0.0, 0.123, 0.5, 0.99, 1.0, 1.004}) {
    EXPECT_NEAR(newtonian(s), 0.75 * (1.0 - s * s), 1e-12);
    EXPECT_NEAR(thinning(s), 4.0 / 3.0 * (1.0 - s * s * s), 1e-12);  // γ̇ = (2 s)²
  }
}

/// A mesh with its distance from the middle, and where its boundary is.
struct Channel {
  TetMesh mesh;
  std::function<double(const Vec3&)> distance;
  std::function<bool(const Vec3&)> is_wall, is_end;  ///< at rest; with the exact profile
  bool is_round = false;
};

Channel plates(int n) {
  return {box_mesh({.n = n}).mesh, [](const Vec3& x) { return std::abs(x.y()); },
          [](const Vec3& x) { return std::abs(x.y()) > 1.0 - 1e-12; },
          [](const Vec3& x) { return x.cwiseAbs().maxCoeff() > 1.0 - 1e-12; }};
}

Channel pipe(int n) {
  // The middles of straight edges along the wall are this far from the axis; no other node is.
  const double chord = std::cos(std::numbers::pi / (6.0 * n));
  return {pipe_mesh(n), distance_from_axis,
          [chord](const Vec3& x) { return distance_from_axis(x) > chord - 1e-12; },
          [](const Vec3& x) { return std::abs(x.x()) > 0.5 - 1e-12; }, true};
}

/// ‖v − v_exact‖ in L2 over ‖v_exact‖.
double relative_error(const StokesProblem& problem, const StokesState& state,
                      const std::function<Vec3(const Vec3&)>& exact) {
  if (problem.space.elements == Elements::p1_p1) {
    const AsQuadratic quadratic(problem, state);
    return relative_error(quadratic.problem, quadratic.state, exact);
  }
  const NodePositions positions = all_curved(problem.positions);
  QuadraticElement element(problem.space, positions);
  double squared = 0.0, whole = 0.0;
  for (const CellId c : problem.mesh.cells.ids()) {
    const auto nodes = problem.space.velocity.of(c);
    for (const auto& point : element.points(c)) {
      Vec3 x = Vec3::Zero(), v = Vec3::Zero();
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        x += point.value[i] * positions.x[NodeId{nodes[i]}];
        v += point.value[i] * state.v[NodeId{nodes[i]}];
      }
      squared += point.weight * (v - exact(x)).squaredNorm();
      whole += point.weight * exact(x).squaredNorm();
    }
  }
  return std::sqrt(squared / whole);
}

struct Outcome {
  double error = 0.0;
  StokesReport report;
};

Outcome flow(const Channel& channel, Elements elements, const TestLaw& law) {
  const FlowSpace space = flow_space(channel.mesh, elements);
  NodePositions positions = straight_positions(channel.mesh, space);
  if (channel.is_round) bend_pipe_wall(channel.mesh, space, positions);
  StokesProblem problem(channel.mesh, space, positions);
  problem.laws.add(law.law);
  const Profile profile(law.viscosity, 2.0);
  const auto exact = [&](const Vec3& x) { return Vec3(profile(channel.distance(x)), 0.0, 0.0); };
  for (const NodeId i : positions.x.ids()) {
    const Vec3& x = positions.x[i];
    if (channel.is_wall(x))
      problem.constraints.fix(i, Vec3::Zero());
    else if (channel.is_end(x))
      problem.constraints.fix(i, exact(x));
  }
  Options options;
  options.elements = elements;
  options.rtol = 1e-11;
  StokesSolver solver(space, options);
  StokesState state = solver.state_at_rest();
  PhaseTimes times;
  Outcome outcome;
  outcome.report = solver.solve(problem, state, linear::Preconditioner::fresh, times);
  outcome.error = relative_error(problem, state, exact);
  return outcome;
}

/// Newton's last two steps lower the residual r, over that of rest, to less than C r², down to what
/// the linear solver leaves of the tolerance of 1e-11. C is 3 for Carreau's law in P1 and grows to
/// 500 for the power law, which has a thousandth of the others' rates in the middle of the channel.
void expect_quadratic_end(const StokesReport& report) {
  const std::size_t count = report.residuals.size();
  ASSERT_GE(report.newton_steps, 3);
  for (std::size_t k = count - 3; k + 1 < count; ++k) {
    const double before = report.residuals[k] / report.reference,
                 after = report.residuals[k + 1] / report.reference;
    EXPECT_LT(after, 500.0 * before * before + 2e-11) << "from " << before;
  }
}

struct Setting {
  Elements elements;
  const TestLaw* law;
  Channel (*channel)(int);
};

class GeneralisedFlow : public testing::TestWithParam<Setting> {};
INSTANTIATE_TEST_SUITE_P(All, GeneralisedFlow,
                         testing::Values(Setting{Elements::p1_p1, &carreau, plates},
                                         Setting{Elements::p1_p1, &power_law, plates},
                                         Setting{Elements::p2_p1, &carreau, plates},
                                         Setting{Elements::p2_p1, &power_law, plates},
                                         Setting{Elements::p1_p1, &carreau, pipe},
                                         Setting{Elements::p1_p1, &power_law, pipe},
                                         Setting{Elements::p2_p1, &carreau, pipe},
                                         Setting{Elements::p2_p1, &power_law, pipe}));

TEST_P(GeneralisedFlow, ConvergesToTheExactProfile) {
  const auto [elements, law, channel] = GetParam();
  const bool is_quadratic = elements == Elements::p2_p1;
  const std::vector<int> sizes =
      channel == plates ? (is_quadratic ? std::vector{4, 6, 8} : std::vector{6, 10, 16})
                        : (is_quadratic ? std::vector{3, 4, 6} : std::vector{4, 7, 12});
  std::vector<double> errors;
  for (const int n : sizes) {
    const Outcome outcome = flow(channel(n), elements, *law);
    ASSERT_TRUE(outcome.report.ok()) << outcome.report.text();
    EXPECT_TRUE(outcome.report.failed_solvers.empty());
    expect_quadratic_end(outcome.report);
    errors.push_back(outcome.error);
  }
  const double order = std::log(errors.front() / errors.back()) /
                       std::log(double(sizes.back()) / double(sizes.front()));
  EXPECT_NEAR(order, is_quadratic ? 3.0 : 2.0, 0.2);
}

// Straight edges along the wall are O(h²) off it, whatever the velocity's degree.
TEST(GeneralisedPipeFlow, OfOrderThreeInAPipeNeedsARoundWall) {
  std::vector<double> errors;
  for (const int n : {3, 5}) {
    Channel straight = pipe(n);
    straight.is_round = false;
    const Outcome outcome = flow(straight, Elements::p2_p1, carreau);
    ASSERT_TRUE(outcome.report.ok()) << outcome.report.text();
    errors.push_back(outcome.error);
  }
  EXPECT_LT(std::log(errors[0] / errors[1]) / std::log(5.0 / 3.0), 2.5);
}

}  // namespace
}  // namespace meniscus::fem
