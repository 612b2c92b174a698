#pragma once

#include "meniscus/surface/curvature.hpp"

namespace meniscus {

/// Normals and curvatures at the vertices by a quartic: with z along the osculating fit's normal
/// and H its half-sum of curvatures, the function
///
///   g(u, v) = z + ½H (u² + v² + z²)
///
/// vanishes on the sphere of curvature H that touches the vertex. A polynomial of degree four
/// without constant is fitted to it at two rings (least squares, weights 1/distance²). Exact on
/// spheres of any coarseness; κ to O(h³) elsewhere, O(h⁴) where the rings are symmetric. The
/// interface engine's fits have O(h²), whose error would outweigh all others of this solver. Where
/// two rings do not determine the quartic, or it bends more sharply than a circle through the
/// closest neighbour could, the osculating fit stands.
[[nodiscard]] VertexField<VertexCurvature> quartic_curvature(
    const SurfaceMesh& mesh, const SurfaceTopology& topology,
    const VertexField<VertexCurvature>& osculating);

}  // namespace meniscus
