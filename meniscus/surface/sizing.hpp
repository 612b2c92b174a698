#pragma once

#include <functional>

#include "meniscus/surface/curvature.hpp"
#include "meniscus/surface/remesh.hpp"

namespace meniscus {

/// ρ = 2/(√3 l0²): equilateral triangles of edge l0 leave each vertex the area √3/2 l0² = 1/ρ.
[[nodiscard]] double density_of_length(double rest_length);
[[nodiscard]] double length_of_density(double density);

/// Lowers lengths until none exceeds a neighbour's by more than gradation × distance.
void limit_gradation(VertexField<double>& length, const SurfaceMesh& mesh,
                     const SurfaceTopology& topology, double gradation);

/// Rest length l0 at the vertices [R0]:
///   ρ = C0⟨κ⟩² (eq. 1), averaged once with the first ring: ½(own + mean of ring);
///   l0 = (2/(√3 ρ))^½, at most edge_ceiling and size_bound(x), at least edge_floor;
///   then lowered until l0(a) ≤ l0(b) + gradation |x_a − x_b| along every edge.
/// Before, C0 is raised to min_vertices/∮⟨κ⟩² dS where it is less, and the floor lowered to half
/// the edge that min_vertices spread evenly would have where it is more.
[[nodiscard]] VertexField<double> rest_lengths(const SurfaceMesh& mesh,
                                               const SurfaceTopology& topology,
                                               const VertexField<VertexCurvature>& curvature,
                                               const RemeshOptions& options);

}  // namespace meniscus
