#include "meniscus/flow/fem/stokes_sparsity.hpp"

#include "meniscus/core/error.hpp"

namespace meniscus::fem {
namespace {

void renumber(NodeGraph& graph, const std::vector<std::int32_t>& number) {
  for (std::int32_t& column : graph.columns) column = number[static_cast<std::size_t>(column)];
}

}  // namespace

StokesSparsity::StokesSparsity(const FlowSpace& space)
    : velocity_(node_graph(space.velocity, space.velocity)),
      coupling_(node_graph(space.pressure.nodes, space.velocity)),
      pressure_(node_graph(space.pressure.nodes, space.pressure.nodes)) {}

void StokesSparsity::number_columns(const Partition* partition) {
  MENISCUS_ASSERT(A_.row_start.empty(), "columns are numbered once");
  if (partition != nullptr) {
    renumber(velocity_, partition->node_number);
    renumber(coupling_, partition->node_number);
    renumber(pressure_, partition->pressure_number);
  }
  A_ = scalar_pattern(velocity_, 3, 3);
  B_ = scalar_pattern(coupling_, 1, 3);
}

void StokesSparsity::forget_positions() {
  for (NodeGraph* graph : {&velocity_, &coupling_, &pressure_})
    std::vector<std::uint16_t>().swap(graph->position);
}

void StokesSparsity::recall_positions(const FlowSpace& space) {
  if (!velocity_.position.empty()) return;
  const NodeTable &velocity = space.velocity, &pressure = space.pressure.nodes;
  MENISCUS_ASSERT(velocity.num_nodes == velocity_.num_rows(), "another space: {} {}",
                  velocity.num_nodes, velocity_.num_rows());
  velocity_.position = node_graph(velocity, velocity).position;
  coupling_.position = node_graph(pressure, velocity).position;
  pressure_.position = node_graph(pressure, pressure).position;
}

}  // namespace meniscus::fem
