#pragma once

#include <span>
#include <vector>

#include "meniscus/mesh/tet_mesh.hpp"

namespace meniscus {

struct ValueRange {
  double low = 0.0, high = 0.0;
};

/// The cells about every cell of a mesh, as far as they belong to the same group of regions.
class CellStencils {
 public:
  CellStencils(const TetMesh& mesh, const CellField<std::int32_t>& group);

  /// The cells of the group of c that share a vertex with it, in ascending order, without c.
  [[nodiscard]] std::span<const CellId> neighbours(CellId c) const;
  /// Whether a vertex of c lies on the boundary of its group.
  [[nodiscard]] bool is_at_boundary(CellId c) const { return is_at_boundary_[c]; }
  [[nodiscard]] const CellField<Vec3>& centroid() const { return centroid_; }

 private:
  CellField<Vec3> centroid_;
  CellField<char> is_at_boundary_;
  std::vector<std::size_t> first_;
  std::vector<CellId> neighbours_;
};

/// Linear functions on cells, with the cells' values as means [barth1989].
struct LinearReconstruction {
  CellField<double> mean;
  CellField<Vec3> gradient, centroid;
  /// Range of the values of a cell and its neighbours. A cell at the boundary of its group has the
  /// range of the whole group.
  CellField<ValueRange> range;

  [[nodiscard]] double value(CellId c, const Vec3& x) const {
    return mean[c] + gradient[c].dot(x - centroid[c]);
  }
};

/// Least-squares gradients, exact for linear fields, scaled so that no corner leaves the range of
/// its cell. Group values: `group_range`, one for each group.
[[nodiscard]] LinearReconstruction reconstruct(const TetMesh& mesh, const CellStencils& stencils,
                                               const CellField<double>& values,
                                               const CellField<std::int32_t>& group,
                                               std::span<const ValueRange> group_range);

}  // namespace meniscus
