#include <cmath>
#include <initializer_list>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "meniscus/flow/fem/linear_inertia.hpp"
#include "meniscus/flow/fem/stokes_solver.hpp"
#include "tests/flow/fem/as_quadratic.hpp"
#include "tests/flow/fem/straight_space.hpp"

namespace meniscus::fem {
namespace {

constexpr double kDensity = 2.0;

// A decaying Arnold–Beltrami–Childress flow: curl v = v, so that ∇²v = −v and v·∇v = ∇|v|²/2. With
// μ = 1 it is v = e^(−t/ρ) u(x), and p = −ρ|v|²/2.
Vec3 velocity(const Vec3& x, double t) {
  return std::exp(-t / kDensity) * Vec3(std::sin(x[2]) + 0.5 * std::cos(x[1]),
                                        0.7 * std::sin(x[0]) + std::cos(x[2]),
                                        0.5 * std::sin(x[1]) + 0.7 * std::cos(x[0]));
}
double pressure(const Vec3& x, double t) { return -0.5 * kDensity * velocity(x, t).squaredNorm(); }

/// A mesh of a box whose inner vertices move to and fro; its cells stay straight.
class MovingBox {
 public:
  MovingBox(int n, Elements elements, double way = 0.15)
      : box_(box_mesh({.n = n, .jitter = 0.1})), test_(box_.mesh, elements) {
    for (const TetVertexId v : box_.mesh.x.ids()) {
      double bubble = way;
      for (const double x : box_.mesh.x[v]) bubble *= std::cos(0.5 * std::numbers::pi * x);
      way_.add(bubble * Vec3(1.0, -1.0, 0.5));
    }
  }
  TetMesh mesh(double t) const {
    TetMesh mesh = box_.mesh;
    for (const TetVertexId v : mesh.x.ids()) mesh.x[v] += std::sin(4.0 * t) * way_[v];
    return mesh;
  }
  NodePositions positions(double t) const { return straight_positions(mesh(t), test_.space); }
  /// A stage of length τ that ends at t.
  StokesProblem problem(double t, double duration, const Field<NodeId, Vec3>& x_before,
                        Field<NodeId, Vec3> v_before) const {
    StokesProblem problem(box_.mesh, test_.space, positions(t));
    InertiaTerms terms{.duration = duration};
    terms.density = CellField<double>(box_.mesh.num_cells(), kDensity);
    terms.before = std::move(v_before);
    for (const NodeId i : x_before.ids())
      terms.mesh_velocity.add((problem.positions.x[i] - x_before[i]) / duration);
    problem.inertia = std::move(terms);
    for (const NodeId i : problem.positions.x.ids())
      if (const Vec3& x = problem.positions.x[i]; x.cwiseAbs().maxCoeff() > 1.0 - 1e-12)
        problem.constraints.fix(i, velocity(x, t));
    if (test_.space.elements == Elements::p1_p1) remember_divergence(problem);
    return problem;
  }
  [[nodiscard]] const FlowSpace& space() const { return test_.space; }
  [[nodiscard]] double edge() const {
    return std::cbrt(8.0 / static_cast<double>(box_.mesh.num_cells()));
  }

 private:
  BoxMesh box_;
  TestSpace test_;
  Field<TetVertexId, Vec3> way_;
};

Field<NodeId, Vec3> exact(const Field<NodeId, Vec3>& x, double t) {
  Field<NodeId, Vec3> v;
  for (const Vec3& each : x) v.add(velocity(each, t));
  return v;
}

Field<NodeId, Vec3> beyond(const Field<NodeId, Vec3>& from, const Field<NodeId, Vec3>& to,
                           double times) {
  Field<NodeId, Vec3> result;
  for (const NodeId i : from.ids()) result.add(from[i] + times * (to[i] - from[i]));
  return result;
}

/// What steps lead to.
struct Flow {
  StokesState at_end;
  /// (1 − γ)p₁ + γp₂ of the stages of each step: the pressure at its middle, to second order. That
  /// of a stage is of first order, as a scheme of stage order 1 has it (hairer1989).
  std::vector<std::vector<double>> middle_pressures;

  /// At the end of the last step, from the middles of the last two.
  [[nodiscard]] StokesState of_second_order() const {
    StokesState state = at_end;
    const auto& last = middle_pressures.back();
    const auto& previous = middle_pressures[middle_pressures.size() - 2];
    for (std::size_t i = 0; i < last.size(); ++i) state.p[i] = 1.5 * last[i] - 0.5 * previous[i];
    return state;
  }
};

/// Steps by the scheme of `implicit_step`, from exact velocities.
Flow flow_after(const MovingBox& box, double end, int num_steps) {
  const double gamma = 1.0 - std::sqrt(0.5), dt = end / num_steps, stage = gamma * dt;
  Options options;
  options.elements = box.space().elements;
  options.rtol = 1e-10;
  StokesSolver solver(box.space(), options);
  Flow flow{solver.state_at_rest(), {}};
  StokesState& state = flow.at_end;
  state.v = exact(box.positions(0.0).x, 0.0);
  const auto solve = [&](const StokesProblem& problem) {
    PhaseTimes times;
    const StokesReport report = solver.solve(problem, state, linear::Preconditioner::fresh, times);
    EXPECT_TRUE(report.ok()) << report.text();
  };
  if (box.space().elements == Elements::p1_p1) {  // which remember a divergence
    PhaseTimes times;
    const StokesProblem still = box.problem(0.0, 1.0, box.positions(0.0).x, state.v);
    const StokesReport report =
        solver.project(still, state.v, linear::Preconditioner::fresh, times);
    EXPECT_TRUE(report.ok()) << report.text();
  }
  for (int k = 0; k < num_steps; ++k) {
    const double t = k * dt, ahead = (1.0 - gamma) / gamma;
    const Field<NodeId, Vec3> x = box.positions(t).x, v = state.v;
    solve(box.problem(t + stage, stage, x, v));
    std::vector<double> pressure = state.p;
    solve(box.problem(t + dt, stage, beyond(x, box.positions(t + stage).x, ahead),
                      beyond(v, state.v, ahead)));
    for (std::size_t i = 0; i < pressure.size(); ++i)
      pressure[i] = (1.0 - gamma) * pressure[i] + gamma * state.p[i];
    flow.middle_pressures.push_back(std::move(pressure));
  }
  return flow;
}

struct Errors {
  double velocity = 0.0, pressure = 0.0;  ///< L2; pressure without its mean
};

/// Of a state of quadratic elements against what is exact, or against nothing.
Errors errors(const FlowSpace& space, const NodePositions& positions, const StokesState& state,
              double t, bool is_against_exact) {
  const NodePositions by_fine_rule = all_curved(positions);
  QuadraticElement element(space, by_fine_rule);
  Errors squared;
  double sum = 0.0, volume = 0.0;
  for (const CellId c : ids<CellId>(space.velocity.num_cells())) {
    const auto nodes = space.velocity.of(c), pressures = space.pressure.nodes.of(c);
    for (const auto& point : element.points(c)) {
      Vec3 x = Vec3::Zero(), v = Vec3::Zero();
      double p = 0.0;
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        x += point.value[i] * positions.x[NodeId{nodes[i]}];
        v += point.value[i] * state.v[NodeId{nodes[i]}];
      }
      for (std::size_t k = 0; k < 4; ++k)
        p += point.pressure[k] * state.p[static_cast<std::size_t>(pressures[k])];
      if (is_against_exact) v -= velocity(x, t), p -= pressure(x, t);
      squared.velocity += point.weight * v.squaredNorm();
      squared.pressure += point.weight * p * p;
      sum += point.weight * p;
      volume += point.weight;
    }
  }
  return {std::sqrt(squared.velocity), std::sqrt(squared.pressure - sum * sum / volume)};
}

/// Of one state against what is exact, or against another state.
Errors errors(const MovingBox& box, double t, const StokesState& state,
              const StokesState* reference = nullptr) {
  const TetMesh mesh = box.mesh(t);
  const StokesProblem problem(mesh, box.space(), box.positions(t));
  StokesState difference = state;
  for (const NodeId i : state.v.ids())
    if (reference != nullptr) difference.v[i] -= reference->v[i];
  for (std::size_t i = 0; i < state.p.size(); ++i)
    if (reference != nullptr) difference.p[i] -= reference->p[i];
  if (box.space().elements == Elements::p2_p1)
    return errors(box.space(), problem.positions, difference, t, reference == nullptr);
  const AsQuadratic same(problem, difference);
  return errors(same.space, same.problem.positions, same.state, t, reference == nullptr);
}

struct Orders {
  double velocity = 0.0, pressure = 0.0;
};
Orders orders(const Errors& coarse, const Errors& fine, double ratio) {
  return {std::log(coarse.velocity / fine.velocity) / std::log(ratio),
          std::log(coarse.pressure / fine.pressure) / std::log(ratio)};
}

/// From the coarsest to the finest mesh, in so many steps to the end.
Orders orders_in_space(Elements elements, std::initializer_list<int> sizes, double end, int steps) {
  std::vector<Errors> levels;
  std::vector<double> edges;
  for (const int n : sizes) {
    const MovingBox box(n, elements);
    levels.push_back(errors(box, end, flow_after(box, end, steps).of_second_order()));
    edges.push_back(box.edge());
  }
  return orders(levels.front(), levels.back(), edges.front() / edges.back());
}

/// From so many steps to four times as many.
Orders orders_in_time(const MovingBox& box, int least) {
  std::vector<StokesState> states;
  for (const int num_steps : {least, 2 * least, 4 * least})
    states.push_back(flow_after(box, 1.0, num_steps).of_second_order());
  return orders(errors(box, 1.0, states[0], &states[1]), errors(box, 1.0, states[1], &states[2]),
                2.0);
}

TEST(InertialFlow, ConvergesWithTheMesh) {
  const Orders order = orders_in_space(Elements::p2_p1, {3, 5, 8}, 0.1, 4);
  EXPECT_NEAR(order.velocity, 3.0, 0.3);
  EXPECT_NEAR(order.pressure, 2.0, 0.3);
}

TEST(InertialFlow, IsOfSecondOrderInTime) {
  const Orders order = orders_in_time(MovingBox(3, Elements::p2_p1), 8);
  EXPECT_NEAR(order.velocity, 2.0, 0.2);
  EXPECT_NEAR(order.pressure, 2.0, 0.3);
}

TEST(InertialFlow, OfLinearElementsConvergesWithTheMesh) {
  const Orders order = orders_in_space(Elements::p1_p1, {8, 16}, 0.1, 4);
  EXPECT_NEAR(order.velocity, 2.0, 0.15);
  EXPECT_GT(order.pressure, 1.5);
}

// What the stabilisation makes of the step is of first order in time, and a hundredth of the error
// in space.
TEST(InertialFlow, OfLinearElementsHardlyDependsOnTheStep) {
  const MovingBox box(3, Elements::p1_p1);
  const StokesState few = flow_after(box, 1.0, 8).of_second_order(),
                    many = flow_after(box, 1.0, 128).of_second_order();
  EXPECT_LT(errors(box, 1.0, few, &many).velocity, 0.01 * errors(box, 1.0, many).velocity);
  EXPECT_LT(errors(box, 1.0, few, &many).pressure, 0.03 * errors(box, 1.0, many).pressure);
}

/// The residual of the exact end of a stage v = D·x + wind after nodes went random ways, over that
/// of a liquid at rest. The force ρD²x leaves the pressure constant.
double residual_of(Elements elements, const Mat3& gradient, const Vec3& wind) {
  const MovingBox box(3, elements);
  const double duration = 0.3;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-0.1, 0.1);
  const NodePositions at = box.positions(0.0);
  Field<NodeId, Vec3> x_before = at.x, v_before;
  for (Vec3& x : x_before) x += Vec3(uniform(random), uniform(random), uniform(random));
  for (const Vec3& x : x_before) v_before.add(gradient * x + wind);
  StokesProblem problem = box.problem(0.0, duration, x_before, v_before);
  StokesState state = state_at_rest(problem.space);
  for (const NodeId i : at.x.ids()) {
    state.v[i] = gradient * at.x[i] + wind;
    if (problem.constraints.find(i) != nullptr) problem.constraints.fix(i, state.v[i]);
  }
  if (elements == Elements::p1_p1) {
    const double scale = free_norm(residual(problem, state_at_rest(problem.space)), problem);
    return free_norm(residual(problem, state), problem) / scale;
  }
  // ∫f·φ of a force that the elements hold: its mass, by a stage of length 1 from rest.
  StokesProblem masses = problem;
  masses.inertia->duration = 1.0;
  for (Vec3& v : masses.inertia->before) v.setZero();
  const StokesProduct product(masses);
  Field<NodeId, Vec3> f, whole(at.x.size(), Vec3::Zero()), stress = whole;
  for (const Vec3& x : at.x) f.add(gradient * gradient * x);
  std::vector<double> unused(state.p.size()), zero(state.p.size());
  product.add(numbers(f), zero, numbers(whole), unused);
  product.add_stress(numbers(f), zero, numbers(stress), unused);
  for (const NodeId i : f.ids()) problem.force[i] = whole[i] - stress[i];
  StokesProduct own(problem);
  const double scale = free_norm(residual(problem, state_at_rest(problem.space), &own), problem);
  own.convect(numbers(state.v));
  return free_norm(residual(problem, state, &own), problem) / scale;
}

TEST(InertialFlow, UniformAndLinearFlowsAreExactUnderAnyMotionOfTheMesh) {
  for (const Elements elements : {Elements::p1_p1, Elements::p2_p1}) {
    EXPECT_LT(residual_of(elements, Mat3::Zero(), Vec3(0.3, -0.2, 0.5)), 1e-12);
    EXPECT_LT(residual_of(elements, ImposedFlow::simple_shear(), Vec3::Zero()), 1e-12);
  }
  // Linear elements stabilise by forces of cells, not by those of nodes.
  EXPECT_LT(residual_of(Elements::p2_p1, Vec3(1.0, -0.5, -0.5).asDiagonal(), Vec3::Zero()), 1e-12);
}

}  // namespace
}  // namespace meniscus::fem
