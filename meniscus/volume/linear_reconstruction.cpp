#include "meniscus/volume/linear_reconstruction.hpp"

#include <algorithm>

#include <Eigen/QR>

#include "meniscus/core/error.hpp"
#include "meniscus/volume/cells_around.hpp"
#include "meniscus/volume/facets.hpp"

namespace meniscus {
namespace {

/// Vertices of facets that have another group, or nothing, on their other side.
Field<TetVertexId, char> boundary_vertices(const TetMesh& mesh,
                                           const CellField<std::int32_t>& group) {
  const FacetTable facets(mesh);
  Field<TetVertexId, char> marked(mesh.num_vertices(), 0);
  for (const CellId c : mesh.cells.ids())
    for (std::size_t k = 0; k < 4; ++k) {
      const CellId other = facets.neighbours(c)[k];
      if (other.is_valid() && group[other] == group[c]) continue;
      for (const TetVertexId v : facet(mesh.cells[c], k)) marked[v] = 1;
    }
  return marked;
}

/// g minimising Σ_j w_j (g·d_j − u_j + u_c)², w_j = 1/|d_j|². Directions without neighbours get no
/// slope.
Vec3 least_squares_gradient(CellId c, const CellStencils& stencils,
                            const CellField<double>& values) {
  Mat3 matrix = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  for (const CellId j : stencils.neighbours(c)) {
    const Vec3 d = stencils.centroid()[j] - stencils.centroid()[c];
    MENISCUS_ASSERT(d.squaredNorm() > 0.0, "cells {} and {} have one centroid", c.value, j.value);
    const double weight = 1.0 / d.squaredNorm();
    matrix += weight * d * d.transpose();
    right += weight * (values[j] - values[c]) * d;
  }
  return matrix.completeOrthogonalDecomposition().solve(right);
}

/// The largest factor ≤ 1 that keeps mean + factor · slope in the range.
double limiter(double mean, double slope, const ValueRange& range) {
  if (mean + slope > range.high) return (range.high - mean) / slope;
  if (mean + slope < range.low) return (range.low - mean) / slope;
  return 1.0;
}

}  // namespace

CellStencils::CellStencils(const TetMesh& mesh, const CellField<std::int32_t>& group)
    : is_at_boundary_(mesh.num_cells(), 0) {
  MENISCUS_ASSERT(group.size() == mesh.num_cells(), "{} {}", group.size(), mesh.num_cells());
  const CellsAround cells(mesh.num_vertices(), mesh.cells);
  const Field<TetVertexId, char> at_boundary = boundary_vertices(mesh, group);
  first_.push_back(0);
  std::vector<CellId> around;
  for (const CellId c : mesh.cells.ids()) {
    const CellVertices& corners = mesh.cells[c];
    around.clear();
    Vec3 sum = Vec3::Zero();
    for (const TetVertexId v : corners) {
      sum += mesh.x[v];
      if (at_boundary[v]) is_at_boundary_[c] = 1;
      for (const CellId j : cells.of(v))
        if (j != c && group[j] == group[c]) around.push_back(j);
    }
    centroid_.add(0.25 * sum);
    std::ranges::sort(around);
    around.erase(std::ranges::unique(around).begin(), around.end());
    neighbours_.insert(neighbours_.end(), around.begin(), around.end());
    first_.push_back(neighbours_.size());
  }
}

std::span<const CellId> CellStencils::neighbours(CellId c) const {
  const auto k = static_cast<std::size_t>(c.value);
  return std::span(neighbours_).subspan(first_[k], first_[k + 1] - first_[k]);
}

LinearReconstruction reconstruct(const TetMesh& mesh, const CellStencils& stencils,
                                 const CellField<double>& values,
                                 const CellField<std::int32_t>& group,
                                 std::span<const ValueRange> group_range) {
  LinearReconstruction linear{values, {}, stencils.centroid(), {}};
  for (const CellId c : mesh.cells.ids()) {
    ValueRange range{values[c], values[c]};
    MENISCUS_ASSERT(static_cast<std::size_t>(group[c]) < group_range.size(), "group {} of {}",
                    group[c], group_range.size());
    for (const CellId j : stencils.neighbours(c)) {
      range.low = std::min(range.low, values[j]);
      range.high = std::max(range.high, values[j]);
    }
    if (stencils.is_at_boundary(c)) range = group_range[static_cast<std::size_t>(group[c])];
    const Vec3 gradient = least_squares_gradient(c, stencils, values);
    double factor = 1.0;
    for (const TetVertexId v : mesh.cells[c])
      factor = std::min(
          factor, limiter(values[c], gradient.dot(mesh.x[v] - stencils.centroid()[c]), range));
    linear.gradient.add(factor * gradient);
    linear.range.add(range);
  }
  return linear;
}

}  // namespace meniscus
