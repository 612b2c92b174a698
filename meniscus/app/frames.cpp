#include "meniscus/app/frames.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include <fmt/ranges.h>

#include "meniscus/app/scalar_arrays.hpp"
#include "meniscus/core/archive_entries.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/node_positions.hpp"
#include "meniscus/io/vtk_file.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/scene/interface_tension.hpp"
#include "meniscus/surface/curvature.hpp"
#include "meniscus/surface/edge_middles.hpp"
#include "meniscus/surface/quartic_curvature.hpp"
#include "meniscus/volume/quality.hpp"

namespace meniscus {
namespace {

using Names = std::vector<std::string>;

// Names of the arrays that frames always may hold; scalars and carried fields must differ.
constexpr std::array kSurfaceArrays{"curvature",    "normal_velocity", "velocity",
                                    "node_density", "pressure_jump",   "drop"};
constexpr std::array kVolumeArrays{"velocity", "pressure", "region", "drop", "min_dihedral_deg"};

Names operator+(Names names, std::span<const char* const> more) {
  names.insert(names.end(), more.begin(), more.end());
  return names;
}

void check_name(const char* what, const std::string& name, const Names& taken) {
  if (std::ranges::find(taken, name) != taken.end())
    reject_input("{} \"{}\": frames have an array of this name; others are {}", what, name,
                 fmt::join(taken, ", "));
}

template <class IdType>
void check_names(const std::vector<CarriedField<IdType>>& fields, const Names& taken) {
  for (const CarriedField<IdType>& field : fields) check_name("field", field.name, taken);
}

void append(std::vector<double>& values, const Vec3& v) {
  values.insert(values.end(), {v.x(), v.y(), v.z()});
}

/// The pressure at the corner of cell c that lies at vertex v.
double corner_value(const TetMesh& mesh, std::span<const double> on_corners, CellId c,
                    TetVertexId v) {
  const CellVertices& cell = mesh.cells[c];
  const auto corner = static_cast<std::size_t>(std::ranges::find(cell, v) - cell.begin());
  MENISCUS_ASSERT(corner < cell.size(), "vertex {} is none of cell {}", v.value, c.value);
  return on_corners[4 * static_cast<std::size_t>(c.value) + corner];
}

/// One array per field name: the values of all surfaces, one surface after the other.
template <class IdType>
void append_fields(const std::vector<CarriedField<IdType>>& fields,
                   std::vector<io::NamedArray>& arrays) {
  for (const CarriedField<IdType>& field : fields) {
    auto found = std::ranges::find(arrays, field.name, &io::NamedArray::name);
    if (found == arrays.end()) found = arrays.insert(arrays.end(), {field.name, 1, {}});
    found->values.insert(found->values.end(), field.values.begin(), field.values.end());
  }
}

/// p_out − p_in at the vertices of all interfaces; empty where the flow has no pressure.
std::vector<double> pressure_jump(const Evolution& evolution) {
  std::vector<double> jump;
  if (!evolution.state().mesh || !evolution.flow().bulk) return jump;
  const TetMesh* mesh = &evolution.state().mesh->tetrahedra();
  const std::span<const double> p = evolution.flow().bulk->corner_pressure;
  for (std::size_t i = 0; i < mesh->interfaces.size(); ++i) {
    const EmbeddedSurface& surface = mesh->interfaces[i];
    const SurfaceMesh& triangles = evolution.scene().interfaces[i].mesh;
    const std::size_t first = jump.size();
    jump.resize(first + static_cast<std::size_t>(triangles.num_vertices()));
    for (const FaceId f : triangles.faces.ids()) {
      const auto [inside, outside] = surface.sides[f];
      for (const VertexId v : triangles.faces[f]) {
        // Each side of an interface has one pressure per vertex: any face there gives it.
        const TetVertexId at = surface.vertex(v);
        jump[first + static_cast<std::size_t>(v.value)] =
            corner_value(*mesh, p, outside, at) - corner_value(*mesh, p, inside, at);
      }
    }
  }
  return jump;
}

}  // namespace

void check_field_names(const Evolution& evolution) {
  Names scalars;
  for (const Scalar& scalar : evolution.scene().scalars) {
    check_name("scalar", scalar.name, Names{kSurfactantField} + kSurfaceArrays + kVolumeArrays);
    scalars.push_back(scalar.name);
  }
  const Names on_surfaces = scalars + kSurfaceArrays, in_volume = scalars + kVolumeArrays;
  for (const Interface& interface : evolution.scene().interfaces) {
    check_names(interface.fields.on_vertices, on_surfaces);
    check_names(interface.fields.on_faces, on_surfaces);
  }
  if (!evolution.state().mesh) return;
  check_names(evolution.state().mesh->fields().on_vertices, in_volume);
  check_names(evolution.state().mesh->fields().on_cells, in_volume);
}

io::MeshData surface_arrays(const Evolution& evolution) {
  const Scene& scene = evolution.scene();
  const auto& velocity = evolution.flow().velocity;
  MENISCUS_ASSERT(velocity.empty() || velocity.size() == scene.interfaces.size(),
                  "{} velocities of {} interfaces", velocity.size(), scene.interfaces.size());
  io::NamedArray curvature{"curvature", 1, {}}, normal_velocity{"normal_velocity", 1, {}},
      velocities{"velocity", 3, {}}, density{"node_density", 1, {}}, drop{"drop", 1, {}};
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
    const SurfaceMesh& mesh = scene.interfaces[i].mesh;
    const SurfaceTopology topology(mesh);
    const VertexField<VertexCurvature> fit =
        quartic_curvature(mesh, topology, osculating_curvature(mesh, topology));
    const VertexField<double> area = vertex_areas(mesh);
    for (const VertexId v : mesh.x.ids()) {
      const Vec3 u = velocity.empty() ? Vec3(Vec3::Zero()) : velocity[i][v];
      curvature.values.push_back(fit[v].sum());
      normal_velocity.values.push_back(fit[v].n.dot(u));
      append(velocities.values, u);
      density.values.push_back(1.0 / area[v]);
    }
    drop.values.insert(drop.values.end(), static_cast<std::size_t>(mesh.num_faces()),
                       scene.interfaces[i].drop);
  }
  io::MeshData data;
  for (const Interface& interface : scene.interfaces) {
    append_fields(interface.fields.on_vertices, data.on_vertices);
    append_fields(interface.fields.on_faces, data.on_cells);
  }
  data.on_vertices.insert(data.on_vertices.begin(),
                          {curvature, normal_velocity, velocities, density});
  data.on_cells.insert(data.on_cells.begin(), drop);
  const io::NamedArray jump{"pressure_jump", 1, pressure_jump(evolution)};
  if (!jump.values.empty()) data.on_vertices.push_back(jump);
  if (evolution.state().mesh)
    std::ranges::move(scalars_on_interfaces(scene, evolution.state().mesh->tetrahedra(),
                                            evolution.state().scalars),
                      std::back_inserter(data.on_vertices));
  return data;
}

namespace {

/// The edges of all curved interfaces, with the liquid's velocity at their middles where the solver
/// has one.
io::CurvedEdges curved_edges(const Evolution& evolution) {
  const std::vector<MiddleNodes>& nodes = evolution.flow().middles;
  io::NamedArray velocity{"velocity", 3, {}};
  io::CurvedEdges curved;
  std::int32_t first = 0;
  for (std::size_t i = 0; i < evolution.scene().interfaces.size(); ++i) {
    const SurfaceMesh& mesh = evolution.scene().interfaces[i].mesh;
    const SurfaceTopology topology(mesh);
    for (const SurfaceEdge& edge : topology.edges()) {
      curved.ends.push_back({first + edge.a.value, first + edge.b.value});
      if (nodes.empty()) continue;
      const FaceVertices& face = mesh.faces[edge.left];
      const auto k = static_cast<std::size_t>(std::ranges::find(face, edge.a) - face.begin());
      MENISCUS_ASSERT(k < face.size(), "an edge is not of its face");
      append(velocity.values, nodes[i].v[edge.left][k]);
    }
    std::ranges::move(
        edge_middles(mesh, topology, SmoothSurface(mesh, topology), evolution.surface_shape()),
        std::back_inserter(curved.middles));
    first += mesh.num_vertices();
  }
  if (!velocity.values.empty()) curved.values.push_back(std::move(velocity));
  return curved;
}

/// The edges of the volume mesh that quadratic elements have curved.
io::CurvedEdges curved_edges_in_volume(const Evolution& evolution) {
  if (evolution.surface_shape() != SurfaceShape::splined) return {};
  const TetMesh& mesh = evolution.state().mesh->tetrahedra();
  const fem::FlowSpace space = fem::flow_space(mesh, fem::Elements::p2_p1);
  const Field<fem::NodeId, Vec3> x =
      fem::node_positions(evolution.scene(), mesh, space, evolution.state().surfaces.get()).x;
  const BulkFlow flow = evolution.flow().bulk.value_or(BulkFlow());
  MENISCUS_ASSERT(flow.v_at_edges.empty() || flow.v_at_edges.size() == space.edges.size(),
                  "{} velocities of {} edges", flow.v_at_edges.size(), space.edges.size());
  io::NamedArray velocity{"velocity", 3, {}};
  io::CurvedEdges curved;
  for (std::size_t e = 0; e < space.edges.size(); ++e) {
    const auto [a, b] = space.edges[e];
    const Vec3& middle = x[fem::NodeId{space.num_vertices() + static_cast<std::int32_t>(e)}];
    if (middle == 0.5 * (mesh.x[a] + mesh.x[b])) continue;
    curved.ends.push_back({a.value, b.value});
    curved.middles.push_back(middle);
    if (!flow.v_at_edges.empty()) append(velocity.values, flow.v_at_edges[e]);
  }
  if (!velocity.values.empty()) curved.values.push_back(std::move(velocity));
  return curved;
}

}  // namespace

std::filesystem::path write_surface_frame(const std::filesystem::path& path,
                                          const Evolution& evolution) {
  std::vector<const SurfaceMesh*> surfaces;
  for (const Interface& interface : evolution.scene().interfaces)
    surfaces.push_back(&interface.mesh);
  const io::MeshData data = surface_arrays(evolution);
  std::filesystem::path file = path;
  if (evolution.surface_shape() == SurfaceShape::faceted) {
    file += ".vtp";
    io::write_vtp(file, surfaces, data, evolution.t());
  } else {
    file += ".vtu";
    io::write_surface_vtu(file, surfaces, data, evolution.t(), curved_edges(evolution));
  }
  return file;
}

VolumeArrays volume_arrays(const Evolution& evolution) {
  MENISCUS_ASSERT(evolution.state().mesh.has_value(), "there is no volume mesh");
  const TetMesh& mesh = evolution.state().mesh->tetrahedra();
  io::NamedArray velocity{"velocity", 3, {}}, region{"region", 1, {}}, drop{"drop", 1, {}},
      dihedral{"min_dihedral_deg", 1, {}};
  const BulkFlow flow = evolution.flow().bulk.value_or(BulkFlow());
  velocity.values = flat(flow.v);
  MENISCUS_ASSERT(flow.v.empty() || flow.v.size() == mesh.num_vertices(),
                  "{} velocities of {} vertices", flow.v.size(), mesh.num_vertices());
  const auto& interfaces = evolution.scene().interfaces;
  for (const RegionId r : mesh.region) {
    region.values.push_back(r.value);
    drop.values.push_back(r.value == 0 ? -1
                                       : interfaces[static_cast<std::size_t>(r.value) - 1].drop);
  }
  for (const double angle : min_dihedral_deg(mesh)) dihedral.values.push_back(angle);
  ScalarArrays scalars = scalars_in_volume(evolution.scene(), mesh, evolution.state().scalars);
  io::MeshData data{{}, {region, drop, dihedral}};
  if (!velocity.values.empty()) data.on_vertices.push_back(velocity);
  append_fields(evolution.state().mesh->fields().on_vertices, data.on_vertices);
  append_fields(evolution.state().mesh->fields().on_cells, data.on_cells);
  std::ranges::move(scalars.on_vertices, std::back_inserter(data.on_vertices));
  std::vector<io::NamedArray> corners;
  if (!flow.corner_pressure.empty()) corners.push_back({"pressure", 1, flow.corner_pressure});
  std::ranges::move(scalars.on_corners, std::back_inserter(corners));
  return {std::move(data), std::move(corners)};
}

void write_volume_frame(const std::filesystem::path& path, const Evolution& evolution) {
  const VolumeArrays arrays = volume_arrays(evolution);
  io::write_vtu(path, evolution.state().mesh->tetrahedra(), arrays.data, evolution.t(),
                arrays.on_corners, curved_edges_in_volume(evolution));
}

}  // namespace meniscus
