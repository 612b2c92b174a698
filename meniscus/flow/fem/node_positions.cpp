#include "meniscus/flow/fem/node_positions.hpp"

#include <algorithm>
#include <utility>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/constants.hpp"
#include "meniscus/flow/fem/curved_maps.hpp"

namespace meniscus::fem {
namespace {

Vec3 straight_middle(const TetMesh& mesh, const std::array<TetVertexId, 2>& edge) {
  return 0.5 * (mesh.x[edge[0]] + mesh.x[edge[1]]);
}

/// The mid-edge nodes that are exactly where a straight edge has them.
std::vector<char> straight_edges(const TetMesh& mesh, const FlowSpace& space,
                                 const NodePositions& positions) {
  std::vector<char> is_straight(space.edges.size());
  for (std::size_t e = 0; e < space.edges.size(); ++e) {
    const NodeId node{space.num_vertices() + static_cast<std::int32_t>(e)};
    is_straight[e] = positions.x[node] == straight_middle(mesh, space.edges[e]);
  }
  return is_straight;
}

/// Straightens what is curved of a cell; returns the number of its edges that were.
int straighten(const TetMesh& mesh, const FlowSpace& space, CellId c,
               std::vector<char>& is_straight, NodePositions& positions) {
  int count = 0;
  for (std::size_t k = 4; k < 10; ++k) {
    const NodeId node{space.velocity.of(c)[k]};
    MENISCUS_ASSERT(node.value >= space.num_vertices(), "node {} is a vertex", node.value);
    const auto e = static_cast<std::size_t>(node.value - space.num_vertices());
    if (is_straight[e]) continue;
    is_straight[e] = true;
    positions.x[node] = straight_middle(mesh, space.edges[e]);
    ++count;
  }
  return count;
}

/// Whether the maps of cells fold.
std::vector<char> are_folded(const TetMesh& mesh, const FlowSpace& space,
                             const NodePositions& positions, std::span<const CellId> cells) {
  const std::vector<double> least = least_jacobians(positions.x, space.velocity, cells);
  std::vector<char> result(cells.size());
  for (std::size_t n = 0; n < result.size(); ++n)
    result[n] = static_cast<char>(least[n] < kLeastJacobian * 6.0 * signed_volume(mesh, cells[n]));
  return result;
}

/// The middles of the edges of the outer boundary, on the smooth wall of one of the two patches.
std::vector<Vec3> wall_middles(const OuterBoundary& boundary, const SurfaceTopology& topology) {
  std::vector<Vec3> middles;
  for (const SurfaceEdge& edge : topology.edges()) {
    Vec3 middle = 0.5 * (boundary.mesh.x[edge.a] + boundary.mesh.x[edge.b]);
    for (const FaceId f : {edge.left, edge.right})
      if (const auto& on_wall = boundary.patches[boundary.patch[f]].on_smooth_wall)
        middle = on_wall(middle);
    middles.push_back(middle);
  }
  return middles;
}

}  // namespace

NodePositions straight_positions(const TetMesh& mesh, const FlowSpace& space) {
  NodePositions positions{{}, CellField<char>(mesh.num_cells(), 0), 0};
  positions.x.reserve(space.velocity.num_nodes);
  for (const Vec3& x : mesh.x) positions.x.add(x);
  for (const auto& edge : space.edges) positions.x.add(straight_middle(mesh, edge));
  return positions;
}

void curve_edges(const SurfaceMesh& surface, const SurfaceTopology& topology,
                 const FaceNodeTable& nodes, std::span<const Vec3> middles,
                 NodePositions& positions) {
  if (nodes.nodes_per_face < 6) return;
  for (std::size_t e = 0; e < middles.size(); ++e) {
    const SurfaceEdge& edge = topology.edges()[e];
    const FaceVertices& v = surface.faces[edge.left];
    const auto k = static_cast<std::size_t>(std::ranges::find(v, edge.a) - v.begin());
    MENISCUS_ASSERT(k < 3, "edge {} is not of its face", e);
    positions.x[nodes.of(edge.left)[3 + k]] = middles[e];  // left runs a → b
  }
}

void settle_curved_cells(const TetMesh& mesh, const FlowSpace& space, NodePositions& positions) {
  if (space.elements != Elements::p2_p1) return;
  std::vector<char> is_straight = straight_edges(mesh, space, positions);
  const auto is_curved = [&](CellId c) {
    return std::ranges::any_of(space.velocity.of(c).subspan(4), [&](std::int32_t node) {
      return !is_straight[static_cast<std::size_t>(node - space.num_vertices())];
    });
  };
  std::vector<CellId> curved;
  for (const CellId c : mesh.cells.ids())
    if (is_curved(c)) curved.push_back(c);
  // A straightened edge changes the cells around it, which are looked at again; there are fewer
  // curved edges each time.
  for (bool has_changed = true; std::exchange(has_changed, false);) {
    const std::vector<char> folded = are_folded(mesh, space, positions, curved);
    for (std::size_t n = 0; n < curved.size(); ++n) {
      // Others straightened before may have unfolded it.
      if (folded[n] == 0 ||
          are_folded(mesh, space, positions, std::span(&curved[n], 1)).front() == 0)
        continue;
      const int count = straighten(mesh, space, curved[n], is_straight, positions);
      positions.num_straightened += count;
      has_changed = has_changed || count > 0;
    }
  }
  for (const CellId c : curved) positions.is_curved[c] = is_curved(c);
}

NodePositions node_positions(const Scene& scene, const TetMesh& mesh, const FlowSpace& space,
                             KnownSurfaces* surfaces) {
  NodePositions positions = straight_positions(mesh, space);
  if (space.elements != Elements::p2_p1) return positions;
  KnownSurfaces none_known;
  if (surfaces == nullptr) surfaces = &none_known;
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
    const SurfaceMesh& mesh_of_interface = scene.interfaces[i].mesh;
    const auto surface = surfaces->of(mesh_of_interface, SurfaceShape::splined);
    curve_edges(mesh_of_interface, *surface->topology(),
                face_nodes(space, mesh, mesh_of_interface, mesh.interfaces[i]), surface->middles(),
                positions);
  }
  const SurfaceMesh& wall = scene.boundary.mesh;
  const SurfaceTopology topology(wall);
  curve_edges(wall, topology, face_nodes(space, mesh, wall, mesh.boundary),
              wall_middles(scene.boundary, topology), positions);
  settle_curved_cells(mesh, space, positions);
  return positions;
}

}  // namespace meniscus::fem
