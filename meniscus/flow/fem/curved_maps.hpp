#pragma once

#include <array>
#include <span>
#include <vector>

#include "meniscus/flow/fem/node_positions.hpp"
#include "meniscus/geometry/quadrature.hpp"

namespace meniscus::fem {

/// A point of the curved rule in a quadratic tetrahedron.
struct CurvedMap {
  double weight = 0.0;             ///< [R0³]
  std::array<Vec3, 3> gradient{};  ///< of the barycentric coordinates but the first [1/R0]
};
using CurvedMaps = std::array<CurvedMap, kTetrahedronRule5.size()>;

/// Those of quadratic cells whose nodes are at x.
[[nodiscard]] std::vector<CurvedMaps> curved_maps(const Field<NodeId, Vec3>& x,
                                                  const NodeTable& nodes,
                                                  std::span<const CellId> cells);

/// The maps of all curved cells of a mesh.
class MapsOfCurvedCells {
 public:
  MapsOfCurvedCells(const FlowSpace& space, const NodePositions& positions);
  /// Those of a curved cell.
  [[nodiscard]] const CurvedMaps& of(CellId c) const {
    return maps_[static_cast<std::size_t>(place_[c])];
  }

 private:
  CellField<std::int32_t> place_;
  std::vector<CurvedMaps> maps_;
};

/// Smallest determinant of ∂x/∂ξ at the points of the curved rule and at the nodes of each of some
/// quadratic cells. It is six times the volume where a cell is straight.
[[nodiscard]] std::vector<double> least_jacobians(const Field<NodeId, Vec3>& x,
                                                  const NodeTable& nodes,
                                                  std::span<const CellId> cells);

}  // namespace meniscus::fem
