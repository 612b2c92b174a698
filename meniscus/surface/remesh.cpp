#include "meniscus/surface/remesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/foreseen_vertices.hpp"
#include "meniscus/surface/restore_volume.hpp"
#include "meniscus/surface/restructure.hpp"
#include "meniscus/surface/sizing.hpp"
#include "meniscus/surface/springs.hpp"

namespace meniscus {
namespace {

/// Rounds of the springs between two looks at connectivity. What is not at rest then is continued
/// by the next remesh; a remesh that changes little needs two or three.
constexpr int kRoundsPerSweep = 30;
/// In the first sweep and while edits are many the springs need only keep faces apart.
constexpr int kRoundsWhileRough = 5;
constexpr double kManyEdits = 0.03;  // of the vertices
/// Smallest angle of a face that is let through when the surface had none as small before.
constexpr double kLeastAngleDeg = 5.0;
/// Smallest angle of a face of a surface that is not remeshed.
constexpr double kLeastAngleKeptDeg = 20.0;

RemeshReference reference_surface(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                                  const RemeshOptions& options) {
  SmoothSurface surface(mesh, topology);
  const VertexField<double> lengths = rest_lengths(mesh, topology, surface, options);
  MENISCUS_ASSERT(lengths.size() == mesh.num_vertices(), "{} {}", lengths.size(),
                  mesh.num_vertices());
  const VertexField<Vec3> slopes = length_slopes(lengths, mesh, topology, surface.vertex_normals());
  VertexField<RemeshReference::Corner> corners;
  for (const VertexId v : mesh.x.ids())
    corners.add({surface.vertex_normal(v), lengths[v], slopes[v]});
  return {std::move(surface), SurfaceWalk(mesh, topology), std::move(corners)};
}

ForeseenVertices foreseen_vertices(const SurfaceMesh& mesh, const RemeshReference& reference) {
  VertexField<double> lengths;
  for (const RemeshReference::Corner& corner : reference.corners) lengths.add(corner.rest_length);
  return foresee_vertices(mesh, lengths);
}

double rest_tolerance(const RemeshState& state, const RemeshOptions& options) {
  if (options.spring_tolerance > 0.0) return options.spring_tolerance;
  // Tighter, and vertices that slide to and fro wear the shape (docs/surface-remeshing.md).
  return 0.006 * std::min(1.0, std::sqrt(1000.0 / state.mesh.num_vertices()));
}

/// Restructures and equilibrates in turn until nothing is left to restructure.
void equilibrate(RemeshState& state, const RemeshOptions& options, RemeshReport& report) {
  while (report.sweeps < options.max_sweeps) {
    ++report.sweeps;
    const int flips_before = report.flips;
    report.flips += flip_to_delaunay(state);
    const DensityEdits edits = balance_density(state);
    report.splits += edits.splits;
    report.collapses += edits.collapses;
    const int num_edits = edits.splits + edits.collapses;
    if (num_edits > 0) report.flips += flip_to_delaunay(state);
    if (report.sweeps > 1 && num_edits == 0 && report.flips == flips_before) return;
    const bool is_rough = report.sweeps == 1 || num_edits > kManyEdits * state.mesh.num_vertices();
    relax_springs(state, rest_tolerance(state, options),
                  is_rough ? kRoundsWhileRough : kRoundsPerSweep);
  }
}

/// The new surface, and where its vertices lie on the old one.
struct NewSurface {
  SurfaceMesh mesh;
  VertexField<SurfacePoint> points;
};
NewSurface new_surface(const RemeshState& state) {
  const EditMesh::CompactMesh compact = state.mesh.compact_mesh();
  MENISCUS_ASSERT(state.vertices.size() == state.mesh.num_vertex_slots(), "{} {}",
                  state.vertices.size(), state.mesh.num_vertex_slots());
  NewSurface result;
  result.mesh.faces = compact.faces;
  result.mesh.x.reserve(static_cast<std::int32_t>(compact.vertices.size()));
  for (const VertexId v : compact.vertices) {
    result.mesh.x.add(state.vertices[v].x);
    result.points.add(state.vertices[v].point);
  }
  return result;
}

/// Restores the volume and records by how much it had changed and how far vertices moved for it.
/// All move by the same fraction of their edges: a face lies below the surface by κl²/16, and κl is
/// about the same everywhere.
void correct_volume(SurfaceMesh& mesh, double volume_before, const RemeshOptions& options,
                    RemeshReport& report) {
  report.volume_change = enclosed_volume(mesh) / volume_before - 1.0;
  if (!options.restores_volume) return;
  const VertexField<double> edges = mean_edges(mesh);
  const double fraction =
      restore_volume(mesh, options.volume > 0.0 ? options.volume : volume_before, edges);
  report.volume_shift_over_edge = std::abs(fraction);
  report.volume_shift = std::abs(fraction) * *std::ranges::max_element(edges);
}

/// A face that looks inward. Edits and springs keep faces within 60° of the surface; a surface that
/// came with sharper places than that may keep them.
std::optional<Fault> find_fold(const RemeshState& state) {
  for (std::int32_t i = 0; i < state.mesh.num_halfedge_slots(); i += 3) {
    const HalfedgeId h{i};
    if (!state.mesh.is_alive(h)) continue;
    const RemeshVertex &a = state.vertices[state.mesh.from(h)],
                       &b = state.vertices[state.mesh.to(h)],
                       &c = state.vertices[state.mesh.opposite(h)];
    if ((b.x - a.x).cross(c.x - a.x).dot(a.n + b.n + c.n) <= 0.0)
      return Fault{FaultKind::folded_face, "a face is folded over", (a.x + b.x + c.x) / 3.0};
  }
  return {};
}

std::optional<Fault> find_fault(const SurfaceMesh& mesh, double angle_before,
                                const RemeshOptions& options, const RemeshReport& report) {
  if (!is_finite(mesh)) return Fault{FaultKind::not_finite, "a vertex is not finite"};
  if (auto fault = find_broken_connectivity(mesh)) return fault;
  if (report.min_angle_deg < std::min(kLeastAngleDeg, angle_before))
    return Fault{FaultKind::degenerate_face,
                 fmt::format("a face has an angle of {:.3g} degrees", report.min_angle_deg)};
  return options.find_fault ? options.find_fault(mesh) : std::nullopt;
}

std::optional<Fault> find_unfit_start(const SurfaceMesh& mesh) {
  if (!is_finite(mesh))
    return Fault{FaultKind::not_finite, "a vertex of the given surface is not finite"};
  if (const double volume = enclosed_volume(mesh); !(volume > 0.0))
    return Fault{FaultKind::no_volume,
                 fmt::format("the given surface encloses a volume of {:g}", volume)};
  return {};
}

/// Rebuilds the surface and its fields, or leaves both and says why.
std::optional<Fault> rebuild(SurfaceMesh& mesh, const RemeshOptions& options, SurfaceFields& fields,
                             RemeshReport& report) {
  if (auto fault = find_unfit_start(mesh)) return fault;
  const auto built = SurfaceTopology::try_build(mesh);
  if (const Fault* fault = std::get_if<Fault>(&built)) return *fault;
  const auto& topology = std::get<SurfaceTopology>(built);
  const RemeshReference reference = reference_surface(mesh, topology, options);
  if (const ForeseenVertices foreseen = foreseen_vertices(mesh, reference); foreseen.is_too_many())
    return Fault{FaultKind::too_large, too_many(foreseen, mesh)};
  RemeshState state = start_state(reference, mesh, topology);
  equilibrate(state, options, report);
  lift_to_surface(state);
  if (options.on_splines) lift_to_splines(state, mesh, topology);
  report.expected_vertices = expected_vertices(state);
  if (auto fault = find_fold(state)) return fault;

  auto [result, points] = new_surface(state);
  correct_volume(result, enclosed_volume(mesh), options, report);
  report.min_angle_deg = smallest_angle_deg(result);
  if (auto fault = find_fault(result, smallest_angle_deg(mesh), options, report)) return fault;
  auto [carried, excess] = transferred_fields(
      fields, {mesh, topology, reference.surface, reference.walk, result, points});
  fields = std::move(carried);
  report.field_excess = excess;
  mesh = std::move(result);
  return {};
}

}  // namespace

bool is_fit(const SurfaceMesh& mesh, const RemeshOptions& options) {
  if (find_unfit_start(mesh) || smallest_angle_deg(mesh) < kLeastAngleKeptDeg) return false;
  const auto built = SurfaceTopology::try_build(mesh);
  const auto* topology = std::get_if<SurfaceTopology>(&built);
  if (topology == nullptr) return false;
  const RemeshReference reference = reference_surface(mesh, *topology, options);
  return has_fit_density(start_state(reference, mesh, *topology), options.kept);
}

VertexField<double> mean_edges(const SurfaceMesh& mesh) {
  VertexField<double> length(mesh.num_vertices(), 0.0);
  VertexField<int> count(mesh.num_vertices(), 0);
  for (const FaceVertices& v : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) {  // every edge leaves each of its ends in one face
      length[v[k]] += (mesh.x[v[(k + 1) % 3]] - mesh.x[v[k]]).norm();
      ++count[v[k]];
    }
  for (const VertexId v : length.ids()) length[v] /= count[v];
  return length;
}

void RemeshOptions::validate() const {
  const auto require = [](bool holds, const char* field, double value, const char* range) {
    if (!holds) reject_input("remesh: {} = {:g} must be {}", field, value, range);
  };
  require(C0 > 0.0 && std::isfinite(C0), "C0", C0, "positive");
  require(volume >= 0.0 && std::isfinite(volume), "volume", volume, "zero or positive");
  require(edge_floor >= 0.0 && std::isfinite(edge_floor), "edge_floor", edge_floor,
          "zero or positive");
  require(edge_ceiling > edge_floor, "edge_ceiling", edge_ceiling, "larger than edge_floor");
  require(gradation > 0.0, "gradation", gradation, "positive");
  require(neck_edges >= 0.0 && neck_edges <= 100.0, "neck_edges", neck_edges, "between 0 and 100");
  require(gap_layers >= 0.0 && gap_layers <= 100.0, "gap_layers", gap_layers, "between 0 and 100");
  require(min_vertices >= 4, "min_vertices", min_vertices, "at least 4");
  require(max_sweeps >= 1, "max_sweeps", max_sweeps, "at least 1");
  require(spring_tolerance >= 0.0 && spring_tolerance < 1.0, "spring_tolerance", spring_tolerance,
          "in [0, 1)");
}

RemeshOptions sound_remeshing(double C0, double edge_floor) {
  RemeshOptions options;
  options.C0 = C0;
  options.edge_floor = edge_floor;
  options.find_fault = find_self_intersection;
  return options;
}

RemeshReport remesh(SurfaceMesh& mesh, const RemeshOptions& options) {
  SurfaceFields none;
  return remesh(mesh, options, none);
}

RemeshReport remesh(SurfaceMesh& mesh, const RemeshOptions& options, SurfaceFields& fields) {
  options.validate();
  RemeshReport report;
  report.fault = rebuild(mesh, options, fields, report);
  return report;
}

}  // namespace meniscus
