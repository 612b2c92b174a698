#pragma once

#include <filesystem>

#include "meniscus/mesh/shapes.hpp"

namespace meniscus::io {

/// Reads a triangulated surface by its extension: stl, ply, obj, off, vtp. Coincident points of an
/// STL file are merged. Tags come from the cell array `patch` of a vtp file, from the groups of an
/// obj file and from the solids of an ascii STL file, in the order in which they first get a
/// triangle; else all are 0. Points that no triangle uses are left out.
/// Throws InvalidInput naming the file and the fault (missing, empty, unreadable, not triangles,
/// coordinates not finite).
[[nodiscard]] TaggedSurface read_surface(const std::filesystem::path& path);

/// Throws InvalidInput naming the file unless its extension is one that is read and written.
void require_surface_extension(const std::filesystem::path& path);

/// Writes by extension (stl, ply, obj, off, vtp). Throws RunFailure when the disk refuses.
void write_surface(const std::filesystem::path& path, const SurfaceMesh& mesh);

}  // namespace meniscus::io
