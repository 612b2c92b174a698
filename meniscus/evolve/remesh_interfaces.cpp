#include "meniscus/evolve/remesh_interfaces.hpp"

#include <algorithm>
#include <numeric>

#include "meniscus/core/error.hpp"
#include "meniscus/evolve/volume_restoration.hpp"
#include "meniscus/surface/repair/mend.hpp"

namespace meniscus {
namespace {

RemeshOptions remesh_options(const Interface& interface, const EvolutionOptions& run,
                             std::vector<const SurfaceTree*> neighbours) {
  RemeshOptions options = sound_remeshing(interface.C0, run.edge_floor);
  options.restores_volume = run.surface == SurfaceShape::faceted;
  if (options.restores_volume) options.volume = interface.volume;
  options.spring_tolerance = run.spring_tolerance;
  options.gap_layers = run.gap_layers;
  options.neighbours = std::move(neighbours);
  return options;
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

void CloseSurfaces::replace(std::size_t i, const SurfaceMesh& mesh) {
  if (i < trees_.size()) trees_[i] = SurfaceTree(mesh);
}

InterfaceRemesh remesh_interface(State& state, std::size_t i, const EvolutionOptions& options,
                                 const CloseSurfaces& surfaces) {
  MENISCUS_ASSERT(i < state.scene.interfaces.size(), "interface {} of {}", i,
                  state.scene.interfaces.size());
  Interface& interface = state.scene.interfaces[i];
  const RemeshOptions how = remesh_options(interface, options, surfaces.others(i));
  // Topology events can leave creases that the flow does not smooth.
  const MendReport mended =
      options.topology.is_off()
          ? MendReport{.remesh = remesh(interface.mesh, how, interface.fields)}
          : remesh_or_mend(interface.mesh, how, interface.fields);
  const RemeshReport& remeshed = mended.remesh;
  widen(state.field_excess, remeshed.field_excess);
  state.volume_shift[i] = remeshed.volume_shift;
  state.shift_over_edge = std::max(state.shift_over_edge, remeshed.volume_shift_over_edge);
  if (!remeshed.ok() || options.surface != SurfaceShape::faceted)
    restore_volume(state, i, options.surface);
  return {Report{remeshed.fault}, interface.drop, mended.is_mended, mended.smoothed_over,
          mended.closed_holes};
}

std::vector<InterfaceRemesh> remesh_interfaces(State& state, const EvolutionOptions& options,
                                               std::span<const std::size_t> interfaces) {
  MENISCUS_ASSERT(state.volume_shift.size() == state.scene.interfaces.size(),
                  "{} shifts of {} interfaces", state.volume_shift.size(),
                  state.scene.interfaces.size());
  std::vector<InterfaceRemesh> done;
  CloseSurfaces surfaces(state.scene, options.gap_layers);
  for (const std::size_t i : interfaces) {
    MENISCUS_ASSERT(i < state.scene.interfaces.size(), "{} of {} interfaces", i,
                    state.scene.interfaces.size());
    done.push_back(remesh_interface(state, i, options, surfaces));
    if (done.back().ok()) surfaces.replace(i, state.scene.interfaces[i].mesh);
  }
  return done;
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
