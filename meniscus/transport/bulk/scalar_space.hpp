#pragma once

#include <memory>
#include <span>
#include <vector>

#include "meniscus/flow/fem/known_elements.hpp"
#include "meniscus/flow/fem/node_graph.hpp"

namespace meniscus::bulk {

using fem::NodeId;
using fem::NodePositions;

/// The finite elements of bulk scalars on one connectivity: those of the flow's velocity.
struct ScalarSpace {
  std::shared_ptr<const fem::FlowSpace> of_flow;
  const fem::FlowSpace& elements = *of_flow;
  const fem::NodeGraph& graph = *elements.velocity_graph();  ///< of the nodes with one another
  std::vector<fem::FaceNodeTable> interfaces;
  fem::FaceNodeTable boundary;

  [[nodiscard]] std::int32_t num_nodes() const { return elements.velocity.num_nodes; }
};
[[nodiscard]] ScalarSpace scalar_space(const FlowDomain& domain,
                                       std::shared_ptr<const fem::FlowSpace> of_flow);

/// Where an entry is in the values of a matrix on a graph; it must be there.
[[nodiscard]] std::size_t place_of(const fem::NodeGraph& graph, NodeId row, NodeId column);

/// Where the nodes are half way on straight lines.
[[nodiscard]] NodePositions halfway(const NodePositions& from, const NodePositions& to);

/// The volumes of the regions' elements [R0³].
[[nodiscard]] std::vector<double> element_volumes(const TetMesh& mesh, const ScalarSpace& space,
                                                  const NodePositions& positions);
/// The volumes that the scene's regions are to have; that of the matrix is what is left of `total`.
[[nodiscard]] std::vector<double> nominal_volumes(const Scene& scene, double total);

/// The volume that each region is to have over that of its elements, near 1.
[[nodiscard]] std::vector<double> volume_shares(const Scene& scene,
                                                std::span<const double> element_volumes);

/// The nodes at which a scalar is given, with its value.
struct GivenValues {
  std::vector<char> is_given;  ///< by node
  std::vector<double> value;   ///< 0 elsewhere
  bool any = false;
};
/// Where patches meet, that of the lowest id counts.
[[nodiscard]] GivenValues given_values(const Scene& scene, std::size_t scalar,
                                       const ScalarSpace& space, const NodePositions& positions);

}  // namespace meniscus::bulk
