#include "meniscus/volume/moving_mesh.hpp"

#include <algorithm>
#include <utility>

#include "meniscus/core/archive_entries.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/mesh/box_tree.hpp"
#include "meniscus/mesh/field_archive.hpp"
#include "meniscus/volume/mesh_archive.hpp"
#include "meniscus/volume/quality.hpp"

namespace meniscus {
namespace {

/// A moved mesh is kept while its smallest dihedral angle is at least this fraction of what it was
/// when the mesh was made.
constexpr double kLeastAngleKept = 0.7;

/// Vertices of the outer boundary are the same in every mesh of a run. Those of interfaces that
/// were remeshed and those between the surfaces have no counterpart in a mesh made anew.
Field<TetVertexId, TetVertexId> boundary_counterparts(const TetMesh& before, const TetMesh& after) {
  Field<TetVertexId, TetVertexId> old_to_new(before.num_vertices());
  if (before.boundary.num_vertices != after.boundary.num_vertices) return old_to_new;
  for (const VertexId v : ids<VertexId>(before.boundary.num_vertices))
    old_to_new[before.boundary.vertex(v)] = after.boundary.vertex(v);
  return old_to_new;
}

std::optional<Fault> find_inverted_cell(const TetMesh& mesh) {
  for (const CellId c : mesh.cells.ids())
    if (!(signed_volume(mesh, c) > 0.0))
      return Fault{FaultKind::inverted_cell, "moving the volume mesh inverts a cell",
                   mesh.x[mesh.cells[c][0]]};
  return {};
}

/// Throws InvalidInput unless the outer boundary of a saved mesh is that of the case. Its file may
/// have been changed since.
void require_boundary_of(const SurfaceMesh& boundary, const TetMesh& mesh) {
  constexpr double kRoundOff = 1e-9;  // of the boundary's extent
  if (mesh.boundary.num_vertices != boundary.num_vertices())
    reject_input("checkpoint: the outer boundary has {} vertices, that of the case {}",
                 mesh.boundary.num_vertices, boundary.num_vertices());
  const double most = kRoundOff * bounding_box(boundary).diagonal().norm();
  for (const VertexId v : boundary.x.ids())
    if (const Vec3& x = mesh.x[mesh.boundary.vertex(v)]; !((x - boundary.x[v]).norm() <= most))
      reject_input("checkpoint: vertex {} of the outer boundary lies at {}, that of the case at {}",
                   v.value, text_of(x), text_of(boundary.x[v]));
}

}  // namespace

MovingMesh::MovingMesh(const MovingMeshOptions& options)
    : MovingMesh(
          options.motion,
          [tetrahedra = options.tetrahedra](const Scene& scene, const TetMesh& before,
                                            TetMesh& mesh) {
            return tetrahedralize(scene, tetrahedra, before, mesh);
          },
          options.takes_over_vertices) {}

void MovingMesh::begin_step(const Scene& scene) {
  const PhaseTimer timer(times_, "move mesh");
  place_interfaces(scene);
  start_ = mesh_;
  start_made_angle_deg_ = made_angle_deg_;
  mover_.forget_positions();
  start_fields_ = fields_;
  excess_ = {};
}

Report MovingMesh::move(const Scene& start, std::span<const VertexField<Vec3>> interface_velocity,
                        const Field<TetVertexId, Vec3>& liquid_velocity, double dt) {
  const PhaseTimer timer(times_, "move mesh");
  MENISCUS_ASSERT(start_.num_vertices() == mesh_.num_vertices(), "a step that was not begun");
  Field<TetVertexId, Vec3> velocity =
      mover_.velocity(start, start_, interface_velocity, liquid_velocity);
  MENISCUS_ASSERT(velocity.size() == start_.num_vertices(), "{} {}", velocity.size(),
                  start_.num_vertices());
  TetMesh moved = start_;
  for (const TetVertexId v : moved.x.ids()) moved.x[v] += dt * velocity[v];
  if (auto fault = find_inverted_cell(moved)) return {std::move(fault)};
  mesh_ = std::move(moved);
  angle_deg_.reset();
  velocity_ = std::move(velocity);
  if (fields_.empty()) return {};
  fields_ = start_fields_;
  excess_ = {};
  move_fields(fields_, start_, mesh_, excess_);
  return {};
}

double MovingMesh::smallest_angle_deg() const {
  if (!angle_deg_) angle_deg_ = smallest_dihedral_deg(mesh_);
  return *angle_deg_;
}

bool MovingMesh::is_fit() const {
  const PhaseTimer timer(times_, "move mesh");
  return smallest_angle_deg() >= kLeastAngleKept * made_angle_deg_;
}

void MovingMesh::undo() {
  const PhaseTimer timer(times_, "move mesh");
  mesh_ = start_;
  made_angle_deg_ = start_made_angle_deg_;
  angle_deg_.reset();
  fields_ = start_fields_;
  excess_ = {};
}

void MovingMesh::set_fields(VolumeFields fields) {
  check_fields(fields, mesh_);
  fields_ = std::move(fields);
}

void MovingMesh::place_interfaces(const Scene& scene) {
  MENISCUS_ASSERT(mesh_.interfaces.size() == scene.interfaces.size(), "{} {}",
                  mesh_.interfaces.size(), scene.interfaces.size());
  for (std::size_t i = 0; i < mesh_.interfaces.size(); ++i) {
    const SurfaceMesh& surface = scene.interfaces[i].mesh;
    MENISCUS_ASSERT(mesh_.interfaces[i].num_vertices == surface.num_vertices(), "{} {}",
                    mesh_.interfaces[i].num_vertices, surface.num_vertices());
    for (const VertexId v : surface.x.ids()) {
      Vec3& x = mesh_.x[mesh_.interfaces[i].vertex(v)];
      if (x != surface.x[v]) angle_deg_.reset();
      x = surface.x[v];
    }
  }
}

/// Takes over vertices of the mesh as it stands where that is wanted, unless cells without them are
/// much better.
MovingMesh::NewMesh MovingMesh::mesh_anew(const Scene& scene) const {
  const auto made = [&](const TetMesh& before) {
    NewMesh result;
    result.report = mesher_(scene, before, result.mesh);
    if (result.report.ok()) result.angle_deg = smallest_dihedral_deg(result.mesh);
    return result;
  };
  if (!takes_over_vertices_ || mesh_.num_vertices() == 0) return made({});
  NewMesh result = made(mesh_);
  if (!result.report.ok() || result.angle_deg >= kLeastAngleKept * made_angle_deg_) return result;
  NewMesh from_none = made({});
  return from_none.angle_deg > result.angle_deg ? std::move(from_none) : std::move(result);
}

MeshChange MovingMesh::follow(const Scene& scene, const RegionSources& sources) {
  const PhaseTimer timer(times_, "tetrahedralize");
  auto [report, fitted, angle_deg] = mesh_anew(scene);
  MeshChange change{std::move(report)};
  if (!change.ok()) return change;
  change.old_to_new = boundary_counterparts(mesh_, fitted);
  MENISCUS_ASSERT(change.old_to_new.size() == mesh_.num_vertices(), "{} {}",
                  change.old_to_new.size(), mesh_.num_vertices());
  if (!fields_.empty()) fields_ = transfer_fields(fields_, mesh_, fitted, excess_, sources);
  change.before = std::exchange(mesh_, std::move(fitted));
  change.sources = sources;
  made_angle_deg_ = angle_deg;
  angle_deg_ = angle_deg;
  velocity_ = {};
  mover_.forget_mesh();
  return change;
}

void MovingMesh::save(Archive& archive) const {
  meniscus::save(mesh_, archive, "mesh");
  archive.reals["mesh/made-angle"] = {made_angle_deg_};
  meniscus::save(fields_, archive, "mesh/fields");
}

void MovingMesh::load(const Archive& archive, const Scene& scene) {
  mesh_ = load_mesh(archive, "mesh");
  angle_deg_.reset();
  velocity_ = {};
  mover_.forget_mesh();
  if (mesh_.interfaces.size() != scene.interfaces.size())
    reject_input("checkpoint: the volume mesh has {} interfaces, the scene {}",
                 mesh_.interfaces.size(), scene.interfaces.size());
  for (std::size_t i = 0; i < mesh_.interfaces.size(); ++i)
    if (mesh_.interfaces[i].num_vertices != scene.interfaces[i].mesh.num_vertices())
      reject_input("checkpoint: interface {} has {} vertices in the volume mesh, {} in the scene",
                   i, mesh_.interfaces[i].num_vertices, scene.interfaces[i].mesh.num_vertices());
  require_boundary_of(scene.boundary.mesh, mesh_);
  fields_ = load_fields(archive, "mesh/fields", mesh_);
  made_angle_deg_ = archive.reals.contains("mesh/made-angle")
                        ? entry_of_size(archive.reals, "mesh/made-angle", 1).front()
                        : smallest_dihedral_deg(mesh_);
  start_ = mesh_;
  start_made_angle_deg_ = made_angle_deg_;
  start_fields_ = fields_;
}

}  // namespace meniscus
