#include "meniscus/flow/fem/damping_assembly.hpp"

#include <algorithm>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/block_rows.hpp"
#include "meniscus/flow/fem/partition.hpp"

namespace meniscus::fem {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// The entry of row i, counted from its first, that a node's column is.
std::size_t entry_in_row(const NodeGraph& graph, NodeId i, std::int32_t column) {
  const auto begin = graph.columns.begin() + graph.row_start[at(i.value)],
             end = graph.columns.begin() + graph.row_start[at(i.value) + 1];
  const auto found = std::find(begin, end, column);
  MENISCUS_ASSERT(found != end, "nodes {} and {} share no cell", i.value, column);
  return static_cast<std::size_t>(found - begin);
}

}  // namespace

void add_damping(const StokesProblem& problem, const NodeGraph& graph, StokesValues& values,
                 std::span<ScalarLaplacian> laplacians) {
  const SurfaceDamping& damping = problem.damping;
  const std::int32_t num_owned = owned_counts(problem).num_nodes;
  for (const auto& [i, j, weight] : damping.entries) {
    if (i.value >= num_owned) continue;
    MENISCUS_ASSERT(problem.constraints.find(i) == nullptr, "a damped node {} is held", i.value);
    const std::int32_t column =
        problem.partition == nullptr ? j.value : problem.partition->node_number[at(j.value)];
    const std::size_t k = entry_in_row(graph, i, column);
    const Mat3 block = weight * damping.normal[i] * damping.normal[j].transpose();
    BlockRows(values.A, graph, i.value).add(k, block);
    for (ScalarLaplacian& laplacian : laplacians)
      laplacian.values[at(graph.row_start[at(i.value)]) + k] += block.trace() / 3.0;
  }
}

}  // namespace meniscus::fem
