#pragma once

#include <span>

#include "meniscus/flow/fem/spaces.hpp"
#include "meniscus/scene/scene.hpp"
#include "meniscus/surface/known_surfaces.hpp"

namespace meniscus::fem {

/// Where the nodes of a space are at one instant.
struct NodePositions {
  Field<NodeId, Vec3> x;      ///< [R0]
  CellField<char> is_curved;  ///< whether a mid-edge node of the cell is off its edge's middle
  int num_flattened = 0;      ///< edges of surfaces that are less curved: cells would fold
};

/// Mid-edge nodes in the middle of straight edges.
[[nodiscard]] NodePositions straight_positions(const TetMesh& mesh, const FlowSpace& space);

/// Moves the mid-edge nodes of a surface to the points given, in the order of its edges. No effect
/// on P1.
void curve_edges(const SurfaceMesh& surface, const SurfaceTopology& topology,
                 const FaceNodeTable& nodes, std::span<const Vec3> middles,
                 NodePositions& positions);

/// Marks the curved cells and keeps their maps from folding. The Jacobian determinant at the
/// quadrature points and at the nodes must stay above a tenth of the straight cell's. Where it does
/// not, edges inside the regions are bent beside the curved ones; where that does not do, edges
/// of surfaces are flattened, by a tenth each time. `surfaces`: the nodes of all interfaces and
/// walls, whose straight edges stay so.
void settle_curved_cells(const TetMesh& mesh, const FlowSpace& space,
                         std::span<const FaceNodeTable> surfaces, NodePositions& positions);

/// The positions of all nodes for a scene. Edges of interfaces are curved through the middles that
/// belong to the interface, edges of the outer boundary as its patches say. Others are straight but
/// for those that `settle_curved_cells` bends. The interfaces' surfaces are taken from those known,
/// if such are given.
[[nodiscard]] NodePositions node_positions(const Scene& scene, const TetMesh& mesh,
                                           const FlowSpace& space,
                                           KnownSurfaces* surfaces = nullptr);

}  // namespace meniscus::fem
