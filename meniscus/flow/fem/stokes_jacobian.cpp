#include "meniscus/flow/fem/stokes_jacobian.hpp"

#include <algorithm>
#include <numeric>
#include <type_traits>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/linear_inertia.hpp"
#include "meniscus/flow/fem/straight_quadratic_matrices.hpp"

namespace meniscus::fem {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

StraightQuadraticMatrices straight_quadratic_matrices(const StokesProblem& problem, CellId c) {
  const auto nodes = problem.space.velocity.of(c);
  const auto x = [&](std::size_t k) { return problem.positions.x[NodeId{nodes[k]}]; };
  return {linear_tetrahedron({x(0), x(1), x(2), x(3)}), problem.viscosity[c]};
}

template <class Element>
void add_cells(const StokesProblem& problem, const Linearization* about,
               std::span<const CellId> cells, Element& element, CellAssembly& assembly) {
  for (const CellId c : cells) {
    if (about != nullptr && problem.law(c) != nullptr)
      assembly.add(TangentMatrices<Element>(problem, element.points(c), c, *about), c);
    else if (std::is_same_v<Element, QuadraticElement> && !problem.positions.is_curved[c])
      assembly.add(straight_quadratic_matrices(problem, c), c);
    else
      assembly.add(CellMatrices<Element>(problem, element.points(c), c), c);
  }
}

}  // namespace

StokesJacobian::StokesJacobian(const FlowSpace& space, const Partition* partition)
    : space_(space),
      owned_(partition != nullptr ? partition->owned : all_owned(space)),
      sparsity_(space),
      laplacians_(space, partition),
      region_weights_(space.pressure, partition) {
  if (space.elements == Elements::p1_p1) {
    edge_sums_.emplace(space, sparsity_.velocity(), sparsity_.coupling(), sparsity_.pressure());
    sparsity_.forget_positions();
  }
  sparsity_.number_columns(partition);
  if (partition != nullptr) {
    node_number_ = partition->node_number;
  } else {
    node_number_.resize(at(space.velocity.num_nodes));
    std::iota(node_number_.begin(), node_number_.end(), 0);
  }
}

void StokesJacobian::clear_values(bool has_lower_left) {
  values_.A.resize(9 * sparsity_.velocity().num_entries());
  values_.B.resize(3 * sparsity_.coupling().num_entries());
  values_.C.resize(sparsity_.pressure().num_entries());
  values_.lower_left.assign(has_lower_left ? values_.B.size() : 0, 0.0);
  values_.pressure_mass.assign(at(sparsity_.pressure().num_rows()), 0.0);
  values_.consistent_mass.assign(space_.elements == Elements::p2_p1 ? values_.C.size() : 0, 0.0);
}

void StokesJacobian::assemble(const StokesProblem& problem, const Linearization* about) {
  MENISCUS_ASSERT(problem.space.velocity.num_nodes == space_.velocity.num_nodes,
                  "a problem on another space: {} {}", problem.space.velocity.num_nodes,
                  space_.velocity.num_nodes);
  laplacians_.choose(problem.constraints, sparsity_.velocity().num_entries());
  constant_pressure_is_null_ = !problem.has_open_boundary;
  MENISCUS_ASSERT(!problem.inertia || space_.elements == Elements::p1_p1,
                  "quadratic elements with inertia have products");
  const bool is_newton = about != nullptr && about->kind == Linearization::Kind::newton;
  clear_values((is_newton || problem.inertia) && space_.elements == Elements::p1_p1);
  const std::vector<CellId> others = assemble_plain_cells(problem, about);
  if (!others.empty()) sparsity_.recall_positions(space_);
  CellAssembly assembly(space_, sparsity_, problem.constraints, values_, laplacians_.all());
  lumped_masses_.clear();
  if (problem.inertia) {
    assemble_inertial_cells(problem, about, assembly);
    add_tension(*problem.inertia, problem.constraints);
  } else {
    with_element(space_, problem.positions,
                 [&](auto& element) { add_cells(problem, about, others, element, assembly); });
  }
  region_weights_.update(std::span(values_.pressure_mass).first(at(owned_.num_pressures)));
}

/// Sets A, B, C and the Laplacians to what plain cells, whose matrices are summed by edges, make of
/// them: linear ones on Newtonian liquids of one viscosity in each region.
/// Returns the other cells.
std::vector<CellId> StokesJacobian::assemble_plain_cells(const StokesProblem& problem,
                                                         const Linearization* about) {
  if (!edge_sums_.has_value() || !values_.lower_left.empty() || !EdgeSums::can_assemble(problem)) {
    for (std::vector<double>* values : {&values_.A, &values_.B, &values_.C})
      std::ranges::fill(*values, 0.0);
    const auto all = problem.mesh.cells.ids();
    return {all.begin(), all.end()};
  }
  const auto is_plain = [&](CellId c) { return about == nullptr || problem.law(c) == nullptr; };
  std::vector<CellId> plain, others;
  plain.reserve(at(problem.mesh.num_cells()));
  for (const CellId c : problem.mesh.cells.ids()) (is_plain(c) ? plain : others).push_back(c);
  EdgeSums::Matrices matrices{
      sparsity_.velocity(), sparsity_.pressure(), values_.A, values_.B, values_.C, {},
      values_.pressure_mass};
  for (ScalarLaplacian& laplacian : laplacians_.all())
    matrices.laplacians.push_back({&laplacian.is_fixed, laplacian.values});
  edge_sums_->assemble(problem, plain, owned_.num_pressures, matrices);
  return others;
}

void StokesJacobian::assemble_inertial_cells(const StokesProblem& problem,
                                             const Linearization* about, CellAssembly& assembly) {
  LinearElement element(space_, problem.positions);
  lumped_masses_.assign(3 * at(space_.velocity.num_nodes), 0.0);
  for (const CellId c : problem.mesh.cells.ids()) {
    const InertialMatrices matrices(problem, element.points(c).front(), c,
                                    about != nullptr ? &about->state.v : nullptr);
    assembly.add(matrices, c);
    for (const std::int32_t node : space_.velocity.of(c))
      for (std::size_t k = 0; k < 3; ++k)
        lumped_masses_[3 * at(node) + k] += matrices.lumped_mass();
  }
}

/// Adds to A and the Laplacians what the tension of the stage does to linear faces.
void StokesJacobian::add_tension(const InertiaTerms& terms, const Constraints& constraints) {
  const NodeGraph& graph = sparsity_.velocity();
  const auto add = [&](const auto& face) {
    for (std::size_t i = 0; i < face.nodes.size(); ++i)
      for (std::size_t j = 0; j < face.nodes.size(); ++j) {
        const NodeId row = face.nodes[i], column = face.nodes[j];
        const auto first = graph.columns.begin() + graph.row_start[at(row.value)],
                   last = graph.columns.begin() + graph.row_start[at(row.value) + 1],
                   found = std::find(first, last, node_number_[at(column.value)]);
        MENISCUS_ASSERT(found != last, "nodes {} and {}", row.value, column.value);
        Mat3 block = face.block(i, j);
        const double mean = block.trace() / 3.0;
        eliminate(block, constraints.find(row), constraints.find(column), row == column);
        BlockRows(values_.A, graph, row.value).add(static_cast<std::size_t>(found - first), block);
        for (ScalarLaplacian& laplacian : laplacians_.all())
          if (row == column ||
              (!laplacian.is_fixed[at(row.value)] && !laplacian.is_fixed[at(column.value)]))
            laplacian.values[static_cast<std::size_t>(found - graph.columns.begin())] += mean;
      }
  };
  std::ranges::for_each(terms.tension, add);
  std::ranges::for_each(terms.elasticity, add);
}

linear::SaddleSystem StokesJacobian::system() const {
  const std::int32_t num_velocities = 3 * owned_.num_nodes, num_pressures = owned_.num_pressures;
  const ScalarPattern &A = sparsity_.A(), &B = sparsity_.B();
  const NodeGraph& C = sparsity_.pressure();
  linear::SaddleSystem system;
  system.A = {num_velocities, num_velocities, A.row_start, A.columns, values_.A};
  system.B = {num_pressures, num_velocities, B.row_start, B.columns, values_.B};
  system.C = {num_pressures, num_pressures, C.row_start, C.columns, values_.C};
  system.lower_left = values_.lower_left;
  if (!values_.consistent_mass.empty()) {
    system.consistent_mass = system.C;
    system.consistent_mass.values = values_.consistent_mass;
  }
  laplacians_.put_into(system, sparsity_.velocity(), owned_.num_nodes);
  region_weights_.put_into(system);
  if (!lumped_masses_.empty()) {
    system.divergence = system.B;
    system.mass_diagonal = std::span(lumped_masses_).first(at(num_velocities));
  }
  system.pressure_mass = std::span(values_.pressure_mass).first(at(num_pressures));
  system.constant_pressure_is_null = constant_pressure_is_null_;
  return system;
}

}  // namespace meniscus::fem
