#include "meniscus/case/surface_source.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "meniscus/core/error.hpp"
#include "meniscus/evolve/constants.hpp"
#include "meniscus/io/archive_file.hpp"
#include "meniscus/io/run_files.hpp"
#include "meniscus/io/surface_file.hpp"
#include "meniscus/mesh/surface_archive.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/isotropic_remesh.hpp"
#include "meniscus/surface/reconstructed_surface.hpp"
#include "meniscus/surface/remesh.hpp"
#include "meniscus/surface/restore_volume.hpp"

namespace meniscus {
namespace {

void require_existence(const Case& c, const std::string& path, const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) c.settings.reject(path, "does not exist");
}

void require_fit(const Case& c, const std::string& path, const SurfaceMesh& mesh) {
  if (const auto defect = find_defect(mesh)) c.settings.reject(path, "is unfit: {}", defect->text);
}

std::filesystem::path newest_checkpoint(const Case& c, const std::string& path,
                                        const std::filesystem::path& folder) {
  require_existence(c, path, folder);
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error)) c.settings.reject(path, "is not a folder");
  const auto all = io::checkpoints(folder);
  if (all.empty()) c.settings.reject(path, "holds no run: no checkpoint-<step>.h5 in the folder");
  return all.back().second;
}

/// Index in the archive of the interface of a drop.
int interface_of_drop(const Case& c, const std::string& path, const Archive& archive,
                      std::optional<int> wanted) {
  std::vector<std::int64_t> drops;
  for (int i = 0;; ++i) {
    const auto ids = archive.integers.find(fmt::format("interfaces/{}/ids", i));
    if (ids == archive.integers.end() || ids->second.empty()) break;
    drops.push_back(ids->second.front());
    if (wanted && drops.back() == *wanted) return i;
  }
  if (drops.empty()) c.settings.reject(path, "holds a checkpoint without a drop");
  if (wanted) c.settings.reject(path, "holds no drop {} but {}", *wanted, fmt::join(drops, ", "));
  if (drops.size() > 1)
    c.settings.reject(path, "holds {} drops; choose one with from-drop: {}", drops.size(),
                      fmt::join(drops, ", "));
  return 0;
}

SurfaceMesh surface_from_archive(const Case& c, const std::string& path, const Archive& archive,
                                 int index) {
  try {
    return load_surface(archive, fmt::format("interfaces/{}", index));
  } catch (const InvalidInput& error) {
    c.settings.reject(path, "holds a checkpoint without the surface of its drop: {}", error.what());
  }
}

void shift(SurfaceMesh& mesh, const Vec3& by) {
  for (Vec3& x : mesh.x) x += by;
}

/// Gives the surface of a checkpoint the volume that it had there where faces of another kind, flat
/// or curved, enclose another one.
void keep_volume(const Archive& archive, int index, SurfaceShape faces, SurfaceMesh& mesh) {
  constexpr double kRoundOff = 1e-9;
  const auto found = archive.reals.find(fmt::format("interfaces/{}/properties", index));
  if (found == archive.reals.end() || found->second.size() != 4) return;
  const double volume = found->second[2];
  if (std::abs(ReconstructedSurface(mesh, faces).volume() / volume - 1.0) > kRoundOff)
    restore_volume(mesh, volume, faces);
}

/// The volume that a given surface encloses, with flat or curved faces. A rough surface (a cube, a
/// scan) approximates no smooth one and always has flat faces.
double given_volume(const SurfaceMesh& mesh, SurfaceShape faces) {
  const bool is_smooth = !is_rough(mesh, SurfaceTopology(mesh));
  return ReconstructedSurface(mesh, is_smooth ? faces : SurfaceShape::faceted).volume();
}

/// Refuses a surface whose faces, curved as the solver takes them, do not enclose about what the
/// flat ones do. It is too coarse to show what curves.
void require_volume(const Case& c, int index, const SurfaceMesh& mesh, double curved) {
  const double flat = enclosed_volume(mesh);
  if (curved > kLeastVolumeKept * flat && curved < kMostVolumeKept * flat) return;
  reject_input(
      "{}: drop {} needs a finer surface: its faces enclose {:.4g} where they are flat, and "
      "{:.4g} curved as the solver takes them (unit: R0³)",
      c.settings.source(fmt::format("drop[{}]", index)), index, flat, curved);
}

/// Remeshes a surface to the vertex density of its drop and keeps its volume. With curved faces the
/// remesher does not restore the volume of flat faces. That would move vertices off the surface,
/// and undoing it by an even shift would thin the necks. If the remesher fails, the surface stays
/// as given and the log says so.
void resolve(const Case& c, int index, SurfaceMesh& mesh, const WarningListener& warn) {
  const DropCase& drop = c.drops[static_cast<std::size_t>(index)];
  const SurfaceShape faces = c.evolution.surface;
  MENISCUS_ASSERT(drop.nodes >= kFewestVertices, "drop {} of {} nodes", index, drop.nodes);
  const double volume = given_volume(mesh, faces);
  require_volume(c, index, mesh, volume);
  RemeshOptions options = sound_remeshing(drop.nodes / (4.0 * std::numbers::pi));
  options.restores_volume = faces == SurfaceShape::faceted;
  const RemeshReport report = remesh(mesh, options);
  if (!report.ok())
    warn(fmt::format("drop {}: its surface stays as given, remeshing failed: {}", index,
                     report.text()));
  if (faces != SurfaceShape::faceted) restore_volume(mesh, volume, faces);
}

/// An ellipsoid starts from this many times N0 points. The sphere's density would be too coarse for
/// its volume and tips; the remesher then sets the right density.
constexpr int kEllipsoidOversampling = 4;

/// The volume of an ellipsoid. Flat faces are made to enclose exactly this volume, so that vertices
/// lie slightly outside the shape. A mesh inscribed in the sphere would lack 5.4/N0 of it and
/// behave as a drop of smaller R0. That is the largest error of all at the paper's N0.
double ellipsoid_volume(const Vec3& axes) { return 4.0 / 3.0 * std::numbers::pi * axes.prod(); }

}  // namespace

TaggedSurface read_case_surface(const Case& c, const std::string& path, const FileShape& file,
                                const WarningListener& warn) {
  require_existence(c, path, file.file);
  RepairedSurface surface;
  try {
    surface = io::read_surface(file.file, file.is_repaired);
  } catch (const InvalidInput& error) {
    c.settings.reject(path, "cannot be used: {}", error.what());
  }
  if (c.settings.scale()) {
    // [R0] Five times the farthest walls that have a use.
    constexpr double kFarthest = 500.0;
    double reach = 0.0;
    for (Vec3& x : surface.mesh.x) {
      x /= c.settings.scale()->length;
      reach = std::max(reach, x.cwiseAbs().maxCoeff());
    }
    if (reach > kFarthest)
      c.settings.reject(path,
                        "reaches {:.4g} times scale.length = {}: with [scale] its coordinates are "
                        "in metres",
                        reach, c.settings.scale()->length);
  }
  if (const auto defect = find_defect(surface.mesh))
    c.settings.reject(path, "is unfit: {}", text_of(*defect, surface.report));
  if (surface.report.is_changed())
    warn(fmt::format("{}: {}: {}", c.settings.source(path), file.file.string(),
                     text_of(surface.report)));
  return {std::move(surface.mesh), std::move(surface.tag)};
}

SurfaceMesh read_run_surface(const Case& c, const std::string& path, const RunShape& shape) {
  const std::filesystem::path file = newest_checkpoint(c, path, shape.folder);
  Archive archive;
  try {
    archive = io::read_archive(file);
  } catch (const InvalidInput& error) {
    c.settings.reject(path, "cannot be used: {}", error.what());
  }
  const int index = interface_of_drop(c, path, archive, shape.drop);
  SurfaceMesh mesh = surface_from_archive(c, path, archive, index);
  require_fit(c, path, mesh);
  keep_volume(archive, index, c.evolution.surface, mesh);
  return mesh;
}

SurfaceMesh initial_surface(const Case& c, int index, const WarningListener& warn) {
  const DropCase& drop = c.drops[static_cast<std::size_t>(index)];
  const SurfaceShape faces = c.evolution.surface;
  const std::string table = fmt::format("drop[{}]", index);
  if (const auto* ball = std::get_if<BallShape>(&drop.shape)) {
    SurfaceMesh mesh = sphere(drop.nodes, ball->radius, drop.center);
    restore_volume(mesh, ellipsoid_volume(Vec3::Constant(ball->radius)), faces);
    return mesh;
  }
  SurfaceMesh mesh;
  if (const auto* run = std::get_if<RunShape>(&drop.shape))
    mesh = read_run_surface(c, table + ".from-run", *run);
  else if (const auto* file = std::get_if<FileShape>(&drop.shape))
    mesh = read_case_surface(c, table + ".surface", *file, warn).mesh;
  else
    mesh = stretched_sphere(kEllipsoidOversampling * drop.nodes,
                            std::get<EllipsoidShape>(drop.shape).axes);
  if (!std::holds_alternative<RunShape>(drop.shape)) resolve(c, index, mesh, warn);
  if (const auto* ellipsoid = std::get_if<EllipsoidShape>(&drop.shape))
    restore_volume(mesh, ellipsoid_volume(ellipsoid->axes), faces);
  require_volume(c, index, mesh, ReconstructedSurface(mesh, faces).volume());
  shift(mesh, drop.center);
  return mesh;
}

}  // namespace meniscus
