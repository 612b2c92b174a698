#pragma once

#include <span>
#include <vector>

#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus {

/// The connected pieces of a surface, each with its vertices and faces in the order they had;
/// pieces in the order of their first faces. Vertices without a face are left out. Linear.
[[nodiscard]] std::vector<SurfaceMesh> connected_pieces(const SurfaceMesh& mesh);

/// The piece of each face, by its number in `connected_pieces`. Linear.
[[nodiscard]] FaceField<std::int32_t> face_pieces(const SurfaceMesh& mesh);

/// The pieces as one surface: vertices and faces of one after those of the other.
[[nodiscard]] SurfaceMesh joined_surface(std::span<const SurfaceMesh> pieces);

/// V − E + F of a closed surface: the sum over its pieces of 2 less twice the number of handles.
[[nodiscard]] int euler_characteristic(const SurfaceMesh& mesh);

/// Turns every face over, so that what was inside is outside.
void turn_inside_out(SurfaceMesh& mesh);

}  // namespace meniscus
