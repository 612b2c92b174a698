#pragma once

#include <optional>
#include <span>
#include <vector>

#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus {

/// The faces across the three edges of each face of a closed surface.
using FaceNeighbours = FaceField<std::array<FaceId, 3>>;
[[nodiscard]] FaceNeighbours face_neighbours(const SurfaceMesh& mesh,
                                             const SurfaceTopology& topology);

/// A part of a surface: is_in[f] for each of its faces.
using FacePatch = FaceField<char>;

/// The curves that bound a patch, each with the patch on its left; none when two of them touch.
[[nodiscard]] std::optional<std::vector<std::vector<VertexId>>> boundary_curves(
    const SurfaceMesh& mesh, const FacePatch& patch);

/// Whether a connected patch with that many boundary curves is a part of a plane: V − E + F = 2 −
/// n.
[[nodiscard]] bool is_planar(const SurfaceMesh& mesh, const FacePatch& patch,
                             std::size_t num_boundaries);

/// Makes a connected patch a disc. Faces are added around vertices where its boundary touches
/// itself. Then all parts of the rest of its piece of the surface but the largest (by area) are
/// added. False when that leaves no disc, as on a patch that goes around a handle.
[[nodiscard]] bool make_disc(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                             const FaceNeighbours& neighbours, FacePatch& patch);

/// Makes a patch around a thread a ring with two boundary curves, as `make_disc` makes discs. The
/// two largest parts of the rest stay; on a torus they are one. False when that leaves no ring, as
/// at the end of a point.
[[nodiscard]] bool make_ring(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                             const FaceNeighbours& neighbours, FacePatch& patch);

/// The surface without the faces of a patch; its vertices keep their ids.
[[nodiscard]] SurfaceMesh remaining_surface(const SurfaceMesh& mesh, const FacePatch& patch);

}  // namespace meniscus
