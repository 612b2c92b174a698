#include "meniscus/flow/fem/mesh_archive.hpp"

#include "meniscus/core/error.hpp"

namespace meniscus::fem {
namespace {

using Reals = std::vector<double>;
using Integers = std::vector<std::int64_t>;

template <class Map>
const typename Map::mapped_type& array(const Map& arrays, const std::string& name,
                                       std::size_t multiple) {
  const auto found = arrays.find(name);
  if (found == arrays.end()) reject_input("checkpoint: {} is missing", name);
  if (found->second.size() % multiple != 0)
    reject_input("checkpoint: {} has {} entries, not a multiple of {}", name, found->second.size(),
                 multiple);
  return found->second;
}

template <class IdType>
Reals flat(const Field<IdType, Vec3>& field) {
  Reals values;
  for (const Vec3& x : field) values.insert(values.end(), {x[0], x[1], x[2]});
  return values;
}

template <class IdType>
Field<IdType, Vec3> vectors(const Reals& values) {
  Field<IdType, Vec3> field;
  for (std::size_t i = 0; i < values.size(); i += 3)
    field.add(Vec3(values[i], values[i + 1], values[i + 2]));
  return field;
}

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
  mesh.x = vectors<TetVertexId>(array(archive.reals, prefix + "/x", 3));
  const Integers& cells = array(archive.integers, prefix + "/cells", 4);
  const Integers& regions = array(archive.integers, prefix + "/regions", 1);
  if (cells.size() != 4 * regions.size())
    reject_input("checkpoint: {} cells but {} regions", cells.size() / 4, regions.size());
  const auto vertex = [&](std::size_t k) {
    return TetVertexId{index(cells[k], 0, mesh.num_vertices())};
  };
  for (std::size_t c = 0; c < regions.size(); ++c) {
    mesh.cells.add({vertex(4 * c), vertex(4 * c + 1), vertex(4 * c + 2), vertex(4 * c + 3)});
    mesh.region.add(RegionId{index(regions[c], 0, 1 << 30)});
  }
  mesh.boundary = surface(array(archive.integers, prefix + "/boundary", 2), mesh);
  for (std::size_t i = 0; archive.integers.contains(interface_name(prefix, i)); ++i)
    mesh.interfaces.push_back(surface(array(archive.integers, interface_name(prefix, i), 2), mesh));
  return mesh;
}

void save_positions(const NodePositions& positions, Archive& archive, const std::string& prefix) {
  archive.reals[prefix + "/x"] = flat(positions.x);
  archive.integers[prefix + "/is-curved"] =
      Integers(positions.is_curved.begin(), positions.is_curved.end());
}

NodePositions load_positions(const Archive& archive, const std::string& prefix) {
  NodePositions positions;
  positions.x = vectors<NodeId>(array(archive.reals, prefix + "/x", 3));
  for (const std::int64_t is_curved : array(archive.integers, prefix + "/is-curved", 1))
    positions.is_curved.add(is_curved != 0);
  return positions;
}

void save(const StokesState& state, Archive& archive, const std::string& prefix) {
  archive.reals[prefix + "/velocity"] = flat(state.v);
  archive.reals[prefix + "/pressure"] = state.p;
}

StokesState load_state(const Archive& archive, const std::string& prefix) {
  return {vectors<NodeId>(array(archive.reals, prefix + "/velocity", 3)),
          array(archive.reals, prefix + "/pressure", 1)};
}

}  // namespace meniscus::fem
