#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "meniscus/core/vec.hpp"
#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus::io {

/// Triangles as a file gives them, not yet checked: corners may name points that are not there.
struct RawTriangles {
  std::vector<Vec3> points;
  std::vector<std::array<std::int64_t, 3>> corners;
  std::vector<int> tags;  ///< one per triangle, or none
};

// Each reads the bytes of a file; `path` serves the messages. Throws InvalidInput with the line.
// Own readers: VTK's keep coordinates in single precision and trust their input; CGAL's give no
// line and accept some broken files (docs/surface-remeshing.md has the comparison).
[[nodiscard]] RawTriangles parse_stl(const std::filesystem::path& path, std::string_view bytes);
[[nodiscard]] RawTriangles parse_ply(const std::filesystem::path& path, std::string_view bytes);
[[nodiscard]] RawTriangles parse_obj(const std::filesystem::path& path, std::string_view bytes);
[[nodiscard]] RawTriangles parse_off(const std::filesystem::path& path, std::string_view bytes);

// Binary STL has single precision by its definition; the others give back the same doubles.
[[nodiscard]] std::string format_stl(const SurfaceMesh& mesh);
[[nodiscard]] std::string format_ply(const SurfaceMesh& mesh);
[[nodiscard]] std::string format_obj(const SurfaceMesh& mesh);
[[nodiscard]] std::string format_off(const SurfaceMesh& mesh);

}  // namespace meniscus::io
