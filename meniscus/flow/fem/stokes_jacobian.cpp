#include "meniscus/flow/fem/stokes_jacobian.hpp"

#include <algorithm>

#include "meniscus/flow/fem/linear_tetrahedron.hpp"

namespace meniscus::fem {

/// The closed-form element matrices of one P1 tetrahedron.
struct CellMatrices {
  std::array<std::array<double, 4>, 4> laplacian;  ///< μV g_i·g_j
  std::array<Vec3, 4> divergence;                  ///< −∫ψ_i ∂φ_j: −V/4 g_j for every i
  std::array<Vec3, 4> gradient;
  double viscous = 0.0;        ///< μV
  double stabilisation = 0.0;  ///< τ/μ: C_ij over the Laplacian's entry
  double pressure_mass = 0.0;  ///< V/(4μ)

  /// ∫2μ D(φ_j e_b):D(φ_i e_a) = μV (g_i·g_j δ_ab + g_j,a g_i,b) at (a, b).
  [[nodiscard]] Mat3 viscous_block(std::size_t i, std::size_t j) const {
    Mat3 block = viscous * gradient[j] * gradient[i].transpose();
    block.diagonal().array() += laplacian[i][j];
    return block;
  }
};

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

CellMatrices cell_matrices(const StokesProblem& problem, CellId c) {
  const LinearTetrahedron tet = linear_tetrahedron(problem.mesh, c);
  const double viscosity = problem.viscosity[c];
  CellMatrices matrices;
  matrices.gradient = tet.gradient;
  matrices.viscous = viscosity * tet.volume;
  matrices.stabilisation = pspg_parameter(tet.volume, viscosity) / viscosity;
  matrices.pressure_mass = 0.25 * tet.volume / viscosity;
  for (std::size_t i = 0; i < 4; ++i) {
    matrices.divergence[i] = -0.25 * tet.volume * tet.gradient[i];
    for (std::size_t j = 0; j < 4; ++j)
      matrices.laplacian[i][j] = matrices.viscous * tet.gradient[i].dot(tet.gradient[j]);
  }
  return matrices;
}

/// Adds a 3 × 3 block at entry k of the graph, which lies in row i (see ScalarPattern).
void add_block(std::vector<double>& values, const NodeGraph& graph, std::int32_t i, std::int32_t k,
               const Mat3& block) {
  const std::int32_t start = graph.row_start[at(i)];
  const std::size_t width = 3 * at(graph.row_start[at(i) + 1] - start);
  double* row = values.data() + 9 * at(start) + 3 * at(k - start);
  for (Eigen::Index a = 0; a < 3; ++a, row += width)
    for (Eigen::Index b = 0; b < 3; ++b) row[b] += block(a, b);
}

/// Rows and columns of fixed components go, but for the diagonal.
void eliminate(Mat3& block, const NodeConstraint* row, const NodeConstraint* column,
               bool is_diagonal) {
  if (row != nullptr && row->is_rotated()) block = row->frame.transpose() * block;
  if (column != nullptr && column->is_rotated()) block = block * column->frame;
  for (Eigen::Index a = 0; a < 3; ++a)
    for (Eigen::Index b = 0; b < 3; ++b) {
      const bool is_fixed = (row != nullptr && row->is_fixed[static_cast<std::size_t>(a)]) ||
                            (column != nullptr && column->is_fixed[static_cast<std::size_t>(b)]);
      if (is_fixed && !(is_diagonal && a == b)) block(a, b) = 0.0;
    }
}

std::array<const NodeConstraint*, 4> cell_constraints(const StokesProblem& problem, CellId c) {
  std::array<const NodeConstraint*, 4> found{};
  for (std::size_t i = 0; i < 4; ++i) found[i] = problem.constraints.find(problem.mesh.cells[c][i]);
  return found;
}

}  // namespace

StokesJacobian::StokesJacobian(const TetMesh& mesh, const PressureSpace& pressure)
    : pressure_(pressure) {
  const NodeTable velocity = velocity_nodes(mesh);
  velocity_graph_ = node_graph(velocity, velocity);
  pressure_graph_ = node_graph(pressure.nodes, pressure.nodes);
  A_pattern_ = expanded(velocity_graph_, 3, 3);
  // A pressure node meets the same neighbours among velocities as among pressures, and in the same
  // order, as nodes are numbered by vertex: B has the graph of C.
  NodeGraph coupling = pressure_graph_;
  coupling.num_columns = velocity.num_nodes;
  for (std::int32_t& column : coupling.columns) column = pressure.vertex[at(column)].value;
  B_pattern_ = expanded(coupling, 1, 3);
}

void StokesJacobian::choose_laplacians(const Constraints& constraints) {
  laplacians_.clear();
  const std::size_t num_nodes = at(velocity_graph_.num_rows());
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<bool> is_fixed(num_nodes, false);
    for (const NodeConstraint& constraint : constraints.all())
      is_fixed[at(constraint.vertex.value)] = constraint.is_fixed[k];
    const auto same = std::ranges::find(laplacians_, is_fixed, &Laplacian::is_fixed);
    laplacian_of_[k] = static_cast<int>(same - laplacians_.begin());
    if (same == laplacians_.end())
      laplacians_.push_back(
          {std::move(is_fixed), std::vector<double>(velocity_graph_.num_entries(), 0.0)});
  }
}

void StokesJacobian::assemble(const StokesProblem& problem) {
  choose_laplacians(problem.constraints);
  A_.assign(9 * velocity_graph_.num_entries(), 0.0);
  B_.assign(3 * pressure_graph_.num_entries(), 0.0);
  C_.assign(pressure_graph_.num_entries(), 0.0);
  pressure_mass_.assign(at(pressure_graph_.num_rows()), 0.0);
  constant_pressure_is_null_ = !problem.has_open_boundary;
  for (const CellId c : problem.mesh.cells.ids()) {
    const auto constraints = cell_constraints(problem, c);
    if (std::ranges::all_of(constraints, [](auto* constraint) { return constraint == nullptr; }))
      add_free_cell(problem, c);
    else
      add_constrained_cell(problem, c);
  }
}

void StokesJacobian::add_free_cell(const StokesProblem& problem, CellId c) {
  const CellMatrices matrices = cell_matrices(problem, c);
  const CellVertices& vertices = problem.mesh.cells[c];
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const std::size_t pair = 16 * at(c.value) + 4 * i + j;
      const std::int32_t k = velocity_graph_.position[pair];
      add_block(A_, velocity_graph_, vertices[i].value, k, matrices.viscous_block(i, j));
      for (Laplacian& laplacian : laplacians_) laplacian.values[at(k)] += matrices.laplacian[i][j];
      double* B = B_.data() + 3 * at(pressure_graph_.position[pair]);
      for (Eigen::Index b = 0; b < 3; ++b) B[b] += matrices.divergence[j][b];
    }
  add_pressure_blocks(matrices, c);
}

void StokesJacobian::add_constrained_cell(const StokesProblem& problem, CellId c) {
  const CellMatrices matrices = cell_matrices(problem, c);
  const CellVertices& vertices = problem.mesh.cells[c];
  const auto constraints = cell_constraints(problem, c);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const std::size_t pair = 16 * at(c.value) + 4 * i + j;
      const std::int32_t k = velocity_graph_.position[pair];
      Mat3 block = matrices.viscous_block(i, j);
      eliminate(block, constraints[i], constraints[j], i == j);
      add_block(A_, velocity_graph_, vertices[i].value, k, block);
      for (Laplacian& laplacian : laplacians_) {
        const bool is_fixed =
            laplacian.is_fixed[at(vertices[i].value)] || laplacian.is_fixed[at(vertices[j].value)];
        if (!is_fixed || i == j) laplacian.values[at(k)] += matrices.laplacian[i][j];
      }
      Vec3 divergence = matrices.divergence[j];
      if (const NodeConstraint* column = constraints[j]; column != nullptr) {
        divergence = column->frame.transpose() * divergence;
        for (std::size_t b = 0; b < 3; ++b)
          if (column->is_fixed[b]) divergence[static_cast<Eigen::Index>(b)] = 0.0;
      }
      double* B = B_.data() + 3 * at(pressure_graph_.position[pair]);
      for (Eigen::Index b = 0; b < 3; ++b) B[b] += divergence[b];
    }
  add_pressure_blocks(matrices, c);
}

void StokesJacobian::add_pressure_blocks(const CellMatrices& matrices, CellId c) {
  const auto nodes = pressure_.nodes.of(c);
  for (std::size_t i = 0; i < 4; ++i) {
    pressure_mass_[at(nodes[i])] += matrices.pressure_mass;
    for (std::size_t j = 0; j < 4; ++j)
      C_[at(pressure_graph_.position[16 * at(c.value) + 4 * i + j])] +=
          matrices.stabilisation * matrices.laplacian[i][j];
  }
}

linear::SaddleSystem StokesJacobian::system() const {
  const std::int32_t num_velocities = 3 * velocity_graph_.num_rows();
  const std::int32_t num_pressures = pressure_graph_.num_rows();
  linear::SaddleSystem system;
  system.A = {num_velocities, num_velocities, A_pattern_.row_start, A_pattern_.columns, A_};
  system.B = {num_pressures, num_velocities, B_pattern_.row_start, B_pattern_.columns, B_};
  system.C = {num_pressures, num_pressures, pressure_graph_.row_start, pressure_graph_.columns, C_};
  for (const Laplacian& laplacian : laplacians_)
    system.laplacians.push_back({velocity_graph_.num_rows(), velocity_graph_.num_rows(),
                                 velocity_graph_.row_start, velocity_graph_.columns,
                                 laplacian.values});
  system.laplacian_of = laplacian_of_;
  system.pressure_mass = pressure_mass_;
  system.constant_pressure_is_null = constant_pressure_is_null_;
  return system;
}

}  // namespace meniscus::fem
