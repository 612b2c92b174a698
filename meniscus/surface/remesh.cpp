#include "meniscus/surface/remesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/foreseen_vertices.hpp"
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

RemeshReference reference_surface(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                                  const RemeshOptions& options) {
  SmoothSurface surface(mesh, topology);
  const VertexField<double> lengths = rest_lengths(mesh, topology, surface, options);
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
  if (options.equilibrium > 0.0) return options.equilibrium;
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
struct Assembled {
  SurfaceMesh mesh;
  VertexField<SurfaceLocation> places;
};
Assembled assembled(const RemeshState& state) {
  const EditMesh::Compacted compacted = state.mesh.compacted();
  Assembled result;
  result.mesh.faces = compacted.faces;
  result.mesh.x.reserve(static_cast<std::int32_t>(compacted.vertices.size()));
  for (const VertexId v : compacted.vertices) {
    result.mesh.x.add(state.vertices[v].x);
    result.places.add(state.vertices[v].place);
  }
  return result;
}

/// Mean length of the edges at each vertex.
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

/// Restores the volume and records by how much it had changed and how far vertices moved for it:
/// all by the same fraction of their edges, as a face lies below the surface by κl²/16 and κl is
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

/// Whether a face looks inward. Edits and springs keep faces within 60° of the surface; a surface
/// that came with sharper places than that may keep them.
bool has_fold(const RemeshState& state) {
  for (std::int32_t i = 0; i < state.mesh.num_halfedge_slots(); i += 3) {
    const HalfedgeId h{i};
    if (!state.mesh.is_alive(h)) continue;
    const RemeshVertex &a = state.vertices[state.mesh.from(h)],
                       &b = state.vertices[state.mesh.to(h)],
                       &c = state.vertices[state.mesh.opposite(h)];
    if ((b.x - a.x).cross(c.x - a.x).dot(a.n + b.n + c.n) <= 0.0) return true;
  }
  return false;
}

std::string find_fault(const SurfaceMesh& mesh, double angle_before, const RemeshOptions& options,
                       const RemeshReport& report) {
  if (!is_finite(mesh)) return "a vertex is not finite";
  static_cast<void>(SurfaceTopology(mesh));  // throws unless closed, manifold and oriented
  if (report.min_angle_deg < std::min(kLeastAngleDeg, angle_before))
    return fmt::format("a face has an angle of {:.3g} degrees", report.min_angle_deg);
  return options.find_fault ? options.find_fault(mesh) : std::string();
}

}  // namespace

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
  require(gap_layers >= 0.0 && gap_layers <= 100.0, "gap_layers", gap_layers, "between 0 and 100");
  require(min_vertices >= 4, "min_vertices", min_vertices, "at least 4");
  require(max_sweeps >= 1, "max_sweeps", max_sweeps, "at least 1");
  require(equilibrium >= 0.0 && equilibrium < 1.0, "equilibrium", equilibrium, "in [0, 1)");
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
  const auto fail = [&](std::string why) {
    report.ok = false;
    report.failure = std::move(why);
    return report;
  };
  if (!is_finite(mesh)) return fail("a vertex of the given surface is not finite");
  const double volume = enclosed_volume(mesh);
  if (!(volume > 0.0))
    return fail(fmt::format("the given surface encloses a volume of {:g}", volume));

  try {
    const SurfaceTopology topology(mesh);
    const RemeshReference reference = reference_surface(mesh, topology, options);
    if (const ForeseenVertices foreseen = foreseen_vertices(mesh, reference);
        foreseen.is_too_many())
      return fail(too_many(foreseen, mesh));
    RemeshState state = start_state(reference, mesh, topology);
    equilibrate(state, options, report);
    lift_to_surface(state);
    report.expected_vertices = expected_vertices(state);
    if (has_fold(state)) return fail("a face is folded over");

    auto [result, places] = assembled(state);
    correct_volume(result, volume, options, report);
    report.min_angle_deg = smallest_angle_deg(result);
    std::string fault = find_fault(result, smallest_angle_deg(mesh), options, report);
    if (!fault.empty()) return fail(std::move(fault));
    auto [carried, excess] =
        transferred(fields, {mesh, topology, reference.surface, reference.walk, result, places});
    fields = std::move(carried);
    report.field_excess = excess;
    mesh = std::move(result);
  } catch (const InvalidInput& invalid) {  // from the topology check, before or after
    return fail(invalid.what());
  }
  return report;
}

}  // namespace meniscus
