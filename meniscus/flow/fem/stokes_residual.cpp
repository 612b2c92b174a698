#include "meniscus/flow/fem/stokes_residual.hpp"

#include <cmath>

#include "meniscus/flow/fem/linear_tetrahedron.hpp"

namespace meniscus::fem {
namespace {

/// What is constant on one linear tetrahedron.
struct CellFields {
  LinearTetrahedron tet;
  Mat3 velocity_gradient = Mat3::Zero();  ///< ∂v_a/∂x_b at (a, b)
  Vec3 velocity_sum = Vec3::Zero();       ///< of the four vertices
  Vec3 pressure_gradient = Vec3::Zero();
  double mean_pressure = 0.0;
};

CellFields cell_fields(const StokesProblem& problem, const PressureSpace& pressure,
                       const StokesState& state, CellId c) {
  CellFields fields{.tet = linear_tetrahedron(problem.mesh, c)};
  const CellVertices& vertices = problem.mesh.cells[c];
  const auto nodes = pressure.nodes.of(c);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3& v = state.v[vertices[i]];
    const double p = state.p[static_cast<std::size_t>(nodes[i])];
    fields.velocity_gradient += v * fields.tet.gradient[i].transpose();
    fields.velocity_sum += v;
    fields.pressure_gradient += p * fields.tet.gradient[i];
    fields.mean_pressure += 0.25 * p;
  }
  return fields;
}

}  // namespace

StokesResidual residual(const StokesProblem& problem, const PressureSpace& pressure,
                        const StokesState& state) {
  StokesResidual result{Field<TetVertexId, Vec3>(problem.mesh.num_vertices(), Vec3::Zero()),
                        std::vector<double>(state.p.size(), 0.0)};
  for (const CellId c : problem.mesh.cells.ids()) {
    const CellFields fields = cell_fields(problem, pressure, state, c);
    const double volume = fields.tet.volume, viscosity = problem.viscosity[c];
    const Vec3& f = problem.body_force[c];
    const Mat3& gradient = fields.velocity_gradient;
    const Mat3 stress =
        viscosity * (gradient + gradient.transpose()) - fields.mean_pressure * Mat3::Identity();
    const Vec3 stabilisation =
        pspg_parameter(volume, viscosity) * volume * (fields.pressure_gradient - f);
    const double divergence = 0.25 * volume * gradient.trace();
    const auto nodes = pressure.nodes.of(c);
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3& g = fields.tet.gradient[i];
      result.momentum[problem.mesh.cells[c][i]] += volume * (stress * g) - 0.25 * volume * f;
      result.continuity[static_cast<std::size_t>(nodes[i])] -= divergence + stabilisation.dot(g);
    }
  }
  for (const TetVertexId v : problem.load.ids()) result.momentum[v] -= problem.load[v];
  return result;
}

double free_norm(const StokesResidual& residual, const Constraints& constraints) {
  double squared = 0.0;
  for (const TetVertexId v : residual.momentum.ids()) {
    const Vec3& r = residual.momentum[v];
    const NodeConstraint* constraint = constraints.find(v);
    squared +=
        constraint == nullptr ? r.squaredNorm() : (r - constraint->fixed_part(r)).squaredNorm();
  }
  for (const double r : residual.continuity) squared += r * r;
  return std::sqrt(squared);
}

StokesPower power(const StokesProblem& problem, const PressureSpace& pressure,
                  const StokesState& state) {
  StokesPower power;
  for (const CellId c : problem.mesh.cells.ids()) {
    const CellFields fields = cell_fields(problem, pressure, state, c);
    const double volume = fields.tet.volume, viscosity = problem.viscosity[c];
    const Vec3& f = problem.body_force[c];
    const Mat3 rate = 0.5 * (fields.velocity_gradient + fields.velocity_gradient.transpose());
    power.dissipation += volume * (2.0 * viscosity * rate.squaredNorm() +
                                   pspg_parameter(volume, viscosity) *
                                       fields.pressure_gradient.dot(fields.pressure_gradient - f));
    power.body_force += 0.25 * volume * f.dot(fields.velocity_sum);
  }
  for (const TetVertexId v : problem.load.ids()) power.load += problem.load[v].dot(state.v[v]);
  const StokesResidual reaction = residual(problem, pressure, state);
  for (const NodeConstraint& constraint : problem.constraints.all())
    power.reaction +=
        constraint.fixed_part(reaction.momentum[constraint.vertex]).dot(state.v[constraint.vertex]);
  return power;
}

}  // namespace meniscus::fem
