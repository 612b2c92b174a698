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

/// Edges that are parabolas: each through its two vertices and a point over its middle. Faces and
/// cells with such an edge are quadratic cells of VTK, which have nodes over their edges' middles.
struct CurvedEdges {
  std::vector<std::array<std::int32_t, 2>> ends;  ///< vertices, each edge once, in any order
  std::vector<Vec3> middles;                      ///< [R0]
  /// Values at the middles. Arrays on vertices (and corners) of other names have the mean of the
  /// ends' values there, and so have the middles of straight edges.
  std::vector<NamedArray> values;
};

/// Compressed .vtp of several surfaces in one file; the arrays run over all their vertices (faces)
/// in order. Written to a temporary name and renamed. Throws RunFailure when the disk refuses.
void write_vtp(const std::filesystem::path& path, std::span<const SurfaceMesh* const> surfaces,
               const MeshData& data, double t);
/// Likewise a .vtu, of surfaces with curved edges: VTK's PolyData knows no quadratic cells. Points
/// are the vertices, then the middles; `curved` counts the vertices of all surfaces in order.
void write_surface_vtu(const std::filesystem::path& path,
                       std::span<const SurfaceMesh* const> surfaces, const MeshData& data, double t,
                       const CurvedEdges& curved);
/// Compressed .vtu. `on_corners` has arrays of |C| × 4 × components, such as a pressure that jumps
/// across interfaces. Points are the vertices, and each once more for every further set of values
/// that corners there have. The middles of cells with a curved edge come after all of these.
void write_vtu(const std::filesystem::path& path, const TetMesh& mesh, const MeshData& data,
               double t, std::span<const NamedArray> on_corners = {},
               const CurvedEdges& curved = {});

struct SurfaceFrame {
  SurfaceMesh mesh;  ///< all surfaces of the file as one
  MeshData data;     ///< on its vertices and faces
  /// The points over the middles of the edges 01, 12, 20 of every face; empty where all are flat.
  FaceField<std::array<Vec3, 3>> middles = {};
};
/// Reads what `write_vtp` or `write_surface_vtu` writes, by extension. Values at middles are left
/// out. Throws InvalidInput naming the file and the fault (missing, corrupt, not all triangles).
[[nodiscard]] SurfaceFrame read_surface_frame(const std::filesystem::path& path);

struct PolygonFrame {
  PolygonSoup soup;                  ///< corners may name points that are not there
  std::vector<NamedArray> on_faces;  ///< cell data
};
/// The faces of a .vtp or of a .vtu, of any number of corners; quadratic ones by their corners.
/// Throws as `read_surface_frame`.
[[nodiscard]] PolygonFrame read_vtp_polygons(const std::filesystem::path& path);
[[nodiscard]] PolygonFrame read_vtu_polygons(const std::filesystem::path& path);

/// Tetrahedra as a file gives them; points that lie on each other may have numbers of their own.
struct VolumeFrame {
  std::vector<Vec3> points;
  std::vector<std::array<std::int32_t, 4>> cells;
  MeshData data;
  /// The points over the middles of the edges 01, 12, 20, 03, 13, 23 of every cell, −1 where it is
  /// flat. It is empty where all are.
  std::vector<std::array<std::int32_t, 6>> middles = {};
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
