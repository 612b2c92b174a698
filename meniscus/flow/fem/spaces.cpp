#include "meniscus/flow/fem/spaces.hpp"

#include <algorithm>
#include <utility>

#include "meniscus/flow/fem/node_graph.hpp"

namespace meniscus::fem {
namespace {

/// The regions around each vertex in rising order, as one list with offsets.
struct RegionsAtVertices {
  std::vector<std::int32_t> first;  ///< of vertex v: [first[v], first[v + 1])
  std::vector<RegionId> region;
};

RegionsAtVertices regions_at_vertices(const TetMesh& mesh) {
  // Nearly every vertex has one region: keep that one apart, and the others in a short list.
  Field<TetVertexId, RegionId> only(mesh.num_vertices());
  std::vector<std::pair<TetVertexId, RegionId>> pairs;
  for (const CellId c : mesh.cells.ids())
    for (const TetVertexId v : mesh.cells[c]) {
      if (!only[v].is_valid()) only[v] = mesh.region[c];
      if (only[v] != mesh.region[c]) pairs.emplace_back(v, mesh.region[c]);
    }
  for (const TetVertexId v : mesh.x.ids())
    if (only[v].is_valid()) pairs.emplace_back(v, only[v]);
  std::ranges::sort(pairs);
  pairs.erase(std::ranges::unique(pairs).begin(), pairs.end());

  RegionsAtVertices result;
  result.first.assign(static_cast<std::size_t>(mesh.num_vertices()) + 1, 0);
  for (const auto& [v, region] : pairs) {
    ++result.first[static_cast<std::size_t>(v.value) + 1];
    result.region.push_back(region);
  }
  for (std::size_t v = 1; v < result.first.size(); ++v) result.first[v] += result.first[v - 1];
  return result;
}

/// Numbers the edges of a mesh in the order in which the cells meet them, and appends the middle of
/// each to the cells' nodes.
void add_edge_nodes(const TetMesh& mesh, FlowSpace& space) {
  // Per lower end, the edges that begin there: a dozen at most.
  std::vector<std::vector<std::pair<std::int32_t, std::int32_t>>> from(
      static_cast<std::size_t>(mesh.num_vertices()));
  const auto node_between = [&](TetVertexId a, TetVertexId b) {
    if (b < a) std::swap(a, b);
    auto& known = from[static_cast<std::size_t>(a.value)];
    const auto found =
        std::ranges::find(known, b.value, &std::pair<std::int32_t, std::int32_t>::first);
    if (found != known.end()) return found->second;
    const std::int32_t node = mesh.num_vertices() + static_cast<std::int32_t>(space.edges.size());
    space.edges.push_back({a, b});
    known.emplace_back(b.value, node);
    return node;
  };
  for (const CellVertices& cell : mesh.cells) {
    for (const TetVertexId v : cell) space.velocity.cell_nodes.push_back(v.value);
    for (const auto& [a, b] : kCellEdges)
      space.velocity.cell_nodes.push_back(node_between(cell[a], cell[b]));
  }
  space.velocity.num_nodes += static_cast<std::int32_t>(space.edges.size());
}

}  // namespace

std::size_t edge_node(std::size_t a, std::size_t b) {
  const std::array<std::size_t, 2> ends = {std::min(a, b), std::max(a, b)};
  return 4 + static_cast<std::size_t>(std::ranges::find(kCellEdges, ends) - kCellEdges.begin());
}

std::shared_ptr<const NodeGraph> FlowSpace::velocity_graph() const {
  if (!velocity_graph_)
    velocity_graph_ = std::make_shared<const NodeGraph>(node_graph(velocity, velocity));
  return velocity_graph_;
}

FlowSpace flow_space(const TetMesh& mesh, Elements elements) {
  FlowSpace space;
  space.elements = elements;
  space.pressure = pressure_space(mesh);
  const bool is_quadratic = elements == Elements::p2_p1;
  space.velocity = {mesh.num_vertices(), is_quadratic ? 10 : 4, {}};
  space.velocity.cell_nodes.reserve(static_cast<std::size_t>(mesh.num_cells()) *
                                    static_cast<std::size_t>(space.velocity.nodes_per_cell));
  if (is_quadratic) {
    add_edge_nodes(mesh, space);
  } else {
    for (const CellVertices& cell : mesh.cells)
      for (const TetVertexId v : cell) space.velocity.cell_nodes.push_back(v.value);
  }
  return space;
}

FaceNodeTable face_nodes(const FlowSpace& space, const TetMesh& mesh, const SurfaceMesh& surface,
                         const EmbeddedSurface& embedded) {
  const bool is_quadratic = space.elements == Elements::p2_p1;
  FaceNodeTable table{is_quadratic ? 6 : 3, {}};
  table.face_nodes.reserve(static_cast<std::size_t>(surface.num_faces()) *
                           static_cast<std::size_t>(table.nodes_per_face));
  for (const FaceId f : surface.faces.ids()) {
    const CellId c = embedded.sides[f].inside;
    std::array<std::size_t, 3> local{};
    for (std::size_t k = 0; k < 3; ++k) {
      const TetVertexId v = embedded.vertex(surface.faces[f][k]);
      local[k] =
          static_cast<std::size_t>(std::ranges::find(mesh.cells[c], v) - mesh.cells[c].begin());
      table.face_nodes.push_back(node_at(v));
    }
    for (std::size_t k = 0; is_quadratic && k < 3; ++k)
      table.face_nodes.push_back(
          NodeId{space.velocity.of(c)[edge_node(local[k], local[(k + 1) % 3])]});
  }
  return table;
}

PressureSpace pressure_space(const TetMesh& mesh) {
  const RegionsAtVertices around = regions_at_vertices(mesh);
  PressureSpace space;
  space.region = around.region;
  space.vertex.reserve(around.region.size());
  for (const TetVertexId v : mesh.x.ids())
    for (auto k = around.first[static_cast<std::size_t>(v.value)];
         k < around.first[static_cast<std::size_t>(v.value) + 1]; ++k)
      space.vertex.push_back(v);
  space.nodes = {static_cast<std::int32_t>(space.region.size()), 4, {}};
  space.nodes.cell_nodes.reserve(static_cast<std::size_t>(mesh.num_cells()) * 4);
  for (const CellId c : mesh.cells.ids())
    for (const TetVertexId v : mesh.cells[c]) {
      std::int32_t node = around.first[static_cast<std::size_t>(v.value)];
      while (space.region[static_cast<std::size_t>(node)] != mesh.region[c]) ++node;
      space.nodes.cell_nodes.push_back(node);
    }
  return space;
}

}  // namespace meniscus::fem
