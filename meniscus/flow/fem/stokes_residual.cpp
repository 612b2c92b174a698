#include "meniscus/flow/fem/stokes_residual.hpp"

#include <cmath>

#include "meniscus/flow/fem/elements.hpp"

namespace meniscus::fem {
namespace {

/// The unknowns of one cell, and the fields they make at a point.
template <class Element>
struct CellState {
  Eigen::Matrix<double, 3, Element::num_nodes> v;
  Eigen::Vector4d p;

  CellState(const FlowSpace& space, const StokesState& state, CellId c) {
    const auto nodes = space.velocity.of(c);
    for (std::size_t i = 0; i < Element::num_nodes; ++i)
      v.col(static_cast<Eigen::Index>(i)) = state.v[NodeId{nodes[i]}];
    const auto pressures = space.pressure.nodes.of(c);
    for (std::size_t k = 0; k < 4; ++k)
      p[static_cast<Eigen::Index>(k)] = state.p[static_cast<std::size_t>(pressures[k])];
  }
  /// ∂v_a/∂x_b at (a, b).
  [[nodiscard]] Mat3 velocity_gradient(const typename Element::Point& point) const {
    return v * point.gradient.transpose();
  }
  [[nodiscard]] Vec3 velocity(const typename Element::Point& point) const {
    return v * Eigen::Map<const Eigen::Matrix<double, Element::num_nodes, 1>>(point.value.data());
  }
  [[nodiscard]] double pressure(const typename Element::Point& point) const {
    return p.dot(Eigen::Map<const Eigen::Vector4d>(point.pressure.data()));
  }
};

/// τ(∇p − f) where there is a stabilisation, which is on cells with one point.
template <class Element>
Vec3 stabilisation(const StokesProblem& problem, const CellState<Element>& cell,
                   const typename Element::Point& point, CellId c) {
  if constexpr (Element::is_stabilized)
    return pspg_parameter(point.weight, problem.viscosity[c]) *
           (point.gradient * cell.p - problem.body_force[c]);
  else
    return Vec3::Zero();
}

template <class Element>
void add_residual(const StokesProblem& problem, const StokesState& state, Element& element,
                  StokesResidual& result) {
  for (const CellId c : problem.mesh.cells.ids()) {
    const CellState<Element> cell(problem.space, state, c);
    const double viscosity = problem.viscosity[c];
    const auto nodes = problem.space.velocity.of(c);
    const auto pressures = problem.space.pressure.nodes.of(c);
    for (const auto& point : element.points(c)) {
      const Mat3 gradient = cell.velocity_gradient(point);
      const Mat3 stress =
          viscosity * (gradient + gradient.transpose()) - cell.pressure(point) * Mat3::Identity();
      for (std::size_t i = 0; i < Element::num_nodes; ++i)
        result.momentum[NodeId{nodes[i]}] +=
            point.weight * (stress * point.gradient.col(static_cast<Eigen::Index>(i)) -
                            point.value[i] * problem.body_force[c]);
      const Vec3 slip = stabilisation(problem, cell, point, c);
      for (std::size_t k = 0; k < 4; ++k) {
        double& continuity = result.continuity[static_cast<std::size_t>(pressures[k])];
        continuity -= point.weight * point.pressure[k] * gradient.trace();
        if constexpr (Element::is_stabilized)
          continuity -= point.weight * slip.dot(point.gradient.col(static_cast<Eigen::Index>(k)));
      }
    }
  }
}

template <class Element>
void add_cell_power(const StokesProblem& problem, const StokesState& state, Element& element,
                    StokesPower& power) {
  for (const CellId c : problem.mesh.cells.ids()) {
    const CellState<Element> cell(problem.space, state, c);
    for (const auto& point : element.points(c)) {
      const Mat3 gradient = cell.velocity_gradient(point);
      const Mat3 rate = 0.5 * (gradient + gradient.transpose());
      power.dissipation += point.weight * 2.0 * problem.viscosity[c] * rate.squaredNorm();
      if constexpr (Element::is_stabilized)
        power.dissipation +=
            point.weight * (point.gradient * cell.p).dot(stabilisation(problem, cell, point, c));
      power.body_force += point.weight * problem.body_force[c].dot(cell.velocity(point));
    }
  }
}

}  // namespace

StokesResidual residual(const StokesProblem& problem, const StokesState& state) {
  StokesResidual result{Field<NodeId, Vec3>(problem.load.size(), Vec3::Zero()),
                        std::vector<double>(state.p.size(), 0.0)};
  with_element(problem.space, problem.positions,
               [&](auto& element) { add_residual(problem, state, element, result); });
  for (const NodeId i : problem.load.ids()) result.momentum[i] -= problem.load[i];
  return result;
}

double free_norm(const StokesResidual& residual, const Constraints& constraints) {
  double squared = 0.0;
  for (const NodeId i : residual.momentum.ids()) {
    const Vec3& r = residual.momentum[i];
    const NodeConstraint* constraint = constraints.find(i);
    squared +=
        constraint == nullptr ? r.squaredNorm() : (r - constraint->fixed_part(r)).squaredNorm();
  }
  for (const double r : residual.continuity) squared += r * r;
  return std::sqrt(squared);
}

StokesPower power(const StokesProblem& problem, const StokesState& state) {
  StokesPower power;
  with_element(problem.space, problem.positions,
               [&](auto& element) { add_cell_power(problem, state, element, power); });
  for (const NodeId i : problem.load.ids()) power.load += problem.load[i].dot(state.v[i]);
  const StokesResidual reaction = residual(problem, state);
  for (const NodeConstraint& constraint : problem.constraints.all())
    power.reaction +=
        constraint.fixed_part(reaction.momentum[constraint.node]).dot(state.v[constraint.node]);
  return power;
}

}  // namespace meniscus::fem
