#include "meniscus/evolve/remesh_interfaces.hpp"

#include <algorithm>
#include <numeric>

#include "meniscus/core/error.hpp"
#include "meniscus/evolve/volume_restoration.hpp"
#include "meniscus/linear/shared_work.hpp"
#include "meniscus/surface/repair/mend.hpp"

namespace meniscus {
namespace {

RemeshOptions remesh_options(const Interface& interface, const EvolutionOptions& run,
                             std::vector<const SurfaceTree*> neighbours) {
  RemeshOptions options = sound_remeshing(interface.C0, run.edge_floor);
  options.on_splines = run.surface != SurfaceShape::faceted;
  options.restores_volume = run.surface == SurfaceShape::faceted;
  if (options.restores_volume) options.volume = interface.volume;
  if (run.surface == SurfaceShape::splined) options.kept = kKeptByCurvedElements;
  options.spring_tolerance = run.spring_tolerance;
  options.neck_edges = run.neck_edges;
  options.gap_layers = run.gap_layers;
  options.neighbours = std::move(neighbours);
  return options;
}

/// Both shifts, the second after the first.
VolumeShift joined(VolumeShift first, const VolumeShift& second) {
  follow(first.field_excess, second.field_excess);
  return {second.length, std::max(first.over_edge, second.over_edge), first.field_excess};
}

std::vector<RemeshedInterface> all_remeshed(const Scene& scene, const EvolutionOptions& options,
                                            std::span<const std::size_t> interfaces) {
  const CloseSurfaces surfaces(scene, options.gap_layers);
  std::vector<double> work;
  for (const std::size_t i : interfaces) {
    MENISCUS_ASSERT(i < scene.interfaces.size(), "{} of {} interfaces", i, scene.interfaces.size());
    work.push_back(scene.interfaces[i].mesh.num_vertices());
  }
  std::vector<RemeshedInterface> all(interfaces.size());
  linear::share_work(
      linear::Communicator::of(options.processes), work,
      [&](std::size_t k, Archive& archive) {
        const std::size_t i = interfaces[k];
        all[k] = remeshed(scene.interfaces[i], options, surfaces.others(i));
        save(all[k], archive);
      },
      [&](std::size_t k, const Archive& archive) { all[k] = load_remeshed(archive); });
  return all;
}

}  // namespace

CloseSurfaces::CloseSurfaces(const Scene& scene, double gap_layers) {
  const std::size_t num_surfaces = scene.interfaces.size() + (scene.is_unbounded ? 0 : 1);
  if (gap_layers == 0.0 || num_surfaces < 2) return;
  for (const Interface& interface : scene.interfaces) trees_.emplace_back(interface.mesh);
  if (!scene.is_unbounded) trees_.emplace_back(scene.boundary.mesh);
}

std::vector<const SurfaceTree*> CloseSurfaces::others(std::size_t i) const {
  std::vector<const SurfaceTree*> others;
  for (std::size_t j = 0; j < trees_.size(); ++j)
    if (j != i) others.push_back(&trees_[j]);
  return others;
}

RemeshedInterface remeshed(Interface interface, const EvolutionOptions& options,
                           std::vector<const SurfaceTree*> neighbours) {
  const RemeshOptions how = remesh_options(interface, options, std::move(neighbours));
  // Topology events can leave creases that the flow does not smooth.
  const MendReport mended =
      options.topology.is_off()
          ? MendReport{.remesh = remesh(interface.mesh, how, interface.fields)}
          : remesh_or_mend(interface.mesh, how, interface.fields);
  const RemeshReport& report = mended.remesh;
  VolumeShift shift{report.volume_shift, report.volume_shift_over_edge, report.field_excess};
  if (!report.ok() && options.surface == SurfaceShape::faceted)
    shift = joined(shift, restore_flat_volume(interface));
  return {std::move(interface.mesh), std::move(interface.fields), shift,
          InterfaceRemesh{Report{report.fault}, interface.drop, mended.is_mended,
                          mended.smoothed_over, mended.closed_holes}};
}

std::vector<InterfaceRemesh> remesh_interfaces(State& state, const EvolutionOptions& options,
                                               std::span<const std::size_t> interfaces) {
  MENISCUS_ASSERT(state.volume_shift.size() == state.scene.interfaces.size(),
                  "{} shifts of {} interfaces", state.volume_shift.size(),
                  state.scene.interfaces.size());
  const std::vector<RemeshedInterface> all = all_remeshed(state.scene, options, interfaces);
  std::vector<InterfaceRemesh> outcomes;
  for (std::size_t k = 0; k < interfaces.size(); ++k) {
    Interface& interface = state.scene.interfaces[interfaces[k]];
    interface.mesh = all[k].mesh;
    interface.tension_factor = {};  // of the vertices before
    interface.fields = all[k].fields;
    VolumeShift shift = all[k].shift;
    if (options.surface != SurfaceShape::faceted)
      shift = joined(shift, restore_volume(interface, options.surface, *state.surfaces));
    record(state, interfaces[k], shift);
    outcomes.push_back(all[k].outcome);
  }
  return outcomes;
}

bool are_interfaces_fit(const Scene& scene, const EvolutionOptions& options) {
  const CloseSurfaces surfaces(scene, options.gap_layers);
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i)
    if (const Interface& interface = scene.interfaces[i];
        !is_fit(interface.mesh, remesh_options(interface, options, surfaces.others(i))))
      return false;
  return true;
}

std::vector<std::size_t> all_interfaces(const Scene& scene) {
  std::vector<std::size_t> all(scene.interfaces.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

}  // namespace meniscus
