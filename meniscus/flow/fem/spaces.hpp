#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "meniscus/flow/fem/options.hpp"
#include "meniscus/mesh/tet_mesh.hpp"

namespace meniscus::fem {

/// A node that carries a velocity: the vertices in their order, then (P2) the middles of the edges.
using NodeId = Id<struct NodeTag>;
[[nodiscard]] inline NodeId node_at(TetVertexId v) { return {v.value}; }

/// Which global nodes the local nodes of each cell are: |C| × nodes_per_cell.
struct NodeTable {
  std::int32_t num_nodes = 0;
  std::int32_t nodes_per_cell = 0;
  std::vector<std::int32_t> cell_nodes;

  [[nodiscard]] std::int32_t num_cells() const {
    return static_cast<std::int32_t>(cell_nodes.size() / static_cast<std::size_t>(nodes_per_cell));
  }
  [[nodiscard]] std::span<const std::int32_t> of(CellId c) const {
    return std::span(cell_nodes)
        .subspan(static_cast<std::size_t>(c.value) * static_cast<std::size_t>(nodes_per_cell),
                 static_cast<std::size_t>(nodes_per_cell));
  }
};

/// The ends of local node 4 + k of a quadratic tetrahedron.
inline constexpr std::array<std::array<std::size_t, 2>, 6> kCellEdges = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
/// The local number of the node between two corners.
[[nodiscard]] std::size_t edge_node(std::size_t a, std::size_t b);

/// P1 pressure, continuous in each region and double valued on interfaces (eqs 36–40 of
/// hooper2001). It has one node per pair of a vertex and a region with a cell there, in the order
/// of vertices, then regions.
struct PressureSpace {
  NodeTable nodes;
  std::vector<TetVertexId> vertex;  ///< of each node
  std::vector<RegionId> region;     ///< of each node
};
[[nodiscard]] PressureSpace pressure_space(const TetMesh& mesh);

struct NodeGraph;

/// Continuous velocity and the pressure that goes with it, on one topology. Positions are no part
/// of it.
struct FlowSpace {
  Elements elements = Elements::p1_p1;
  NodeTable velocity;  ///< 4 or 10 nodes per cell
  /// The ends of the mid-edge nodes, in their order; empty for P1.
  std::vector<std::array<TetVertexId, 2>> edges;
  PressureSpace pressure;

  [[nodiscard]] std::int32_t num_vertices() const {
    return velocity.num_nodes - static_cast<std::int32_t>(edges.size());
  }
  /// Which nodes of the velocity share cells. It is made when first asked for; the nodes must not
  /// change after that.
  [[nodiscard]] std::shared_ptr<const NodeGraph> velocity_graph() const;

 private:
  mutable std::shared_ptr<const NodeGraph> velocity_graph_;
};
[[nodiscard]] FlowSpace flow_space(const TetMesh& mesh, Elements elements);

/// The nodes of the faces of an embedded surface: the corners in the face's order, then (P2) the
/// middles of the edges 01, 12, 20.
struct FaceNodeTable {
  std::int32_t nodes_per_face = 0;
  std::vector<NodeId> face_nodes;

  [[nodiscard]] auto faces() const {
    return ids<FaceId>(static_cast<std::int32_t>(face_nodes.size()) / nodes_per_face);
  }
  [[nodiscard]] std::span<const NodeId> of(FaceId f) const {
    return std::span(face_nodes)
        .subspan(static_cast<std::size_t>(f.value) * static_cast<std::size_t>(nodes_per_face),
                 static_cast<std::size_t>(nodes_per_face));
  }
};
[[nodiscard]] FaceNodeTable face_nodes(const FlowSpace& space, const TetMesh& mesh,
                                       const SurfaceMesh& surface, const EmbeddedSurface& embedded);

}  // namespace meniscus::fem
