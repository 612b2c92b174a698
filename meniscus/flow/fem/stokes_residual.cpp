#include "meniscus/flow/fem/stokes_residual.hpp"

#include <cmath>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/inertia_product.hpp"
#include "meniscus/flow/fem/linear_inertia.hpp"
#include "meniscus/flow/fem/partition.hpp"
#include "meniscus/linear/collective.hpp"

namespace meniscus::fem {
namespace {

/// What the one point of a linear cell adds to the terms of all elements: inertia, by the state's
/// own velocity, and stabilisation.
class LinearTerms {
 public:
  LinearTerms(const StokesProblem& problem, const StokesState& state,
              const CellState<LinearElement>& cell, const LinearElement::Point& point, CellId c)
      : tau_(stabilisation_parameter(problem, c, point.weight,
                                     viscosity_at(problem, c, cell.velocity_gradient(point)))),
        excess_(point.gradient * cell.p - problem.body_force[c]) {
    if (!problem.inertia) return;
    const LinearInertia inertia(problem, point, c, &state.v);
    inertia_ = inertia.momentum_of(cell.v);
    excess_ += inertia.mean_of(cell.v);
    if (!problem.inertia->remembered_divergence.empty())
      remembered_divergence_ = problem.inertia->remembered_divergence[c];
  }
  /// τ(ρDv/Dt + ∇p − f).
  [[nodiscard]] Vec3 slip() const { return tau_ * excess_; }
  /// ∫ρDv/Dt φ_i by columns.
  [[nodiscard]] const Eigen::Matrix<double, 3, 4>& inertia() const { return inertia_; }

  /// θ∫∇·v̄.
  [[nodiscard]] double remembered_divergence() const { return remembered_divergence_; }

 private:
  double tau_;
  Vec3 excess_;
  Eigen::Matrix<double, 3, 4> inertia_ = Eigen::Matrix<double, 3, 4>::Zero();
  double remembered_divergence_ = 0.0;
};

template <class Element>
void add_residual(const StokesProblem& problem, const StokesState& state, Element& element,
                  StokesResidual& result) {
  for (const CellId c : problem.mesh.cells.ids()) {
    const CellState<Element> cell(problem.space, state, c);
    const auto nodes = problem.space.velocity.of(c);
    const auto pressures = problem.space.pressure.nodes.of(c);
    for (const auto& point : element.points(c)) {
      const Mat3 gradient = cell.velocity_gradient(point);
      const double viscosity = viscosity_at(problem, c, gradient);
      const Mat3 stress =
          viscosity * (gradient + gradient.transpose()) - cell.pressure(point) * Mat3::Identity();
      for (std::size_t i = 0; i < Element::num_nodes; ++i)
        result.momentum[NodeId{nodes[i]}] +=
            point.weight * (stress * point.gradient.col(static_cast<Eigen::Index>(i)) -
                            point.value[i] * problem.body_force[c]);
      for (std::size_t k = 0; k < 4; ++k)
        result.continuity[static_cast<std::size_t>(pressures[k])] -=
            point.weight * point.pressure[k] * gradient.trace();
      if constexpr (Element::is_stabilized) {
        const LinearTerms linear(problem, state, cell, point, c);
        for (std::size_t k = 0; k < 4; ++k) {
          const auto column = static_cast<Eigen::Index>(k);
          result.momentum[NodeId{nodes[k]}] += linear.inertia().col(column);
          result.continuity[static_cast<std::size_t>(pressures[k])] +=
              0.25 * linear.remembered_divergence() -
              point.weight * linear.slip().dot(point.gradient.col(column));
        }
      }
    }
  }
}

template <class Element>
void subtract_body_force(const StokesProblem& problem, Element& element, StokesResidual& result) {
  for (const CellId c : problem.mesh.cells.ids()) {
    const Vec3& f = problem.body_force[c];
    if (f.isZero(0.0)) continue;
    const auto nodes = problem.space.velocity.of(c);
    for (const auto& point : element.points(c))
      for (std::size_t i = 0; i < nodes.size(); ++i)
        result.momentum[NodeId{nodes[i]}] -= point.weight * point.value[i] * f;
  }
}

/// Adds what tension does on the way that the interfaces go beyond the expected one.
void add_tension(const InertiaTerms& terms, const Field<NodeId, Vec3>& v,
                 Field<NodeId, Vec3>& momentum) {
  if (terms.tension.empty() && terms.elasticity.empty()) return;
  Field<NodeId, Vec3> beyond = v;
  for (const NodeId i : beyond.ids()) beyond[i] -= terms.interface_went[i];
  terms.add_tension(numbers(beyond), numbers(momentum));
}

StokesResidual residual_of_nothing(const StokesProblem& problem) {
  return {Field<NodeId, Vec3>(problem.force.size(), Vec3::Zero()),
          std::vector<double>(problem.space.pressure.vertex.size(), 0.0)};
}

template <class Element>
void add_cell_power(const StokesProblem& problem, const StokesState& state, Element& element,
                    StokesPower& power) {
  for (const CellId c : ids<CellId>(owned_counts(problem).num_cells)) {
    const CellState<Element> cell(problem.space, state, c);
    for (const auto& point : element.points(c)) {
      const Mat3 gradient = cell.velocity_gradient(point);
      const Mat3 rate = 0.5 * (gradient + gradient.transpose());
      power.dissipation +=
          point.weight * 2.0 * viscosity_at(problem, c, gradient) * rate.squaredNorm();
      if constexpr (Element::is_stabilized) {
        const LinearTerms linear(problem, state, cell, point, c);
        power.dissipation += point.weight * (point.gradient * cell.p).dot(linear.slip());
        power.kinetic_rate += linear.inertia().cwiseProduct(cell.v).sum();
      }
      power.body_force += point.weight * problem.body_force[c].dot(cell.velocity(point));
    }
  }
}

/// K v·v = ∫2μ D:D. Without inertia the residual is K v + G p − F − f, and G p·v = p·(−∫ψ∇·v). So
/// it follows from the residual. With inertia K v is found anew.
double dissipation(const StokesProblem& problem, const StokesState& state,
                   const StokesProduct& product, const StokesResidual& of_state,
                   const StokesResidual& minus_body_force) {
  const OwnedCounts owned = owned_counts(problem);
  double result = 0.0;
  if (problem.inertia) {
    const std::vector<double> no_pressure(state.p.size(), 0.0);
    StokesResidual viscous = residual_of_nothing(problem);
    product.add_stress(numbers(state.v), no_pressure, numbers(viscous.momentum),
                       viscous.continuity);
    for (const NodeId i : ids<NodeId>(owned.num_nodes))
      result += viscous.momentum[i].dot(state.v[i]);
    return result;
  }
  for (const NodeId i : ids<NodeId>(owned.num_nodes))
    result +=
        (of_state.momentum[i] - minus_body_force.momentum[i] + problem.force[i]).dot(state.v[i]);
  for (std::size_t i = 0; i < static_cast<std::size_t>(owned.num_pressures); ++i)
    result -= state.p[i] * of_state.continuity[i];
  return result;
}

/// ∫2μ D:D and ∫f·v.
void add_power(const StokesProblem& problem, const StokesState& state, const StokesProduct& product,
               const StokesResidual& of_state, StokesPower& power) {
  StokesResidual minus_body_force = residual_of_nothing(problem);
  with_element(problem.space, problem.positions,
               [&](auto& element) { subtract_body_force(problem, element, minus_body_force); });
  power.dissipation += dissipation(problem, state, product, of_state, minus_body_force);
  for (const NodeId i : ids<NodeId>(owned_counts(problem).num_nodes))
    power.body_force -= minus_body_force.momentum[i].dot(state.v[i]);
}

StokesResidual residual(const StokesProblem& problem, const StokesState& state,
                        const StokesProduct* product, bool is_near_rest) {
  MENISCUS_ASSERT(
      product != nullptr || !problem.inertia || problem.space.elements == Elements::p1_p1,
      "inertia without a product");
  StokesResidual result = residual_of_nothing(problem);
  const bool is_by_cells = product == nullptr || problem.is_generalised();
  with_element(problem.space, problem.positions, [&](auto& element) {
    if (is_by_cells)
      add_residual(problem, state, element, result);
    else
      subtract_body_force(problem, element, result);
  });
  if (!is_by_cells && is_near_rest && !problem.inertia)
    product->add_stress_of_few(numbers(state.v), state.p, numbers(result.momentum),
                               result.continuity);
  else if (!is_by_cells)
    product->add(numbers(state.v), state.p, numbers(result.momentum), result.continuity);
  else if (problem.inertia && product != nullptr)
    product->inertia()->add(numbers(state.v), numbers(result.momentum));
  if (problem.inertia && product != nullptr)
    product->inertia()->subtract_given(numbers(result.momentum));
  else if (problem.inertia)
    add_tension(*problem.inertia, state.v, result.momentum);
  for (const NodeId i : problem.force.ids()) result.momentum[i] -= problem.force[i];
  return result;
}

}  // namespace

StokesResidual residual(const StokesProblem& problem, const StokesState& state,
                        const StokesProduct* product) {
  return residual(problem, state, product, false);
}

StokesResidual residual_near_rest(const StokesProblem& problem, const StokesState& state,
                                  const StokesProduct* product) {
  return residual(problem, state, product, true);
}

std::vector<double> residual_weights(const StokesProblem& problem) {
  if (!has_product(problem) || problem.inertia) return {};
  // About what a regular cell adds to the diagonal of ∫μ∇φ·∇φ, over μ V^⅓: at corners and at
  // middles of edges.
  constexpr double kCorner = 0.22, kMiddle = 0.97;
  Field<NodeId, double> stiffness(problem.space.velocity.num_nodes, 0.0);
  std::vector<double> mass(problem.space.pressure.vertex.size(), 0.0);
  for (const CellId c : ids<CellId>(problem.space.velocity.num_cells())) {
    const auto nodes = problem.space.velocity.of(c);
    const auto edge = [&](std::size_t k) -> Vec3 {
      return problem.positions.x[NodeId{nodes[k]}] - problem.positions.x[NodeId{nodes[0]}];
    };
    const double volume = std::abs(edge(1).cross(edge(2)).dot(edge(3))) / 6.0;
    const double mu = problem.viscosity[c], scale = mu * std::cbrt(volume);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      stiffness[NodeId{nodes[i]}] += (i < 4 ? kCorner : kMiddle) * scale;
    for (const std::int32_t k : problem.space.pressure.nodes.of(c))
      mass[static_cast<std::size_t>(k)] += 0.25 * volume / mu;
  }
  const OwnedCounts owned = owned_counts(problem);
  std::vector<double> weights;
  weights.reserve(3 * static_cast<std::size_t>(owned.num_nodes) +
                  static_cast<std::size_t>(owned.num_pressures));
  for (const NodeId i : ids<NodeId>(owned.num_nodes))
    weights.insert(weights.end(), 3, 1.0 / std::sqrt(stiffness[i]));
  for (std::size_t k = 0; k < static_cast<std::size_t>(owned.num_pressures); ++k)
    weights.push_back(1.0 / std::sqrt(mass[k]));
  return weights;
}

double free_norm(const StokesResidual& residual, const StokesProblem& problem,
                 std::span<const double> weights) {
  const OwnedCounts owned = owned_counts(problem);
  const auto weight = [&](std::size_t row) { return weights.empty() ? 1.0 : weights[row]; };
  double squared = 0.0;
  std::size_t row = 0;
  for (const NodeId i : ids<NodeId>(owned.num_nodes)) {
    const Vec3 r = weight(row) * residual.momentum[i];
    const NodeConstraint* constraint = problem.constraints.find(i);
    squared +=
        constraint == nullptr ? r.squaredNorm() : (r - constraint->fixed_part(r)).squaredNorm();
    row += 3;
  }
  for (const double of : std::span(residual.continuity).first(std::size_t(owned.num_pressures))) {
    const double r = weight(row++) * of;
    squared += r * r;
  }
  const double norm = std::sqrt(squared);
  return problem.partition == nullptr ? norm : linear::norm(problem.partition->communicator, norm);
}

StokesPower power(const StokesProblem& problem, const StokesState& state,
                  const StokesProduct* product) {
  if (product == nullptr && has_product(problem)) {
    StokesProduct own(problem);
    own.convect(numbers(state.v));
    return power(problem, state, &own);
  }
  return power(problem, state, product, residual(problem, state, product));
}

StokesPower power(const StokesProblem& problem, const StokesState& state,
                  const StokesProduct* product, const StokesResidual& of_state) {
  StokesPower power;
  if (product != nullptr && !problem.is_generalised()) {
    add_power(problem, state, *product, of_state, power);
  } else {
    with_element(problem.space, problem.positions,
                 [&](auto& element) { add_cell_power(problem, state, element, power); });
  }
  if (product != nullptr && product->inertia() != nullptr)
    power.kinetic_rate =
        product->inertia()->kinetic_rate(numbers(state.v), owned_counts(problem).num_nodes);
  const std::int32_t num_nodes = owned_counts(problem).num_nodes;
  for (const NodeId i : ids<NodeId>(num_nodes)) power.force += problem.force[i].dot(state.v[i]);
  for (const NodeConstraint& constraint : problem.constraints.all())
    if (constraint.node.value < num_nodes)
      power.reaction +=
          constraint.fixed_part(of_state.momentum[constraint.node]).dot(state.v[constraint.node]);
  if (problem.partition != nullptr)
    for (double* part : {&power.reaction, &power.body_force, &power.force, &power.dissipation,
                         &power.kinetic_rate})
      *part = linear::sum(problem.partition->communicator, *part);
  return power;
}

}  // namespace meniscus::fem
