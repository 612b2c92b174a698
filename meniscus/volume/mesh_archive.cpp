#include "meniscus/volume/mesh_archive.hpp"

#include "meniscus/core/archive_entries.hpp"

namespace meniscus {
namespace {

using Integers = std::vector<std::int64_t>;

/// first vertex, number of vertices, then inside and outside cell of each face.
Integers flat(const EmbeddedSurface& surface) {
  Integers values = {surface.first_vertex.value, surface.num_vertices};
  for (const EmbeddedSurface::Sides& sides : surface.sides)
    values.insert(values.end(), {sides.inside.value, sides.outside.value});
  return values;
}

std::int32_t index(std::int64_t value, std::int64_t first, std::int64_t end) {
  if (value < first || value >= end)
    reject_input("checkpoint: mesh index {} is not in [{}, {})", value, first, end);
  return static_cast<std::int32_t>(value);
}

EmbeddedSurface surface(const Integers& values, const TetMesh& mesh) {
  if (values.size() < 2) reject_input("checkpoint: a surface of the volume mesh is incomplete");
  EmbeddedSurface result;
  result.first_vertex.value = index(values[0], 0, mesh.num_vertices() + 1);
  result.num_vertices = index(values[1], 0, mesh.num_vertices() - values[0] + 1);
  for (std::size_t i = 2; i < values.size(); i += 2)
    result.sides.add({CellId{index(values[i], 0, mesh.num_cells())},
                      CellId{index(values[i + 1], -1, mesh.num_cells())}});
  return result;
}

std::string interface_name(const std::string& prefix, std::size_t i) {
  return prefix + "/interface-" + std::to_string(i);
}

}  // namespace

void save(const TetMesh& mesh, Archive& archive, const std::string& prefix) {
  archive.reals[prefix + "/x"] = flat(mesh.x);
  Integers cells, regions;
  for (const CellId c : mesh.cells.ids()) {
    for (const TetVertexId v : mesh.cells[c]) cells.push_back(v.value);
    regions.push_back(mesh.region[c].value);
  }
  archive.integers[prefix + "/cells"] = std::move(cells);
  archive.integers[prefix + "/regions"] = std::move(regions);
  archive.integers[prefix + "/boundary"] = flat(mesh.boundary);
  for (std::size_t i = 0; i < mesh.interfaces.size(); ++i)
    archive.integers[interface_name(prefix, i)] = flat(mesh.interfaces[i]);
}

TetMesh load_mesh(const Archive& archive, const std::string& prefix) {
  TetMesh mesh;
  mesh.x = vectors<TetVertexId>(entry_of_rows(archive.reals, prefix + "/x", 3));
  const Integers& cells = entry_of_rows(archive.integers, prefix + "/cells", 4);
  const Integers& regions = entry_of_rows(archive.integers, prefix + "/regions", 1);
  if (cells.size() != 4 * regions.size())
    reject_input("checkpoint: {} cells but {} regions", cells.size() / 4, regions.size());
  const auto vertex = [&](std::size_t k) {
    return TetVertexId{index(cells[k], 0, mesh.num_vertices())};
  };
  for (std::size_t c = 0; c < regions.size(); ++c) {
    mesh.cells.add({vertex(4 * c), vertex(4 * c + 1), vertex(4 * c + 2), vertex(4 * c + 3)});
    mesh.region.add(RegionId{index(regions[c], 0, 1 << 30)});
  }
  mesh.boundary = surface(entry_of_rows(archive.integers, prefix + "/boundary", 2), mesh);
  for (std::size_t i = 0; archive.integers.contains(interface_name(prefix, i)); ++i)
    mesh.interfaces.push_back(
        surface(entry_of_rows(archive.integers, interface_name(prefix, i), 2), mesh));
  return mesh;
}

}  // namespace meniscus
