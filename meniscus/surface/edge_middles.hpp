#pragma once

#include <array>
#include <vector>

#include "meniscus/surface/smooth_surface.hpp"

namespace meniscus {

/// The surface that an interface's vertices stand for. Its volume is kept and its area stores
/// energy. Its faces are flat, or parabolic through points over the middles of their edges. These
/// lie on the cubic patches of SmoothSurface (for boundary integrals) or on splines (for quadratic
/// elements).
enum class SurfaceShape { faceted, patched, splined };

/// The edges 01, 12, 20 of every face by their numbers in the topology.
[[nodiscard]] FaceField<std::array<std::size_t, 3>> face_edges(const SurfaceMesh& mesh,
                                                               const SurfaceTopology& topology);

/// The point of the interface's surface over the middle of every edge, in the order of the
/// topology. `smooth` is that of the mesh.
[[nodiscard]] std::vector<Vec3> edge_middles(const SurfaceMesh& mesh,
                                             const SurfaceTopology& topology,
                                             const SmoothSurface& smooth, SurfaceShape shape);

/// The middles on the patches of SmoothSurface: O(h⁴).
[[nodiscard]] std::vector<Vec3> middles_on_patches(const SmoothSurface& smooth,
                                                   const SurfaceTopology& topology);

/// The middles on splines (`SplinePatch`) through the vertices in the two rings of both ends, along
/// the normal through the smooth surface's edge point. Their error, about O(h⁶), is a tenth of that
/// of the cubic patches of SmoothSurface at 200 vertices. The patches' O(h⁴) repeats from edge to
/// edge, and a flow takes it for a corrugation. It pulls the vertices in and the middles out, 1.6 %
/// too slow a relaxation at 110 vertices. The smooth surface's point stands where the spline is not
/// to be trusted, or swings far from the edge. About 15 µs per edge, where the patches take 2.
[[nodiscard]] std::vector<Vec3> middles_on_splines(const SurfaceMesh& mesh,
                                                   const SurfaceTopology& topology);
[[nodiscard]] std::vector<Vec3> middles_on_splines(const SurfaceMesh& mesh,
                                                   const SurfaceTopology& topology,
                                                   const SmoothSurface& smooth,
                                                   const ShareNumbers& share = own_numbers);

}  // namespace meniscus
