#include "meniscus/flow/fem/edge_sums.hpp"

#include <algorithm>
#include <array>

#include "meniscus/flow/fem/block_rows.hpp"
#include "meniscus/flow/fem/elements.hpp"

namespace meniscus::fem {
namespace {

constexpr std::size_t kBatch = 16;         // cells that are worked on together
constexpr std::size_t kEntriesAhead = 16;  // sums are fetched so long before they are written

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Asks for the two cache lines of a sum.
template <class Sums>
void fetch(const Sums& sums, bool to_write) {
  const char* const first = reinterpret_cast<const char*>(&sums);
  for (const char* line : {first, first + 64})
    to_write ? __builtin_prefetch(line, 1) : __builtin_prefetch(line, 0);
}

/// The edges of a graph, numbered by their lower end, then by their upper one:
/// 2·edge + (row > column) for each entry, −1 on the diagonal.
std::vector<std::int32_t> number_edges(const NodeGraph& graph) {
  std::vector<std::int32_t> edges(graph.num_entries()), next(at(graph.num_rows()));
  std::int32_t count = 0;
  for (std::int32_t p = 0; p < graph.num_rows(); ++p) {
    std::size_t k = at(graph.row_start[at(p)]);
    // Row q names its upper neighbours in the order in which they come here.
    for (; graph.columns[k] < p; ++k) edges[k] = 2 * next[at(graph.columns[k])]++ + 1;
    edges[k++] = -1;
    next[at(p)] = count;
    for (; k < at(graph.row_start[at(p) + 1]); ++k) edges[k] = 2 * count++;
  }
  return edges;
}

}  // namespace

EdgeSums::EdgeSums(const FlowSpace& space, const NodeGraph& velocity_graph,
                   const NodeGraph& coupling_graph, const NodeGraph& pressure_graph)
    : entry_edges_(number_edges(pressure_graph)),
      places_(pressure_graph.num_entries()),
      column_nodes_(coupling_graph.columns),
      node_(at(pressure_graph.num_rows())) {
  cell_edges_.reserve(6 * at(space.velocity.num_cells()));
  for (const CellId c : ids<CellId>(space.velocity.num_cells())) {
    const auto nodes = space.velocity.of(c), pressures = space.pressure.nodes.of(c);
    const std::size_t first = 16 * at(c.value);
    for (std::size_t a = 0; a < 4; ++a) {
      node_[at(pressures[a])] = nodes[a];
      for (std::size_t pair = first + 4 * a; pair < first + 4 * (a + 1); ++pair)
        places_[pressure_graph.entry(pressures[a], pair)] = velocity_graph.position[pair];
    }
    for (const auto& [a, b] : kCellEdges)
      cell_edges_.push_back(entry_edges_[pressure_graph.entry(pressures[a], first + 4 * a + b)]);
  }
  std::vector<bool> has_pressure(at(velocity_graph.num_rows()), false);
  is_shared_ = has_pressure;
  for (const std::int32_t i : node_)
    (has_pressure[at(i)] ? is_shared_ : has_pressure)[at(i)] = true;
  sums_.resize((pressure_graph.num_entries() - node_.size()) / 2);
  entry_edges_.resize(entry_edges_.size() + kEntriesAhead);
}

void EdgeSums::clear() { std::ranges::fill(sums_, Sums{}); }

// Each of the three steps is short enough that the processor works on several cells at once.
void EdgeSums::add(const StokesProblem& problem, std::span<const CellId> cells,
                   std::span<double> pressure_mass) {
  std::array<LinearTetrahedron, kBatch> tetrahedra;
  std::array<double, kBatch> stabilisations;  // τV
  for (std::size_t first = 0; first < cells.size(); first += kBatch) {
    const auto batch = cells.subspan(first, std::min(kBatch, cells.size() - first));
    for (std::size_t m = 0; m < batch.size(); ++m) {
      for (std::size_t k = 0; k < 6; ++k)
        fetch(sums_[at(cell_edges_[6 * at(batch[m].value) + k] / 2)], true);
      const auto nodes = problem.space.velocity.of(batch[m]);
      const auto x = [&](std::size_t i) { return problem.positions.x[NodeId{nodes[i]}]; };
      tetrahedra[m] = linear_tetrahedron({x(0), x(1), x(2), x(3)});
    }
    for (std::size_t m = 0; m < batch.size(); ++m) {
      const double volume = tetrahedra[m].volume, viscosity = problem.viscosity[batch[m]];
      stabilisations[m] = volume * pspg_parameter(volume, viscosity);
      for (const std::int32_t p : problem.space.pressure.nodes.of(batch[m]))
        pressure_mass[at(p)] += 0.25 * volume / viscosity;
    }
    for (std::size_t m = 0; m < batch.size(); ++m)
      add_cell(batch[m], tetrahedra[m], problem.viscosity[batch[m]], stabilisations[m]);
  }
}

void EdgeSums::add_cell(CellId c, const LinearTetrahedron& cell, double viscosity,
                        double stabilisation) {
  const double viscous = viscosity * cell.volume, quarter = 0.25 * cell.volume;
  std::array<Eigen::Vector4d, 4> rows;  // (μV g_a, −V/4)
  for (std::size_t a = 0; a < 4; ++a) rows[a] << viscous * cell.gradient[a], -quarter;
  const std::int32_t* edge = cell_edges_.data() + 6 * at(c.value);
  for (const auto& ends : kCellEdges) {
    const std::size_t is_from_b = *edge % 2, a = ends[is_from_b], b = ends[1 - is_from_b];
    const Vec3 &ga = cell.gradient[a], &gb = cell.gradient[b];
    Eigen::Matrix4d& products = sums_[at(*edge++ / 2)].products;
    for (Eigen::Index j = 0; j < 3; ++j) products.col(j) += gb[j] * rows[a];
    products.col(3).head<3>() -= quarter * ga;
    products(3, 3) += stabilisation * ga.dot(gb);
  }
}

void EdgeSums::write(const NodeGraph& velocity_graph, const NodeGraph& pressure_graph,
                     std::int32_t num_pressures, const Constraints& constraints,
                     const Matrices& matrices) const {
  const auto write_rows = [&](bool shared, const auto& put) {
    for (std::int32_t p = 0; p < num_pressures; ++p)
      if (is_shared_[at(node_[at(p)])] == shared)
        write_row(p, velocity_graph, pressure_graph, constraints, matrices, put);
  };
  write_rows(false, [](double& to, double value) { to = value; });
  for (std::size_t i = 0; i < is_shared_.size(); ++i) {
    if (!is_shared_[i]) continue;
    const std::size_t start = at(velocity_graph.row_start[i]),
                      count = at(velocity_graph.row_start[i + 1]) - start;
    std::ranges::fill(matrices.A.subspan(9 * start, 9 * count), 0.0);
    for (const Laplacian& laplacian : matrices.laplacians)
      std::ranges::fill(laplacian.values.subspan(start, count), 0.0);
  }
  write_rows(true, [](double& to, double value) { to += value; });
}

/// The row of a pressure in B and C, and what it knows of its node's rows of A and the Laplacians.
template <class Put>
void EdgeSums::write_row(std::int32_t p, const NodeGraph& velocity_graph,
                         const NodeGraph& pressure_graph, const Constraints& constraints,
                         const Matrices& matrices, const Put& put) const {
  const std::size_t i = at(node_[at(p)]), start = at(velocity_graph.row_start[i]),
                    width = 3 * (at(velocity_graph.row_start[i + 1]) - start);
  const NodeConstraint* const here = constraints.find(NodeId{node_[at(p)]});
  const auto write_entry = [&](std::size_t k, const auto& sums) {
    const std::size_t place = start + places_[k];
    const NodeConstraint* const there = constraints.find(NodeId{column_nodes_[k]});
    const double laplacian = sums(0, 0) + sums(1, 1) + sums(2, 2);
    Mat3 block = sums.template topLeftCorner<3, 3>().transpose();
    block.diagonal().array() += laplacian;
    Vec3 divergence = sums.template bottomLeftCorner<1, 3>();
    const bool is_constrained = here != nullptr || there != nullptr;
    if (is_constrained) {
      eliminate(block, here, there, entry_edges_[k] < 0);
      divergence = free_divergence(divergence, there);
    }
    double* row = matrices.A.data() + 9 * start + 3 * std::size_t{places_[k]};
    for (Eigen::Index a = 0; a < 3; ++a, row += width)
      for (Eigen::Index b = 0; b < 3; ++b) put(row[b], block(a, b));
    for (const Laplacian& other : matrices.laplacians) {
      const auto is_fixed = [&](std::size_t node) { return (*other.is_fixed)[node]; };
      const bool is_out =
          is_constrained && entry_edges_[k] >= 0 && (is_fixed(i) || is_fixed(at(column_nodes_[k])));
      put(other.values[place], is_out ? 0.0 : laplacian);
    }
    for (std::size_t b = 0; b < 3; ++b)
      matrices.B[3 * k + b] = divergence[static_cast<Eigen::Index>(b)];
    matrices.C[k] = sums(3, 3);
  };
  std::size_t k = at(pressure_graph.row_start[at(p)]);
  const auto next_sums = [&]() -> const Eigen::Matrix4d& {
    fetch(sums_[at(entry_edges_[k + kEntriesAhead] / 2)], false);
    return sums_[at(entry_edges_[k] / 2)].products;
  };
  Eigen::Matrix4d from_a = Eigen::Matrix4d::Zero(), from_b = Eigen::Matrix4d::Zero();
  for (; entry_edges_[k] >= 0; ++k) {
    const Eigen::Matrix4d& sums = next_sums();
    from_b += sums;
    write_entry(k, sums.transpose());
  }
  const std::size_t diagonal = k++;
  for (; k < at(pressure_graph.row_start[at(p) + 1]); ++k) {
    const Eigen::Matrix4d& sums = next_sums();
    from_a += sums;
    write_entry(k, sums);
  }
  write_entry(diagonal, Eigen::Matrix4d(-from_a - from_b.transpose()));
}

}  // namespace meniscus::fem
