#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "meniscus/app/commands.hpp"
#include "meniscus/app/output_file.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/io/surface_file.hpp"
#include "meniscus/mesh/surface_distance.hpp"
#include "meniscus/mesh/surface_quality.hpp"
#include "meniscus/solids/remesh_target.hpp"
#include "meniscus/solids/solid_check.hpp"

namespace meniscus {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

fs::path output_file(const RemeshArguments& arguments) {
  if (!arguments.output.empty()) return arguments.output;
  const fs::path surface = arguments.surface;
  const std::string extension = surface.extension().string();
  if (extension != ".vtu") io::require_surface_extension(surface);
  return surface.parent_path() /
         (surface.stem().string() + "-remeshed" + (extension == ".vtu" ? ".vtp" : extension));
}

void require_free(const fs::path& file, bool is_overwrite) {
  io::require_surface_extension(file);
  require_writable(file);
  if (fs::exists(file) && !is_overwrite)
    reject_input("{} exists already; give --overwrite to replace it", file.string());
}

RemeshTarget target_of(const RemeshArguments& arguments, int num_vertices) {
  RemeshTarget target{
      .by = RemeshTarget::By::nodes,
      .value = static_cast<double>(std::max(num_vertices, RemeshTarget::kFewestNodes)),
      .edge_floor = arguments.edge_floor,
      .gradation = arguments.gradation};
  if (arguments.nodes) target.value = *arguments.nodes;
  if (arguments.edge_length) {
    target.by = RemeshTarget::By::edge_length;
    target.value = *arguments.edge_length;
  }
  if (arguments.chordal_error) {
    target.by = RemeshTarget::By::chordal_error;
    target.value = *arguments.chordal_error;
  }
  target.validate();
  return target;
}

RepairedSurface read_solid(const RemeshArguments& arguments) {
  RepairedSurface solid = io::read_surface(arguments.surface, arguments.is_repair);
  if (const auto fault = find_solid_defect(solid.mesh))
    reject_input("{}: {}", arguments.surface, text_of(*fault, solid.report));
  return solid;
}

/// Calls `remesh_to`; adds the name of the file to its InvalidInput.
TargetReport remesh_file(const std::string& file, SurfaceMesh& mesh, const RemeshTarget& target) {
  try {
    return remesh_to(mesh, target);
  } catch (const InvalidInput& refused) {
    reject_input("{}: {}", file, refused.what());
  }
}

const char* name(RemeshTarget::By by) {
  switch (by) {
    case RemeshTarget::By::nodes:
      return "vertices";
    case RemeshTarget::By::edge_length:
      return "mean edge";
    case RemeshTarget::By::chordal_error:
      return "chordal error";
  }
  return "";
}

/// What the command prints about one remeshing.
struct Outcome {
  RepairReport repair;
  RemeshTarget target;
  SurfaceQuality before, after;
  SampledDistance distance;
  TargetReport report;
  fs::path file;
};

constexpr auto kCount = "{:.0f}", kLength = "{:.5g}", kAngle = "{:.1f}", kRatio = "{:.3f}";

struct Row {
  const char* name;  // as printed
  const char* key;   // in JSON
  double (*value)(const SurfaceQuality&);
  const char* format;
};

constexpr Row kRows[] = {
    {"vertices", "vertices", [](const SurfaceQuality& q) { return double(q.num_vertices); },
     kCount},
    {"triangles", "triangles", [](const SurfaceQuality& q) { return double(q.num_faces); }, kCount},
    {"pieces", "pieces", [](const SurfaceQuality& q) { return double(q.num_pieces); }, kCount},
    {"genus", "genus", [](const SurfaceQuality& q) { return double(q.genus); }, kCount},
    {"volume", "volume", [](const SurfaceQuality& q) { return q.volume; }, "{:.10g}"},
    {"area", "area", [](const SurfaceQuality& q) { return q.area; }, "{:.8g}"},
    {"shortest edge", "min_edge", [](const SurfaceQuality& q) { return q.min_edge; }, kLength},
    {"mean edge", "mean_edge", [](const SurfaceQuality& q) { return q.mean_edge; }, kLength},
    {"longest edge", "max_edge", [](const SurfaceQuality& q) { return q.max_edge; }, kLength},
    {"smallest angle", "min_angle_deg", [](const SurfaceQuality& q) { return q.min_angle_deg; },
     kAngle},
    {"5 % of angles below", "low_angle_deg",
     [](const SurfaceQuality& q) { return q.low_angle_deg; }, kAngle},
    {"mean smallest angle", "mean_min_angle_deg",
     [](const SurfaceQuality& q) { return q.mean_min_angle_deg; }, kAngle},
    {"largest angle", "max_angle_deg", [](const SurfaceQuality& q) { return q.max_angle_deg; },
     kAngle},
    {"smallest radius ratio", "min_radius_ratio",
     [](const SurfaceQuality& q) { return q.min_radius_ratio; }, kRatio},
    {"mean radius ratio", "mean_radius_ratio",
     [](const SurfaceQuality& q) { return q.mean_radius_ratio; }, kRatio},
    {"smallest valence", "min_valence",
     [](const SurfaceQuality& q) { return double(q.min_valence); }, kCount},
    {"largest valence", "max_valence",
     [](const SurfaceQuality& q) { return double(q.max_valence); }, kCount},
    {"share of valence 6", "share_of_valence_6",
     [](const SurfaceQuality& q) { return q.share_of_valence_6; }, kRatio},
};

void print_table(const Outcome& outcome) {
  if (outcome.repair.is_changed()) fmt::print("repaired: {}\n\n", text_of(outcome.repair));
  fmt::print("{:<22} {:>16} {:>16}\n", "", "before", "after");
  for (const Row& row : kRows) {
    const double before = row.value(outcome.before), after = row.value(outcome.after);
    fmt::print("{:<22} {:>16} {:>16}\n", row.name, fmt::format(fmt::runtime(row.format), before),
               fmt::format(fmt::runtime(row.format), after));
  }
  fmt::print("\n{}: asked {:.6g}, reached {:.6g} (remeshed {} times){}\n", name(outcome.target.by),
             outcome.target.value, outcome.report.reached, outcome.report.passes,
             outcome.report.is_met ? "" : ": the surface allows no better");
  const SampledDistance& d = outcome.distance;
  fmt::print(
      "Hausdorff distance {:.4g}, in error by less than {:.2g}; largest at ({:.5g}, {:.5g}, "
      "{:.5g})\n",
      d.distance, d.error, d.from.x(), d.from.y(), d.from.z());
  fmt::print("volume changed by {:.2g} %, area by {:.2g} %\n",
             100.0 * (outcome.after.volume / outcome.before.volume - 1.0),
             100.0 * (outcome.after.area / outcome.before.area - 1.0));
  if (outcome.report.are_creases_rounded)
    fmt::print("creases or slivers were found: edges and corners are rounded\n");
  if (outcome.report.are_creases_kept)
    fmt::print(
        "no smooth surface fits triangles of that size: faces are cut evenly, edges and corners "
        "kept\n");
  fmt::print("wrote {}\n", outcome.file.string());
}

Json json_number(const Row& row, const SurfaceQuality& quality) {
  const double value = row.value(quality);
  if (row.format == kCount) return static_cast<int>(value);
  return value;
}

void print_json(const Outcome& outcome) {
  Json before, after;
  for (const Row& row : kRows) {
    before[row.key] = json_number(row, outcome.before);
    after[row.key] = json_number(row, outcome.after);
  }
  const RepairReport& repair = outcome.repair;
  const Json json = {{"polygons_cut", repair.polygons},
                     {"faces_turned", repair.turned},
                     {"points_merged", repair.merged_points},
                     {"faces_removed", repair.removed_faces},
                     {"edges_stitched", repair.stitched_edges},
                     {"holes_filled", repair.filled_holes},
                     {"largest_hole_filled", repair.largest_hole},
                     {"crossing_faces_replaced", repair.crossing_faces},
                     {"before", before},
                     {"after", after},
                     {"hausdorff_distance", outcome.distance.distance},
                     {"hausdorff_error", outcome.distance.error},
                     {"volume_change", outcome.after.volume / outcome.before.volume - 1.0},
                     {"area_change", outcome.after.area / outcome.before.area - 1.0},
                     {"target", name(outcome.target.by)},
                     {"asked", outcome.target.value},
                     {"reached", outcome.report.reached},
                     {"is_met", outcome.report.is_met},
                     {"passes", outcome.report.passes},
                     {"creases_rounded", outcome.report.are_creases_rounded},
                     {"creases_kept", outcome.report.are_creases_kept},
                     {"file", outcome.file.string()}};
  fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
}

}  // namespace

int remesh_command(const RemeshArguments& arguments) {
  const fs::path file = output_file(arguments);
  require_free(file, arguments.is_overwrite);
  const RepairedSurface solid = read_solid(arguments);
  const SurfaceMesh& given = solid.mesh;
  SurfaceMesh mesh = given;
  const RemeshTarget target = target_of(arguments, given.num_vertices());
  TargetReport report = remesh_file(arguments.surface, mesh, target);
  if (!report.ok())
    throw RunFailure(
        fmt::format("{}: could not be remeshed: {}", arguments.surface, report.text()));
  io::write_surface(file, mesh);
  const Outcome outcome{solid.report,
                        target,
                        surface_quality(given, SurfaceTopology(given)),
                        surface_quality(mesh, SurfaceTopology(mesh)),
                        hausdorff_distance(given, mesh),
                        std::move(report),
                        file};
  if (arguments.is_json)
    print_json(outcome);
  else
    print_table(outcome);
  return 0;
}

}  // namespace meniscus
