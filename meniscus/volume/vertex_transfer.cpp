#include "meniscus/volume/vertex_transfer.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/LU>

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

/// Gradients at the vertices of one group after another: means of those of the cells of the group
/// at a vertex, by volume.
class GroupGradients {
 public:
  explicit GroupGradients(const GroupedMesh& mesh)
      : mesh_(mesh), sum_(mesh.mesh.num_vertices()), volume_(mesh.mesh.num_vertices()) {}

  void take(std::size_t group, const Field<TetVertexId, double>& values) {
    const std::vector<CellId>& cells = mesh_.cells[group];
    for (const CellId c : cells)
      for (const TetVertexId v : mesh_.mesh.cells[c]) {
        sum_[v] = Vec3::Zero();
        volume_[v] = 0.0;
      }
    for (const CellId c : cells) {
      const Vec3 part = mesh_.volume[c] * cell_gradient(c, values);
      for (const TetVertexId v : mesh_.mesh.cells[c]) {
        sum_[v] += part;
        volume_[v] += mesh_.volume[c];
      }
    }
  }
  [[nodiscard]] Vec3 at(TetVertexId v) const { return sum_[v] / volume_[v]; }

 private:
  [[nodiscard]] Vec3 cell_gradient(CellId c, const Field<TetVertexId, double>& values) const {
    const CellVertices& cell = mesh_.mesh.cells[c];
    const TetCorners x = corners(mesh_.mesh, c);
    Mat3 edges;
    Vec3 rise;
    for (int k = 0; k < 3; ++k) {
      const auto corner = static_cast<std::size_t>(k) + 1;
      edges.row(k) = x[corner] - x[0];
      rise[k] = values[cell[corner]] - values[cell[0]];
    }
    return edges.inverse() * rise;
  }

  const GroupedMesh& mesh_;
  Field<TetVertexId, Vec3> sum_;
  Field<TetVertexId, double> volume_;
};

/// Σ w_k (u_k + ½ ∇u_k · (x − x_k)), kept between the least and the greatest u_k. The linear
/// interpolation is too high by half of what a quadratic function's Taylor sums are too low.
double interpolate(const TetMesh& mesh, const CellTree::Hit& hit,
                   const Field<TetVertexId, double>& values, const GroupGradients& gradients) {
  double sum = 0.0, low = HUGE_VAL, high = -HUGE_VAL;
  for (std::size_t k = 0; k < 4; ++k) {
    const TetVertexId v = mesh.cells[hit.cell][k];
    const double slope = 0.5 * gradients.at(v).dot(hit.at.point - mesh.x[v]);
    sum += hit.at.weights[k] * (values[v] + slope);
    low = std::min(low, values[v]);
    high = std::max(high, values[v]);
  }
  return std::clamp(sum, low, high);
}

}  // namespace

Field<TetVertexId, CellTree::Hit> locate_vertices(const MeshOverlay& overlay) {
  const TetMesh& mesh = overlay.after.mesh;
  Field<TetVertexId, std::vector<std::int32_t>> touched(mesh.num_vertices());
  for (const CellId c : mesh.cells.ids())
    for (const TetVertexId v : mesh.cells[c])
      if (std::ranges::find(touched[v], overlay.after.group[c]) == touched[v].end())
        touched[v].push_back(overlay.after.group[c]);
  Field<TetVertexId, CellTree::Hit> hits;
  for (const TetVertexId v : mesh.x.ids()) {
    MENISCUS_ASSERT(!touched[v].empty(), "vertex {} has no cell", v.value);
    std::ranges::sort(touched[v]);
    std::optional<CellTree::Hit> best;
    for (const std::int32_t g : touched[v]) {
      const CellTree::Hit hit = overlay.before.tree(g).closest(mesh.x[v]);
      if (!best || hit.squared_distance < best->squared_distance) best = hit;
    }
    hits.add(*best);
  }
  return hits;
}

Field<TetVertexId, double> interpolated_at_vertices(const MeshOverlay& overlay,
                                                    const Field<TetVertexId, CellTree::Hit>& hits,
                                                    const Field<TetVertexId, double>& values) {
  const auto num_groups = static_cast<std::size_t>(overlay.groups.num_groups);
  std::vector<std::vector<TetVertexId>> vertices(num_groups);
  for (const TetVertexId v : hits.ids())
    vertices[static_cast<std::size_t>(overlay.before.group[hits[v].cell])].push_back(v);
  Field<TetVertexId, double> result(hits.size());
  GroupGradients gradients(overlay.before);
  for (std::size_t g = 0; g < num_groups; ++g) {
    gradients.take(g, values);
    for (const TetVertexId v : vertices[g])
      result[v] = interpolate(overlay.before.mesh, hits[v], values, gradients);
  }
  return result;
}

}  // namespace meniscus
