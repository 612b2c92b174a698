#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "meniscus/mesh/tet_mesh.hpp"
#include "meniscus/volume/tet_overlap.hpp"

namespace meniscus {

[[nodiscard]] TetCorners corners(const TetMesh& mesh, CellId c);

/// A tree of boxes over some cells of a mesh, which must outlive it (Boost.Geometry's R-tree,
/// packed). Built in O(n log n).
class CellTree {
 public:
  CellTree(const TetMesh& mesh, const std::vector<CellId>& cells);
  ~CellTree();

  /// The cells whose boxes touch the box of a tetrahedron, in ascending order.
  [[nodiscard]] std::vector<CellId> near(const TetCorners& tet) const;
  /// The cell with the point nearest to p; among equally near ones, one with a corner at p.
  struct Hit {
    CellId cell;
    TetPoint at;
    double squared_distance = 0.0;
  };
  [[nodiscard]] Hit closest(const Vec3& p) const;

 private:
  [[nodiscard]] std::optional<Hit> containing(const Vec3& p) const;

  struct Index;
  const TetMesh& mesh_;
  std::unique_ptr<Index> index_;
};

}  // namespace meniscus
