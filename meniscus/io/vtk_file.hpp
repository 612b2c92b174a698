#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "meniscus/mesh/polygon_soup.hpp"
#include "meniscus/mesh/tet_mesh.hpp"

namespace meniscus::io {

/// A named array on vertices or cells, `components` values each, interleaved.
struct NamedArray {
  std::string name;
  int components = 1;
  std::vector<double> values;
};

struct MeshData {
  std::vector<NamedArray> on_vertices, on_cells;
};

/// Compressed .vtp of several surfaces in one file; the arrays run over all their vertices (faces)
/// in order. Written to a temporary name and renamed. Throws RunFailure when the disk refuses.
void write_vtp(const std::filesystem::path& path, std::span<const SurfaceMesh* const> surfaces,
               const MeshData& data, double t);
/// Compressed .vtu. Cell corners are separate points when an array of `on_corners` (|C| × 4 ×
/// components, e.g. a pressure that jumps across interfaces) is given; else vertices are shared.
void write_vtu(const std::filesystem::path& path, const TetMesh& mesh, const MeshData& data,
               double t, std::span<const NamedArray> on_corners = {});

struct SurfaceFrame {
  SurfaceMesh mesh;  ///< all surfaces of the file as one
  MeshData data;
};
/// Throws InvalidInput naming the file and the fault (missing, corrupt, not all triangles).
[[nodiscard]] SurfaceFrame read_vtp(const std::filesystem::path& path);

struct PolygonFrame {
  PolygonSoup soup;                  ///< corners may name points that are not there
  std::vector<NamedArray> on_faces;  ///< cell data
};
/// As `read_vtp`, of faces with any number of corners.
[[nodiscard]] PolygonFrame read_vtp_polygons(const std::filesystem::path& path);

/// Tetrahedra as a file gives them; points that lie on each other may have numbers of their own.
struct VolumeFrame {
  std::vector<Vec3> points;
  std::vector<std::array<std::int32_t, 4>> cells;
  MeshData data;
};
/// Throws InvalidInput naming the file and the fault (missing, corrupt, not all tetrahedra).
[[nodiscard]] VolumeFrame read_vtu(const std::filesystem::path& path);

/// The time series file of ParaView: rewritten whole (temporary name, rename) after each frame.
struct PvdEntry {
  double t = 0.0;
  std::string file;  ///< relative to the .pvd
};
void write_pvd(const std::filesystem::path& path, std::span<const PvdEntry> entries);
[[nodiscard]] std::vector<PvdEntry> read_pvd(const std::filesystem::path& path);

}  // namespace meniscus::io
