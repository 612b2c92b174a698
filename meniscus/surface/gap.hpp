#pragma once

#include <span>

#include "meniscus/mesh/surface_tree.hpp"

namespace meniscus {

/// Edges per layer: a gap of width w is asked to have edges of kGapEdge · w/layers, on its surfaces
/// and in the volume between them. docs/surface-remeshing.md says why it is below 1.
inline constexpr double kGapEdge = 0.8;

/// Width of the liquid between a vertex and the next sheet of its own surface, along the normal. It
/// is on the inside a neck or a film, on the outside the gap between two lobes [R0]. Infinite where
/// no sheet is met within the vertex's reach.
struct OwnGaps {
  VertexField<double> inside, outside;
};
[[nodiscard]] OwnGaps own_gaps(const SurfaceMesh& mesh, const SurfaceTree& tree,
                               const VertexField<Vec3>& normals, const VertexField<double>& reach);

/// Lowers rest lengths where another sheet is near:
///   l0 ≤ kGapEdge w/layers,              w the width of one of the vertex's own gaps,
///   l0 ≤ max(kGapEdge d/layers, ½ l_d),  d the distance to a neighbour, l_d the mean edge of the
///                                        face nearest there [R0].
/// A neighbour that is not remeshed itself, such as a wall, thus sets the layers there can be.
void bound_by_gaps(VertexField<double>& length, const SurfaceMesh& mesh,
                   const VertexField<Vec3>& normals, double layers,
                   std::span<const SurfaceTree* const> neighbours);

}  // namespace meniscus
