#include "meniscus/flow/fem/scalar_coupling.hpp"

#include <algorithm>
#include <cmath>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/curved_maps.hpp"
#include "meniscus/flow/fem/elements.hpp"

namespace meniscus::fem {
namespace {

void check_values(const BulkScalar& scalar, const FlowSpace& space) {
  MENISCUS_ASSERT(std::ssize(scalar.values) == space.velocity.num_nodes,
                  "{} values of a scalar at {} nodes", scalar.values.size(),
                  space.velocity.num_nodes);
}

/// ∫T dV/V of a straight cell.
double mean_in(std::span<const std::int32_t> nodes, const std::vector<double>& values) {
  double corners = 0.0, edges = 0.0;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    (i < 4 ? corners : edges) += values[static_cast<std::size_t>(nodes[i])];
  return nodes.size() == 4 ? 0.25 * corners : 0.2 * edges - 0.05 * corners;
}

std::array<std::array<double, 10>, kTetrahedronRule5.size()> rule_values() {
  std::array<std::array<double, 10>, kTetrahedronRule5.size()> values{};
  for (std::size_t q = 0; q < values.size(); ++q)
    values[q] = quadratic_tetrahedron_values(kTetrahedronRule5[q].barycentric);
  return values;
}

/// Adds ∫ direction (T − reference) φ_i of quadratic elements.
void add_nodal_force(const Scalar& scalar, const std::vector<double>& T,
                     const StokesProblem& problem, Field<NodeId, Vec3>& force) {
  static const auto kValues = rule_values();
  const auto all = problem.mesh.cells.ids();
  const std::vector<CurvedMaps> maps_of = curved_maps(problem.positions.x, problem.space.velocity,
                                                      std::vector<CellId>(all.begin(), all.end()));
  for (const CellId c : all) {
    const auto nodes = problem.space.velocity.of(c);
    const CurvedMaps& maps = maps_of[static_cast<std::size_t>(c.value)];
    for (std::size_t q = 0; q < maps.size(); ++q) {
      double here = -scalar.reference;
      for (std::size_t i = 0; i < 10; ++i)
        here += kValues[q][i] * T[static_cast<std::size_t>(nodes[i])];
      for (std::size_t i = 0; i < 10; ++i)
        force[NodeId{nodes[i]}] += maps[q].weight * kValues[q][i] * here * scalar.buoyancy;
    }
  }
}

}  // namespace

CellField<double> viscosity_factors(const Scene& scene, const TetMesh& mesh, const FlowSpace& space,
                                    const BulkScalars& scalars) {
  CellField<double> factors(mesh.num_cells(), 1.0);
  for (std::size_t k = 0; k < scalars.size(); ++k) {
    const Scalar& scalar = scene.scalars[k];
    if (scalar.viscosity_exponent == 0.0) continue;
    check_values(scalars[k], space);
    for (const CellId c : mesh.cells.ids())
      factors[c] *= std::exp(-scalar.viscosity_exponent *
                             (mean_in(space.velocity.of(c), scalars[k].values) - scalar.reference));
  }
  return factors;
}

bool has_varying_viscosity(const Scene& scene) {
  return std::ranges::any_of(scene.scalars,
                             [](const Scalar& each) { return each.viscosity_exponent != 0.0; });
}

std::vector<double> least_viscosities(const StokesProblem& problem) {
  std::vector<double> least;
  for (const CellId c : problem.mesh.cells.ids()) {
    const auto region = static_cast<std::size_t>(problem.mesh.region[c].value);
    if (least.size() <= region) least.resize(region + 1, HUGE_VAL);
    least[region] = std::min(least[region], problem.viscosity[c]);
  }
  return least;
}

void add_buoyancy(const Scene& scene, const BulkScalars& scalars, StokesProblem& problem,
                  Field<NodeId, Vec3>& force) {
  for (std::size_t k = 0; k < scalars.size(); ++k) {
    const Scalar& scalar = scene.scalars[k];
    if (scalar.buoyancy.isZero(0.0)) continue;
    check_values(scalars[k], problem.space);
    if (problem.space.elements == Elements::p2_p1) {
      add_nodal_force(scalar, scalars[k].values, problem, force);
      continue;
    }
    for (const CellId c : problem.mesh.cells.ids())
      problem.body_force[c] +=
          (mean_in(problem.space.velocity.of(c), scalars[k].values) - scalar.reference) *
          scalar.buoyancy;
  }
}

}  // namespace meniscus::fem
