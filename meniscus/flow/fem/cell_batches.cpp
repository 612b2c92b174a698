#include "meniscus/flow/fem/cell_batches.hpp"

#include <algorithm>

#include "meniscus/flow/fem/elements.hpp"
#include "meniscus/flow/fem/partition.hpp"

namespace meniscus::fem {

using namespace lanes;

namespace {

void set(Tensor& to, std::size_t m, const std::array<Vec3, 3>& gradients) {
  for (std::size_t l = 0; l < 3; ++l)
    for (std::size_t a = 0; a < 3; ++a) to[l][a][m] = gradients[l][static_cast<Eigen::Index>(a)];
}

/// Sets lane m to a cell of a problem, whose volume counts so many times.
void set(StraightCells& cells, std::size_t m, const StokesProblem& problem, CellId c,
         double times) {
  const auto nodes = problem.space.velocity.of(c);
  const auto x = [&](std::size_t k) { return problem.positions.x[NodeId{nodes[k]}]; };
  const LinearTetrahedron tet = linear_tetrahedron({x(0), x(1), x(2), x(3)});
  set(cells.gradient, m, {tet.gradient[1], tet.gradient[2], tet.gradient[3]});
  cells.volume[m] = times * tet.volume / 20.0;
}

MENISCUS_VECTOR_CLONES
void set_points(std::span<CurvedCells> batches, const double* x) {
  for (CurvedCells& cells : batches) {
    Nodal nodes;
    Derivatives d;
    take(cells.nodes, x, nodes);
    differentiate(nodes, d);
    for (std::size_t q = 0; q < cells.points.size(); ++q)
      set_point(kTetrahedronRule5[q], d, cells.points[q]);
  }
}

std::size_t num_batches(std::span<const CellId> cells) {
  return (cells.size() + kLanes - 1) / kLanes;
}

/// The cells by fours, without their shapes. The last lanes repeat a cell, which then gets no
/// volume.
template <class Batch>
std::vector<Batch> batches_of(const StokesProblem& problem, std::span<const CellId> cells) {
  std::vector<Batch> batches(num_batches(cells));
  for (std::size_t n = 0; n < kLanes * batches.size(); ++n) {
    const CellId c = cells[std::min(n, cells.size() - 1)];
    Batch& batch = batches[n / kLanes];
    const std::size_t m = n % kLanes;
    const auto nodes = problem.space.velocity.of(c), pressures = problem.space.pressure.nodes.of(c);
    for (std::size_t i = 0; i < nodes.size(); ++i) batch.nodes[i][m] = nodes[i];
    for (std::size_t i = 0; i < pressures.size(); ++i) batch.pressures[i][m] = pressures[i];
    batch.viscosity[m] = problem.viscosity[c];
  }
  return batches;
}

/// Whether the cell in lane n is there for the first time.
bool is_first(std::span<const CellId> cells, std::size_t n) {
  return n < cells.size() && (n == 0 || cells[n] != cells[n - 1]);
}

void set_shapes(const StokesProblem& problem, std::span<const CellId> cells,
                std::vector<StraightCells>& batches) {
  for (std::size_t n = 0; n < kLanes * batches.size(); ++n)
    set(batches[n / kLanes], n % kLanes, problem, cells[std::min(n, cells.size() - 1)],
        is_first(cells, n) ? 1.0 : 0.0);
}

void set_shapes(const StokesProblem& problem, std::span<const CellId> cells,
                std::vector<CurvedCells>& batches) {
  set_points(batches, numbers(problem.positions.x).data());
  for (std::size_t n = 0; n < kLanes * batches.size(); ++n)
    if (!is_first(cells, n))
      for (CurvedPoint& point : batches[n / kLanes].points) point.weight[n % kLanes] = 0.0;
}

/// Repeats the last cell until the last batch is full.
void fill_batch(std::vector<CellId>& cells) {
  while (cells.size() % kLanes != 0) cells.push_back(cells.back());
}

}  // namespace

CellBatches cell_batches(const StokesProblem& problem) {
  CellBatches batches;
  const auto take = [&](std::int32_t begin, std::int32_t end) {
    for (CellId c{begin}; c.value < end; ++c.value)
      (problem.positions.is_curved[c] ? batches.curved_cells : batches.straight_cells).push_back(c);
  };
  const std::int32_t num_owned = owned_counts(problem).num_cells,
                     num_cells = problem.mesh.num_cells();
  take(0, num_owned);
  if (num_owned < num_cells) {
    fill_batch(batches.straight_cells);
    fill_batch(batches.curved_cells);
  }
  batches.num_owned_straight = num_batches(batches.straight_cells);
  batches.num_owned_curved = num_batches(batches.curved_cells);
  take(num_owned, num_cells);
  batches.straight = batches_of<StraightCells>(problem, batches.straight_cells);
  batches.curved = batches_of<CurvedCells>(problem, batches.curved_cells);
  set_shapes(problem, batches.straight_cells, batches.straight);
  batches.straightened = batches_of<StraightCells>(problem, batches.curved_cells);
  set_shapes(problem, batches.curved_cells, batches.curved);
  set_shapes(problem, batches.curved_cells, batches.straightened);
  return batches;
}

}  // namespace meniscus::fem
