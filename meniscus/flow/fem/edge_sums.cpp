#include "meniscus/flow/fem/edge_sums.hpp"

#include <algorithm>
#include <array>

#include <Eigen/Geometry>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/block_rows.hpp"

namespace meniscus::fem {
namespace {

constexpr std::size_t kEntriesAhead = 16;  // sums are fetched so long before they are written

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Asks for the two cache lines of a sum.
void fetch(const EdgeIntegrals<double>& sums, bool to_write) {
  const char* const first = reinterpret_cast<const char*>(&sums);
  for (const char* line : {first, first + 64})
    to_write ? __builtin_prefetch(line, 1) : __builtin_prefetch(line, 0);
}

void subtract(EdgeIntegrals<double>& from, const EdgeIntegrals<double>& sums, double turn) {
  from = {from.xx - sums.xx,      from.yy - sums.yy,
          from.zz - sums.zz,      from.stabilisation - sums.stabilisation,
          from.xy - sums.xy,      from.xz - sums.xz,
          from.yz - sums.yz,      from.mass - sums.mass,
          from.x - turn * sums.x, from.y - turn * sums.y,
          from.z - turn * sums.z, 0.0};
}

/// The edges of a graph, numbered by their lower end, then by their upper one: 2·edge + (row >
/// column) for each entry. On the diagonal edge is the number of them all.
std::vector<std::int32_t> number_edges(const NodeGraph& graph) {
  std::vector<std::int32_t> edges(graph.num_entries()), next(at(graph.num_rows()));
  const std::int32_t num_edges =
      (static_cast<std::int32_t>(graph.num_entries()) - graph.num_rows()) / 2;
  std::int32_t count = 0;
  for (std::int32_t p = 0; p < graph.num_rows(); ++p) {
    std::size_t k = at(graph.row_start[at(p)]);
    // Row q names its upper neighbours in the order in which they come here.
    for (; graph.columns[k] < p; ++k) edges[k] = 2 * next[at(graph.columns[k])]++ + 1;
    MENISCUS_ASSERT(graph.columns[k] == p, "row {} lacks its diagonal", p);
    edges[k++] = 2 * num_edges;
    next[at(p)] = count;
    for (; k < at(graph.row_start[at(p) + 1]); ++k) edges[k] = 2 * count++;
  }
  MENISCUS_ASSERT(count == num_edges, "{} {}", count, num_edges);
  return edges;
}

}  // namespace

EdgeSums::EdgeSums(const FlowSpace& space, const NodeGraph& velocity_graph,
                   const NodeGraph& coupling_graph, const NodeGraph& pressure_graph)
    : sums_((pressure_graph.num_entries() - at(pressure_graph.num_rows())) / 2 + 2),
      entry_edges_(number_edges(pressure_graph)),
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
  entry_edges_.resize(entry_edges_.size() + kEntriesAhead);
  for (const auto& [c, corners] : liquid_faces(space.pressure.nodes, pressure_graph))
    for (std::size_t a = 0; a < 3; ++a) {
      const std::int32_t p = space.pressure.nodes.of(c)[corners[a]];
      const auto entry = [&](std::size_t b) {
        const std::size_t pair = 16 * at(c.value) + 4 * corners[a] + corners[b % 3];
        return static_cast<std::int32_t>(pressure_graph.entry(p, pair));
      };
      corners_.push_back({p, c, entry(a), entry(a + 1), entry(a + 2)});
    }
  std::ranges::stable_sort(corners_, {}, &BoundaryCorner::pressure);
}

bool EdgeSums::can_assemble(const StokesProblem& problem) {
  Field<RegionId, double> of_region;
  for (const CellId c : problem.mesh.cells.ids()) {
    const RegionId region = problem.mesh.region[c];
    if (region.value >= of_region.size()) of_region.resize(region.value + 1);
    double& own = of_region[region];
    if (own == 0.0) own = problem.viscosity[c];
    if (own != problem.viscosity[c]) return false;
  }
  return true;
}

void EdgeSums::assemble(const StokesProblem& problem, std::span<const CellId> cells,
                        std::int32_t num_pressures, const Matrices& matrices) {
  MENISCUS_ASSERT(can_assemble(problem));
  std::ranges::fill(sums_, EdgeIntegrals<double>{});
  add(problem, cells);
  write(problem, num_pressures, matrices);
}

void EdgeSums::add(const StokesProblem& problem, std::span<const CellId> cells) {
  const auto of_no_use = static_cast<std::int32_t>(2 * (sums_.size() - 1));
  CellBatch batch;
  for (std::size_t first = 0; first < cells.size(); first += CellBatch::size) {
    const auto some = cells.subspan(first, std::min(CellBatch::size, cells.size() - first));
    for (std::size_t m = 0; m < some.size(); ++m) put(problem, some[m], batch, m);
    for (std::size_t m = some.size(); m < CellBatch::size; ++m) {
      put(problem, some.front(), batch, m);
      for (auto& edge : batch.edge) edge[m] = of_no_use;
    }
    batch.add_to(sums_);
  }
}

/// Puts a cell into a batch as its cell m. Prefetches the sums that it will be added to.
void EdgeSums::put(const StokesProblem& problem, CellId c, CellBatch& batch, std::size_t m) const {
  for (std::size_t k = 0; k < 6; ++k) {
    batch.edge[k][m] = cell_edges_[6 * at(c.value) + k];
    fetch(sums_[at(batch.edge[k][m]) / 2], true);
  }
  const auto nodes = problem.space.velocity.of(c);
  for (std::size_t a = 0; a < 4; ++a) {
    const Vec3& x = problem.positions.x[NodeId{nodes[a]}];
    for (std::size_t i = 0; i < 3; ++i) batch.corner[a][i][m] = x[static_cast<Eigen::Index>(i)];
  }
  batch.viscosity[m] = problem.viscosity[c];
}

void EdgeSums::write(const StokesProblem& problem, std::int32_t num_pressures,
                     const Matrices& matrices) const {
  const std::vector<bool> is_plain = find_plain_nodes(problem.constraints, matrices);
  for (std::size_t i = 0; i < is_plain.size(); ++i) {
    if (is_plain[i]) continue;
    const std::size_t start = at(matrices.velocity_graph.row_start[i]),
                      count = at(matrices.velocity_graph.row_start[i + 1]) - start;
    std::ranges::fill(matrices.A.subspan(9 * start, 9 * count), 0.0);
    for (const Laplacian& laplacian : matrices.laplacians)
      std::ranges::fill(laplacian.values.subspan(start, count), 0.0);
  }
  auto corner = corners_.begin();
  for (std::int32_t p = 0; p < num_pressures; ++p) {
    if (is_plain[at(node_[at(p)])])
      write_row<true>(p, problem.constraints, matrices);
    else
      write_row<false>(p, problem.constraints, matrices);
    for (; corner != corners_.end() && corner->pressure == p; ++corner)
      if (matrices.pressure_mass[at(p)] != 0.0)  // this liquid's cells are in the sums
        add_boundary(*corner, problem, matrices);
  }
}

/// Nodes in one liquid that neither are constrained nor have a constrained neighbour.
std::vector<bool> EdgeSums::find_plain_nodes(const Constraints& constraints,
                                             const Matrices& matrices) const {
  std::vector<bool> is_plain = is_shared_;
  is_plain.flip();
  const std::vector<std::int32_t>& row_start = matrices.pressure_graph.row_start;
  for (std::size_t p = 0; p < node_.size(); ++p) {
    if (constraints.find(NodeId{node_[p]}) == nullptr) continue;
    for (std::size_t k = at(row_start[p]); k < at(row_start[p + 1]); ++k)
      is_plain[at(column_nodes_[k])] = false;
  }
  return is_plain;
}

/// Writes the rows of B and C of a pressure, and its part of the rows of A and the Laplacians.
template <bool is_plain>
[[gnu::always_inline]] inline void EdgeSums::write_entry(const Row& row, std::size_t k,
                                                         const EdgeIntegrals<double>& sums,
                                                         double turn, bool is_diagonal) const {
  const double laplacian = sums.xx + sums.yy + sums.zz;
  Mat3 block;
  block << laplacian + sums.xx, sums.xy, sums.xz,  //
      sums.xy, laplacian + sums.yy, sums.yz,       //
      sums.xz, sums.yz, laplacian + sums.zz;
  Vec3 divergence(turn * sums.x, turn * sums.y, turn * sums.z);
  bool is_constrained = false;
  if constexpr (!is_plain) {
    const NodeConstraint* const there = row.constraints.find(NodeId{column_nodes_[k]});
    is_constrained = row.constraint != nullptr || there != nullptr;
    eliminate(block, row.constraint, there, is_diagonal);
    divergence = free_divergence(divergence, there);
  }
  const auto put = [](double& to, double value) { is_plain ? to = value : to += value; };
  double* to = row.matrices.A.data() + 9 * row.start + 3 * std::size_t{places_[k]};
  for (Eigen::Index a = 0; a < 3; ++a, to += row.width)
    for (Eigen::Index b = 0; b < 3; ++b) put(to[b], block(a, b));
  for (const Laplacian& other : row.matrices.laplacians) {
    const auto is_fixed = [&](std::int32_t i) { return (*other.is_fixed)[at(i)]; };
    const bool is_out =
        is_constrained && !is_diagonal && (is_fixed(row.node) || is_fixed(column_nodes_[k]));
    put(other.values[row.start + places_[k]], is_out ? 0.0 : laplacian);
  }
  Eigen::Map<Vec3>(row.matrices.B.data() + 3 * k) = divergence;
  row.matrices.C[k] = sums.stabilisation;
}

template <bool is_plain>
void EdgeSums::write_row(std::int32_t p, const Constraints& constraints,
                         const Matrices& matrices) const {
  const std::int32_t node = node_[at(p)];
  const std::size_t start = at(matrices.velocity_graph.row_start[at(node)]),
                    next = at(matrices.velocity_graph.row_start[at(node) + 1]),
                    begin = at(matrices.pressure_graph.row_start[at(p)]),
                    end = at(matrices.pressure_graph.row_start[at(p) + 1]);
  const Row row{constraints, matrices, constraints.find(NodeId{node}),
                node,        start,    3 * (next - start)};
  const auto end_of_edges = static_cast<std::int32_t>(2 * (sums_.size() - 2));
  std::size_t diagonal = 0;
  EdgeIntegrals<double> rest{};  // minus what has been written
  for (std::size_t k = begin; k < end; ++k) {
    fetch(sums_[at(entry_edges_[k + kEntriesAhead]) / 2], false);
    // Where the next node's blocks go, one line each: 43 ns a cell without, 32 with.
    __builtin_prefetch(matrices.A.data() + 9 * (next + k - begin), 1);
    const std::int32_t edge = entry_edges_[k];
    if (edge == end_of_edges) diagonal = k;  // written twice
    const EdgeIntegrals<double>& sums = sums_[at(edge) / 2];
    const double turn = edge % 2 != 0 ? -1.0 : 1.0;
    subtract(rest, sums, turn);
    write_entry<is_plain>(row, k, sums, turn, false);
  }
  MENISCUS_ASSERT(begin <= diagonal && diagonal < end, "pressure {}", p);
  write_entry<is_plain>(row, diagonal, rest, 1.0, true);
  matrices.pressure_mass[at(p)] = -rest.mass;
}

/// Adds the terms on a liquid's boundary, which the sums leave out.
void EdgeSums::add_boundary(const BoundaryCorner& corner, const StokesProblem& problem,
                            const Matrices& matrices) const {
  const NodeId a{node_[at(corner.pressure)]}, b{column_nodes_[at(corner.next)]},
      c{column_nodes_[at(corner.previous)]};
  const Field<NodeId, Vec3>& x = problem.positions.x;
  const Vec3 area = 0.5 * (x[b] - x[a]).cross(x[c] - x[a]);
  const auto add_to_B = [&](std::int32_t k, const Vec3& divergence) {
    const NodeConstraint* const there = problem.constraints.find(NodeId{column_nodes_[at(k)]});
    Eigen::Map<Vec3>(matrices.B.data() + 3 * at(k)) += free_divergence(divergence, there);
  };
  const auto add_to_A = [&](std::int32_t k, const Vec3& s) {
    Mat3 block;  // [s]×
    block << 0.0, -s.z(), s.y(), s.z(), 0.0, -s.x(), -s.y(), s.x(), 0.0;
    eliminate(block, problem.constraints.find(a),
              problem.constraints.find(NodeId{column_nodes_[at(k)]}), false);
    BlockRows(matrices.A, matrices.velocity_graph, a.value).add(places_[at(k)], block);
  };
  // Half of μ/6 for the antisymmetric part; ends are seen from the middle of the edge, as they are
  // from the other face there.
  const double factor = problem.viscosity[corner.cell] / 12.0;
  add_to_A(corner.next, factor * (x[c] - 0.5 * (x[a] + x[b])));
  add_to_A(corner.previous, -factor * (x[b] - 0.5 * (x[a] + x[c])));
  add_to_B(corner.next, -area / 24.0);
  add_to_B(corner.previous, -area / 24.0);
  add_to_B(corner.own, area / 12.0);  // rows sum to zero
}

}  // namespace meniscus::fem
