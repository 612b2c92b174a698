#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "meniscus/mesh/polygon_soup.hpp"
#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus::io {

// Each reads the bytes of a file; `path` serves the messages. Every face has three corners or more,
// which may name points that are not there. Throws InvalidInput with the line.
// Own readers: VTK's keep coordinates in single precision and trust their input; CGAL's give no
// line and accept some broken files (docs/surface-remeshing.md has the comparison).
[[nodiscard]] PolygonSoup parse_stl(const std::filesystem::path& path, std::string_view bytes);
[[nodiscard]] PolygonSoup parse_ply(const std::filesystem::path& path, std::string_view bytes);
[[nodiscard]] PolygonSoup parse_obj(const std::filesystem::path& path, std::string_view bytes);
[[nodiscard]] PolygonSoup parse_off(const std::filesystem::path& path, std::string_view bytes);

// Binary STL has single precision by its definition; the others give back the same doubles.
/// Throws InvalidInput naming the file where single precision is too coarse for the surface.
[[nodiscard]] std::string format_stl(const std::filesystem::path& path, const SurfaceMesh& mesh);
[[nodiscard]] std::string format_ply(const SurfaceMesh& mesh);
[[nodiscard]] std::string format_obj(const SurfaceMesh& mesh);
[[nodiscard]] std::string format_off(const SurfaceMesh& mesh);

}  // namespace meniscus::io
