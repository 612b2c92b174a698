#include "tests/volume/gap_layers.hpp"

#include <algorithm>
#include <limits>

#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/gap.hpp"

namespace meniscus {
namespace {

constexpr double kFacing = -0.8;  // cosine of 143°
constexpr int kMostLayers = 20;   // counting ends there

/// Neighbours of each vertex along the edges of the cells.
class EdgeGraph {
 public:
  explicit EdgeGraph(const TetMesh& mesh)
      : first_(static_cast<std::size_t>(mesh.num_vertices()) + 1) {
    for (const CellVertices& v : mesh.cells)
      for (const TetVertexId a : v) first_[static_cast<std::size_t>(a.value) + 1] += 3;
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    to_.resize(static_cast<std::size_t>(first_.back()));
    std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
    for (const CellVertices& v : mesh.cells)
      for (const TetVertexId a : v)
        for (const TetVertexId b : v)
          if (a != b) to_[static_cast<std::size_t>(next[static_cast<std::size_t>(a.value)]++)] = b;
  }
  /// Once for each cell at the edge.
  [[nodiscard]] std::span<const TetVertexId> neighbours(TetVertexId v) const {
    const auto i = static_cast<std::size_t>(v.value);
    return {to_.data() + first_[i], to_.data() + first_[i + 1]};
  }

 private:
  std::vector<std::int32_t> first_;
  std::vector<TetVertexId> to_;
};

/// What each vertex of the mesh lies on.
struct Surroundings {
  explicit Surroundings(const TetMesh& mesh, const Scene& scene)
      : graph(mesh),
        surface(mesh.num_vertices(), -1),
        normal(mesh.num_vertices(), Vec3::Zero()),
        seen_from(mesh.num_vertices()) {
    for (std::size_t i = 0; i < mesh.interfaces.size(); ++i)
      mark(mesh.interfaces[i], scene.interfaces[i].mesh, static_cast<int>(i));
    mark(mesh.boundary, scene.boundary.mesh, static_cast<int>(mesh.interfaces.size()));
  }
  void mark(const EmbeddedSurface& embedded, const SurfaceMesh& mesh, int number) {
    const VertexField<Vec3> areas = vertex_area_vectors(mesh);
    for (const VertexId v : mesh.x.ids()) {
      surface[embedded.vertex(v)] = number;
      normal[embedded.vertex(v)] = areas[v].normalized();
    }
  }
  EdgeGraph graph;
  Field<TetVertexId, int> surface;  // −1: none
  Field<TetVertexId, Vec3> normal;
  Field<TetVertexId, TetVertexId> seen_from;
};

/// Edges from v to the surface opposite.
int layers_before(TetVertexId v, Surroundings& around) {
  std::vector<TetVertexId> front{v}, next;
  around.seen_from[v] = v;
  for (int layers = 1; layers < kMostLayers && !front.empty(); ++layers) {
    next.clear();
    for (const TetVertexId a : front)
      for (const TetVertexId b : around.graph.neighbours(a)) {
        if (around.seen_from[b] == v) continue;
        around.seen_from[b] = v;
        if (around.surface[b] < 0) {
          next.push_back(b);
          continue;
        }
        if (around.surface[b] != around.surface[v] ||
            around.normal[b].dot(around.normal[v]) < kFacing)
          return layers;
      }
    std::swap(front, next);
  }
  return kMostLayers;
}

/// The narrower of the gaps at each vertex of an interface; infinite beyond `widest`.
VertexField<double> gap_widths(const Scene& scene, std::size_t i, double widest,
                               std::span<const SurfaceTree> trees) {
  const SurfaceMesh& mesh = scene.interfaces[i].mesh;
  VertexField<Vec3> normals = vertex_area_vectors(mesh);
  for (Vec3& n : normals) n.normalize();
  const OwnGaps own =
      own_gaps(mesh, trees[i], normals, VertexField<double>(mesh.num_vertices(), widest));
  VertexField<double> widths(mesh.num_vertices());
  for (const VertexId v : mesh.x.ids()) {
    widths[v] = std::min(own.inside[v], own.outside[v]);
    for (std::size_t j = 0; j < trees.size(); ++j)
      if (j != i) widths[v] = std::min(widths[v], trees[j].closest(mesh.x[v], widest).distance);
  }
  return widths;
}

}  // namespace

GapLayers gap_layers(const TetMesh& mesh, const Scene& scene, double widest) {
  std::vector<SurfaceTree> trees;
  for (const Interface& interface : scene.interfaces) trees.emplace_back(interface.mesh);
  trees.emplace_back(scene.boundary.mesh);
  Surroundings around(mesh, scene);
  GapLayers result{.fewest = kMostLayers, .narrowest = std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
    const VertexField<double> widths = gap_widths(scene, i, widest, trees);
    for (const VertexId v : widths.ids()) {
      if (!(widths[v] <= widest)) continue;
      const int layers = layers_before(mesh.interfaces[i].vertex(v), around);
      result.fewest = std::min(result.fewest, layers);
      result.mean += layers;
      result.narrowest = std::min(result.narrowest, widths[v]);
      ++result.num_vertices;
    }
  }
  if (result.num_vertices == 0) return {};
  result.mean /= result.num_vertices;
  return result;
}

}  // namespace meniscus
