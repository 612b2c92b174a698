#pragma once

#include <filesystem>

#include "meniscus/mesh/polygon_soup.hpp"
#include "meniscus/mesh/surface_repair.hpp"

namespace meniscus::io {

/// Reads the faces of a surface by the file's extension: stl, ply, obj, off, vtp, vtu. A point of
/// an STL file within 1e-6 of its extent of an earlier one becomes that one. Faces that lose a side
/// by it are dropped.
/// Curved faces are read by their corners. Tags come from the cell array `patch` of a vtp or vtu
/// file. In an obj file groups, in an ascii STL file solids give them, in the order in which they
/// first get a face. Else all are 0. Throws InvalidInput naming the file and the fault (missing,
/// empty, unreadable, faces of fewer than three corners, corners without a point, coordinates not
/// finite).
[[nodiscard]] PolygonSoup read_polygons(const std::filesystem::path& path);

/// The surface of a file's faces: triangulated, oriented and, if wished, mended (`surface_of`).
/// Throws as `read_polygons`.
[[nodiscard]] RepairedSurface read_surface(const std::filesystem::path& path, bool mends = false);

/// Throws InvalidInput naming the file unless its extension is one that `write_surface` knows.
void require_surface_extension(const std::filesystem::path& path);

/// Writes by extension (stl, ply, obj, off, vtp). Throws RunFailure when the disk refuses.
void write_surface(const std::filesystem::path& path, const SurfaceMesh& mesh);

}  // namespace meniscus::io
