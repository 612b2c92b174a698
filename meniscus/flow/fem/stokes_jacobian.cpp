#include "meniscus/flow/fem/stokes_jacobian.hpp"

#include <algorithm>
#include <type_traits>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/block_rows.hpp"
#include "meniscus/flow/fem/straight_quadratic_matrices.hpp"
#include "meniscus/linear/collective.hpp"

namespace meniscus::fem {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Linear functions as quadratic ones: a vertex keeps its value, the middle of an edge has the mean
/// of its ends. Fixed nodes are zero, but that fixed vertices keep their own equation.
linear::CsrMatrix interpolation_from_linear(const LinearFunctions& coarse, std::int32_t num_rows,
                                            const std::vector<bool>& is_fixed) {
  linear::CsrMatrix matrix;
  matrix.num_columns = coarse.num_own;
  matrix.row_start.push_back(0);
  for (std::size_t i = 0; i < at(num_rows); ++i) {
    const auto& [a, b] = coarse.ends[i];
    MENISCUS_ASSERT(coarse.number[at(a)] >= 0 && coarse.number[at(b)] >= 0, "node {}", i);
    if (a == b) {
      matrix.columns.push_back(coarse.number[at(a)]);
      matrix.values.push_back(1.0);
    }
    for (const std::int32_t end : coarse.ends[i]) {  // in rising order
      if (a == b || is_fixed[i] || is_fixed[at(end)]) continue;
      matrix.columns.push_back(coarse.number[at(end)]);
      matrix.values.push_back(0.5);
    }
    matrix.row_start.push_back(static_cast<std::int32_t>(matrix.columns.size()));
  }
  return matrix;
}

/// Columns of a rank's share, numbered as all ranks do.
void renumber(NodeGraph& graph, const std::vector<std::int32_t>& number) {
  for (std::int32_t& column : graph.columns) column = number[at(column)];
}

StraightQuadraticMatrices straight_quadratic_matrices(const StokesProblem& problem, CellId c) {
  const auto nodes = problem.space.velocity.of(c);
  const auto x = [&](std::size_t k) { return problem.positions.x[NodeId{nodes[k]}]; };
  return {linear_tetrahedron({x(0), x(1), x(2), x(3)}), problem.viscosity[c]};
}

}  // namespace

StokesJacobian::StokesJacobian(const FlowSpace& space, const Share* share)
    : space_(space),
      share_(share),
      own_(share != nullptr ? share->own : all_of(space)),
      coarse_(share != nullptr ? share->coarse : linear_functions(space)),
      velocity_graph_(node_graph(space.velocity, space.velocity)),
      coupling_graph_(node_graph(space.pressure.nodes, space.velocity)),
      pressure_graph_(node_graph(space.pressure.nodes, space.pressure.nodes)) {
  if (space.elements == Elements::p1_p1) {
    edge_sums_.emplace(space, velocity_graph_, coupling_graph_, pressure_graph_);
    forget_positions();
  }
  if (share != nullptr) {
    renumber(velocity_graph_, share->node_number);
    renumber(coupling_graph_, share->node_number);
    renumber(pressure_graph_, share->pressure_number);
  }
  A_pattern_ = expanded(velocity_graph_, 3, 3);
  B_pattern_ = expanded(coupling_graph_, 1, 3);
  for (const RegionId region : space.pressure.region) region_of_pressure_.push_back(region.value);
}

/// Gives back 600 bytes a node of linear elements.
void StokesJacobian::forget_positions() {
  for (NodeGraph* graph : {&velocity_graph_, &coupling_graph_, &pressure_graph_})
    std::vector<std::uint16_t>().swap(graph->position);
}

/// Finds them again where they were given back.
void StokesJacobian::recall_positions() {
  if (!velocity_graph_.position.empty()) return;
  const NodeTable &velocity = space_.velocity, &pressure = space_.pressure.nodes;
  velocity_graph_.position = node_graph(velocity, velocity).position;
  coupling_graph_.position = node_graph(pressure, velocity).position;
  pressure_graph_.position = node_graph(pressure, pressure).position;
}

void StokesJacobian::weigh_constant_pressures(const Field<RegionId, double>& shares) {
  region_shares_.assign(shares.begin(), shares.end());
}

/// χ share/(∫χ/μ) χᵀ is the share of μM⁻¹ between constant pressures.
void StokesJacobian::weigh_regions() {
  std::vector<double> mass(region_shares_.size(), 0.0);
  for (std::size_t i = 0; i < at(own_.num_pressures) && !mass.empty(); ++i)
    mass[at(region_of_pressure_[i])] += pressure_mass_[i];
  region_weights_.clear();
  for (std::size_t r = 0; r < mass.size(); ++r) {
    const double whole = share_ == nullptr ? mass[r] : linear::sum(share_->communicator, mass[r]);
    MENISCUS_ASSERT(region_shares_[r] == 0.0 || whole > 0.0, "region {}", r);
    region_weights_.push_back(region_shares_[r] / whole);
  }
}

bool StokesJacobian::is_same(const std::vector<bool>& a, const std::vector<bool>& b) const {
  return share_ == nullptr ? a == b : !linear::any(share_->communicator, a != b);
}

void StokesJacobian::choose_laplacians(const Constraints& constraints) {
  laplacians_.clear();
  const std::size_t num_nodes = at(velocity_graph_.num_rows());
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<bool> is_fixed(num_nodes, false);
    for (const NodeConstraint& constraint : constraints.all())
      is_fixed[at(constraint.node.value)] = constraint.is_fixed[k];
    const auto same = std::ranges::find_if(
        laplacians_, [&](const Laplacian& other) { return is_same(other.is_fixed, is_fixed); });
    laplacian_of_[k] = static_cast<int>(same - laplacians_.begin());
    if (same != laplacians_.end()) continue;
    linear::CsrMatrix from_linear;
    if (!coarse_.ends.empty())
      from_linear = interpolation_from_linear(coarse_, own_.num_nodes, is_fixed);
    laplacians_.push_back({std::move(is_fixed), {}, std::move(from_linear)});
  }
}

void StokesJacobian::assemble(const StokesProblem& problem, const Linearization* about) {
  choose_laplacians(problem.constraints);
  constant_pressure_is_null_ = !problem.has_open_boundary;
  pressure_mass_.assign(at(pressure_graph_.num_rows()), 0.0);
  consistent_mass_.assign(space_.elements == Elements::p2_p1 ? pressure_graph_.num_entries() : 0,
                          0.0);
  const bool has_lower_left = about != nullptr && about->kind == Linearization::Kind::newton &&
                              space_.elements == Elements::p1_p1;
  lower_left_.assign(has_lower_left ? 3 * coupling_graph_.num_entries() : 0, 0.0);
  A_.resize(9 * velocity_graph_.num_entries());
  B_.resize(3 * coupling_graph_.num_entries());
  C_.resize(pressure_graph_.num_entries());
  for (Laplacian& laplacian : laplacians_) laplacian.values.resize(velocity_graph_.num_entries());
  const std::vector<CellId> others = assemble_plain_cells(problem, about);
  if (!others.empty()) recall_positions();
  with_element(space_, problem.positions,
               [&](auto& element) { add_cells(problem, about, others, element); });
  weigh_regions();
}

/// Sets A, B, C and the Laplacians to what plain cells, whose matrices are summed by edges, make of
/// them: linear ones on Newtonian liquids.
/// Returns the other cells.
std::vector<CellId> StokesJacobian::assemble_plain_cells(const StokesProblem& problem,
                                                         const Linearization* about) {
  if (!edge_sums_.has_value() || !lower_left_.empty()) {
    for (std::vector<double>* values : {&A_, &B_, &C_}) std::ranges::fill(*values, 0.0);
    for (Laplacian& laplacian : laplacians_) std::ranges::fill(laplacian.values, 0.0);
    const auto all = problem.mesh.cells.ids();
    return {all.begin(), all.end()};
  }
  const auto is_plain = [&](CellId c) { return about == nullptr || problem.law(c) == nullptr; };
  std::vector<CellId> plain, others;
  plain.reserve(at(problem.mesh.num_cells()));
  for (const CellId c : problem.mesh.cells.ids()) (is_plain(c) ? plain : others).push_back(c);
  EdgeSums::Matrices matrices{velocity_graph_, pressure_graph_, A_, B_, C_, {}, pressure_mass_};
  for (Laplacian& laplacian : laplacians_)
    matrices.laplacians.push_back({&laplacian.is_fixed, laplacian.values});
  edge_sums_->assemble(problem, plain, own_.num_pressures, matrices);
  return others;
}

bool StokesJacobian::is_free(const Constraints& constraints, CellId c) const {
  return std::ranges::none_of(space_.velocity.of(c), [&](std::int32_t i) {
    return constraints.find(NodeId{i}) != nullptr;
  });
}

template <class Element>
void StokesJacobian::add_cells(const StokesProblem& problem, const Linearization* about,
                               std::span<const CellId> cells, Element& element) {
  for (const CellId c : cells) {
    if (about != nullptr && problem.law(c) != nullptr)
      add_cell(problem, TangentMatrices<Element>(problem, element.points(c), c, *about), c);
    else if (std::is_same_v<Element, QuadraticElement> && !problem.positions.is_curved[c])
      add_cell(problem, straight_quadratic_matrices(problem, c), c);
    else
      add_cell(problem, CellMatrices<Element>(problem, element.points(c), c), c);
  }
}

template <class Matrices>
void StokesJacobian::add_cell(const StokesProblem& problem, const Matrices& matrices, CellId c) {
  if (is_free(problem.constraints, c))
    add_free_cell(matrices, c);
  else
    add_constrained_cell(problem, matrices, c);
  if (!lower_left_.empty()) add_lower_left(problem, matrices, c);
  add_pressure_blocks(matrices, c);
}

/// Where B or what stands on its pattern joins pressure k and velocity j of a cell.
Eigen::Map<Vec3> StokesJacobian::coupling(std::vector<double>& values, CellId c, std::size_t k,
                                          std::size_t j) const {
  const auto n = static_cast<std::size_t>(space_.velocity.nodes_per_cell);
  return Eigen::Map<Vec3>(values.data() + 3 * coupling_graph_.entry(space_.pressure.nodes.of(c)[k],
                                                                    n * (4 * at(c.value) + k) + j));
}

template <class Matrices>
void StokesJacobian::add_free_cell(const Matrices& matrices, CellId c) {
  constexpr std::size_t n = Matrices::num_nodes;
  const auto nodes = space_.velocity.of(c);
  const std::size_t first = n * n * at(c.value);
  for (std::size_t i = 0; i < n; ++i) {
    const BlockRows rows(A_, velocity_graph_, nodes[i]);
    for (std::size_t j = 0; j < n; ++j)
      rows.add(velocity_graph_.position[first + n * i + j], matrices.viscous_block(i, j));
  }
  for (Laplacian& laplacian : laplacians_)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        laplacian.values[velocity_graph_.entry(nodes[i], first + n * i + j)] +=
            matrices.laplacian(i, j);
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t j = 0; j < n; ++j) coupling(B_, c, k, j) += matrices.divergence_of(k, j);
}

template <class Matrices>
void StokesJacobian::add_constrained_cell(const StokesProblem& problem, const Matrices& matrices,
                                          CellId c) {
  constexpr std::size_t n = Matrices::num_nodes;
  const auto nodes = space_.velocity.of(c);
  const std::size_t first = n * n * at(c.value);
  std::array<const NodeConstraint*, n> constraints{};
  for (std::size_t i = 0; i < n; ++i) constraints[i] = problem.constraints.find(NodeId{nodes[i]});
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const std::size_t pair = first + n * i + j;
      Mat3 block = matrices.viscous_block(i, j);
      eliminate(block, constraints[i], constraints[j], i == j);
      BlockRows(A_, velocity_graph_, nodes[i]).add(velocity_graph_.position[pair], block);
      for (Laplacian& laplacian : laplacians_) {
        const bool is_fixed = laplacian.is_fixed[at(nodes[i])] || laplacian.is_fixed[at(nodes[j])];
        if (!is_fixed || i == j)
          laplacian.values[velocity_graph_.entry(nodes[i], pair)] += matrices.laplacian(i, j);
      }
    }
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t j = 0; j < n; ++j)
      coupling(B_, c, k, j) += free_divergence(matrices.divergence_of(k, j), constraints[j]);
}

template <class Matrices>
void StokesJacobian::add_lower_left(const StokesProblem& problem, const Matrices& matrices,
                                    CellId c) {
  constexpr std::size_t n = Matrices::num_nodes;
  const auto nodes = space_.velocity.of(c);
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t j = 0; j < n; ++j)
      coupling(lower_left_, c, k, j) +=
          free_divergence(matrices.lower_left_of(k, j), problem.constraints.find(NodeId{nodes[j]}));
}

template <class Matrices>
void StokesJacobian::add_pressure_blocks(const Matrices& matrices, CellId c) {
  const auto nodes = space_.pressure.nodes.of(c);
  for (std::size_t i = 0; i < 4; ++i) {
    pressure_mass_[at(nodes[i])] += matrices.pressure_mass(i);
    for (std::size_t j = 0; j < 4; ++j) {
      const std::size_t k = pressure_graph_.entry(nodes[i], 16 * at(c.value) + 4 * i + j);
      C_[k] += matrices.stabilisation(i, j);
      if (!consistent_mass_.empty()) consistent_mass_[k] += matrices.consistent_mass(i, j);
    }
  }
}

linear::SaddleSystem StokesJacobian::system() const {
  const std::int32_t num_velocities = 3 * own_.num_nodes, num_pressures = own_.num_pressures;
  linear::SaddleSystem system;
  system.A = {num_velocities, num_velocities, A_pattern_.row_start, A_pattern_.columns, A_};
  system.B = {num_pressures, num_velocities, B_pattern_.row_start, B_pattern_.columns, B_};
  system.C = {num_pressures, num_pressures, pressure_graph_.row_start, pressure_graph_.columns, C_};
  for (const Laplacian& laplacian : laplacians_) {
    system.laplacians.push_back({own_.num_nodes, own_.num_nodes, velocity_graph_.row_start,
                                 velocity_graph_.columns, laplacian.values});
    if (!coarse_.ends.empty()) system.interpolations.push_back(laplacian.from_linear.view());
  }
  system.lower_left = lower_left_;
  if (!consistent_mass_.empty()) {
    system.consistent_mass = system.C;
    system.consistent_mass.values = consistent_mass_;
  }
  system.laplacian_of = laplacian_of_;
  system.pressure_mass = std::span(pressure_mass_).first(at(num_pressures));
  system.group_of_pressure = std::span(region_of_pressure_).first(at(num_pressures));
  system.group_weights = region_weights_;
  system.constant_pressure_is_null = constant_pressure_is_null_;
  return system;
}

}  // namespace meniscus::fem
