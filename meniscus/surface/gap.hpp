#pragma once

#include <span>

#include "meniscus/mesh/surface_tree.hpp"

namespace meniscus {

/// Edges per layer: a gap of width w is asked to have edges of kGapEdge · w/layers, on its surfaces
/// and in the volume between them (docs/surface-remeshing.md: why it is below 1).
inline constexpr double kGapEdge = 0.8;

/// Width of the liquid between a vertex and the next sheet of its own surface, along the normal: on
/// the inside a neck or a film, on the outside the gap between two lobes [R0]. Infinite where no
/// sheet is met within the vertex's reach.
struct OwnGaps {
  VertexField<double> inside, outside;
};
[[nodiscard]] OwnGaps own_gaps(const SurfaceMesh& mesh, const SurfaceTree& tree,
                               const VertexField<Vec3>& normals, const VertexField<double>& reach);

/// Lowers rest lengths where another sheet is near:
///   l0 ≤ kGapEdge w/layers,
/// w the smaller of the vertex's own gaps and its distance to the neighbours [R0].
void bound_by_gaps(VertexField<double>& length, const SurfaceMesh& mesh,
                   const VertexField<Vec3>& normals, double layers,
                   std::span<const SurfaceTree* const> neighbours);

}  // namespace meniscus
