#pragma once

#include <cmath>
#include <numbers>

#include "meniscus/flow/fem/elements.hpp"
#include "meniscus/flow/fem/stokes_problem.hpp"

namespace meniscus::fem {

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

/// D of a velocity gradient [G].
[[nodiscard]] inline Mat3 rate_of_strain(const Mat3& gradient) {
  return 0.5 * (gradient + gradient.transpose());
}

/// The viscosity where a cell has this velocity gradient [μ_out].
[[nodiscard]] inline double viscosity_at(const StokesProblem& problem, CellId c,
                                         const Mat3& gradient) {
  const ViscosityLaw* law = problem.law(c);
  if (law == nullptr) return problem.viscosity[c];
  const double rate = std::numbers::sqrt2 * rate_of_strain(gradient).norm();
  return problem.viscosity[c] * relative_viscosity(*law, rate).value;
}

/// τ of a linear cell whose viscosity is given.
[[nodiscard]] inline double stabilisation_parameter(const StokesProblem& problem, CellId c,
                                                    double volume, double viscosity) {
  return problem.inertia ? pspg_parameter(volume, viscosity,
                                          problem.inertia->density[c] / problem.inertia->duration)
                         : pspg_parameter(volume, viscosity);
}

}  // namespace meniscus::fem
