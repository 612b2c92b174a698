#pragma once

#include <functional>

#include "meniscus/surface/remesh.hpp"
#include "meniscus/surface/smooth_surface.hpp"

namespace meniscus {

/// ρ = 2/(√3 l0²): equilateral triangles of edge l0 leave each vertex the area √3/2 l0² = 1/ρ.
[[nodiscard]] double density_of_length(double rest_length);
[[nodiscard]] double length_of_density(double density);

/// Lowers lengths until none exceeds a neighbour's by more than gradation × distance.
void limit_gradation(VertexField<double>& length, const SurfaceMesh& mesh,
                     const SurfaceTopology& topology, double gradation);

/// Gradient of a length along the surface at the vertices: least squares over the ring, weighted by
/// 1/distance², in the plane normal to `normals`.
[[nodiscard]] VertexField<Vec3> length_slopes(const VertexField<double>& length,
                                              const SurfaceMesh& mesh,
                                              const SurfaceTopology& topology,
                                              const VertexField<Vec3>& normals);

/// Rest length l0 at the vertices [R0]:
///   ρ = C0⟨κ⟩² (eq. 1), ⟨κ⟩² = ½(k1² + k2²) = 2H² − K averaged over the vertex's cell (the faces
///   around it), from the turn of the smooth surface's normals over the faces;
///   l0 = (2/(√3 ρ))^½, at most edge_ceiling and size_bound(x), on necks about 2π r/neck_edges or
///   less and then of slope kNeckGradation or less, at least edge_floor;
///   then lowered until l0(a) ≤ l0(b) + gradation |x_a − x_b| along every edge.
/// Before, C0 is raised to min_vertices/∮⟨κ⟩² dS where it is less. The floor is lowered to half the
/// edge that min_vertices spread evenly would have, where it is more.
[[nodiscard]] VertexField<double> rest_lengths(const SurfaceMesh& mesh,
                                               const SurfaceTopology& topology,
                                               const SmoothSurface& surface,
                                               const RemeshOptions& options);

}  // namespace meniscus
