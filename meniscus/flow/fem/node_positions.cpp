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

/// Whether the maps of cells fold.
std::vector<char> are_folded(const TetMesh& mesh, const FlowSpace& space,
                             const NodePositions& positions, std::span<const CellId> cells) {
  const std::vector<double> least = least_jacobians(positions.x, space.velocity, cells);
  std::vector<char> result(cells.size());
  for (std::size_t n = 0; n < result.size(); ++n)
    result[n] = static_cast<char>(least[n] < kLeastJacobian * 6.0 * signed_volume(mesh, cells[n]));
  return result;
}

/// What an edge is like. Inside a region it goes from `straight` to `bent` to `settled`, on a
/// surface from `curved` to `flattened`, less curved each time; so the search for folds ends.
enum class EdgeShape : char {
  straight,   ///< may be bent
  bent,       ///< beside a curved edge
  curved,     ///< as its surface is
  flattened,  ///< less curved than its surface
  settled     ///< straight from now on
};
/// What flattening leaves of an edge's displacement each time. Cells that begin to fold need it
/// once, so that the elements change little from one step to the next.
constexpr double kFlatter = 0.9;

/// Keeps the maps of curved cells from folding (`settle_curved_cells`).
class CurvedCells {
 public:
  CurvedCells(const TetMesh& mesh, const FlowSpace& space, std::span<const FaceNodeTable> surfaces,
              NodePositions& positions)
      : mesh_(mesh), space_(space), positions_(positions), shape_(space.edges.size()) {
    for (std::size_t e = 0; e < shape_.size(); ++e)
      if (displacement(e) != Vec3::Zero()) shape_[e] = EdgeShape::curved;
    for (const FaceNodeTable& surface : surfaces)
      for (const FaceId f : surface.faces())
        for (const NodeId node : surface.of(f).subspan(3))
          if (auto& shape = shape_[edge(node)]; shape == EdgeShape::straight)
            shape = EdgeShape::settled;
  }

  void settle() {
    for (bool has_changed = true; std::exchange(has_changed, false);) {
      const std::vector<CellId> cells = curved_cells();
      const std::vector<char> folded = are_folded(mesh_, space_, positions_, cells);
      for (std::size_t n = 0; n < cells.size(); ++n) {
        // What was done to others before may have unfolded it.
        if (folded[n] != 0 && is_folded(cells[n])) has_changed = unfold(cells[n]) || has_changed;
      }
    }
    for (const CellId c : curved_cells()) positions_.is_curved[c] = 1;
  }

 private:
  static constexpr std::size_t kEdges = kCellEdges.size();

  [[nodiscard]] NodeId node(std::size_t e) const {
    return NodeId{space_.num_vertices() + static_cast<std::int32_t>(e)};
  }
  [[nodiscard]] std::size_t edge(NodeId node) const {
    MENISCUS_ASSERT(node.value >= space_.num_vertices(), "node {} is a vertex", node.value);
    return static_cast<std::size_t>(node.value - space_.num_vertices());
  }
  [[nodiscard]] std::array<std::size_t, kEdges> edges(CellId c) const {
    std::array<std::size_t, kEdges> result{};
    for (std::size_t k = 0; k < kEdges; ++k) result[k] = edge(NodeId{space_.velocity.of(c)[4 + k]});
    return result;
  }
  [[nodiscard]] Vec3 displacement(std::size_t e) const {
    return positions_.x[node(e)] - straight_middle(mesh_, space_.edges[e]);
  }
  [[nodiscard]] bool is_on_surface(std::size_t e) const {
    return shape_[e] == EdgeShape::curved || shape_[e] == EdgeShape::flattened;
  }
  [[nodiscard]] bool is_off_its_middle(std::size_t e) const {
    return shape_[e] == EdgeShape::bent || is_on_surface(e);
  }

  [[nodiscard]] std::vector<CellId> curved_cells() const {
    std::vector<CellId> cells;
    for (const CellId c : mesh_.cells.ids())
      if (std::ranges::any_of(edges(c), [&](std::size_t e) { return is_off_its_middle(e); }))
        cells.push_back(c);
    return cells;
  }

  /// Bends the straight edges beside curved ones by half of these edges' displacement d. Let s rise
  /// from 0 at a curved edge to 1 at the opposite corner. Then the displacement 4 Σ λ_i λ_j d_ij is
  /// d(1 − s²); beside straight edges it is d(1 − s)².
  bool bend(CellId c) {
    const auto of_cell = edges(c);
    bool has_bent = false;
    for (std::size_t k = 0; k < kEdges; ++k) {
      if (shape_[of_cell[k]] != EdgeShape::straight) continue;
      Vec3 sum = Vec3::Zero();
      int count = 0;
      for (std::size_t l = 0; l < kEdges; ++l) {
        if (!is_on_surface(of_cell[l]) || !share_an_end(k, l)) continue;
        sum += displacement(of_cell[l]);
        ++count;
      }
      if (count == 0) continue;
      positions_.x[node(of_cell[k])] += 0.5 / count * sum;
      shape_[of_cell[k]] = EdgeShape::bent;
      has_bent = true;
    }
    return has_bent;
  }

  /// What bending does not help needs flatter edges of surfaces.
  bool unfold(CellId c) {
    if (bend(c)) return true;
    if (!is_folded_without_bends(c)) return straighten_bends(c);
    if (!(signed_volume(mesh_, c) > 0.0)) return false;  // straight it would be folded, too
    flatten(c);
    return true;
  }

  [[nodiscard]] bool is_folded(CellId c) const {
    return are_folded(mesh_, space_, positions_, std::span(&c, 1)).front() != 0;
  }
  [[nodiscard]] bool is_folded_without_bends(CellId c) {
    std::array<Vec3, kEdges> bent;
    const auto of_cell = edges(c);
    for (std::size_t k = 0; k < kEdges; ++k) {
      Vec3& x = positions_.x[node(of_cell[k])];
      bent[k] = x;
      if (shape_[of_cell[k]] == EdgeShape::bent)
        x = straight_middle(mesh_, space_.edges[of_cell[k]]);
    }
    const bool result = is_folded(c);
    for (std::size_t k = 0; k < kEdges; ++k) positions_.x[node(of_cell[k])] = bent[k];
    return result;
  }

  static bool share_an_end(std::size_t k, std::size_t l) {
    return std::ranges::any_of(kCellEdges[k], [&](std::size_t end) {
      return std::ranges::find(kCellEdges[l], end) != kCellEdges[l].end();
    });
  }
  bool straighten_bends(CellId c) {
    bool has_straightened = false;
    for (const std::size_t e : edges(c)) {
      if (shape_[e] != EdgeShape::bent) continue;
      positions_.x[node(e)] = straight_middle(mesh_, space_.edges[e]);
      shape_[e] = EdgeShape::settled;
      has_straightened = true;
    }
    return has_straightened;
  }
  /// Takes the edges of a cell towards their middles until it is not folded: straight it is not.
  void flatten(CellId c) {
    while (is_folded(c))
      for (const std::size_t e : edges(c)) {
        positions_.x[node(e)] =
            straight_middle(mesh_, space_.edges[e]) + kFlatter * displacement(e);
        if (shape_[e] != EdgeShape::curved) continue;
        shape_[e] = EdgeShape::flattened;
        ++positions_.num_flattened;
      }
  }

  const TetMesh& mesh_;
  const FlowSpace& space_;
  NodePositions& positions_;
  std::vector<EdgeShape> shape_;  // of every edge
};

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

void settle_curved_cells(const TetMesh& mesh, const FlowSpace& space,
                         std::span<const FaceNodeTable> surfaces, NodePositions& positions) {
  if (space.elements == Elements::p2_p1) CurvedCells(mesh, space, surfaces, positions).settle();
}

NodePositions node_positions(const Scene& scene, const TetMesh& mesh, const FlowSpace& space,
                             KnownSurfaces* surfaces) {
  NodePositions positions = straight_positions(mesh, space);
  if (space.elements != Elements::p2_p1) return positions;
  KnownSurfaces none_known;
  if (surfaces == nullptr) surfaces = &none_known;
  std::vector<FaceNodeTable> faces;
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
    const SurfaceMesh& mesh_of_interface = scene.interfaces[i].mesh;
    const auto surface = surfaces->of(mesh_of_interface, SurfaceShape::splined);
    faces.push_back(face_nodes(space, mesh, mesh_of_interface, mesh.interfaces[i]));
    curve_edges(mesh_of_interface, *surface->topology(), faces.back(), surface->middles(),
                positions);
  }
  const SurfaceMesh& wall = scene.boundary.mesh;
  const SurfaceTopology topology(wall);
  faces.push_back(face_nodes(space, mesh, wall, mesh.boundary));
  curve_edges(wall, topology, faces.back(), wall_middles(scene.boundary, topology), positions);
  settle_curved_cells(mesh, space, faces, positions);
  return positions;
}

}  // namespace meniscus::fem
