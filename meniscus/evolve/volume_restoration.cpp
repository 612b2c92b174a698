#include "meniscus/evolve/volume_restoration.hpp"

#include <algorithm>
#include <cmath>

#include "meniscus/core/error.hpp"
#include "meniscus/evolve/interface_motion.hpp"
#include "meniscus/surface/carry_fields.hpp"
#include "meniscus/surface/remesh.hpp"
#include "meniscus/surface/restore_volume.hpp"

namespace meniscus {
namespace {

/// `restore` shifts the vertices and returns how far.
template <class Restore>
VolumeShift restored(Interface& interface, const Restore& restore) {
  MENISCUS_ASSERT(interface.volume > 0.0, "drop {} is to have a volume of {:g}", interface.drop,
                  interface.volume);
  const SurfaceMesh before = interface.fields.empty() ? SurfaceMesh() : interface.mesh;
  VolumeShift shift;
  shift.length = std::abs(restore());
  const VertexField<double> edges = mean_edges(interface.mesh);
  shift.over_edge = shift.length / *std::ranges::min_element(edges);
  if (!interface.fields.empty())
    shift.field_excess = move_fields(interface.fields, before, interface.mesh);
  return shift;
}

}  // namespace

void carry_fields(State& state, std::size_t i, const SurfaceMesh& before) {
  Interface& interface = state.scene.interfaces[i];
  if (interface.fields.empty()) return;
  widen(state.field_excess, move_fields(interface.fields, before, interface.mesh));
}

VolumeShift restore_volume(Interface& interface, SurfaceShape surface, KnownSurfaces& surfaces) {
  if (surface == SurfaceShape::faceted) return restore_flat_volume(interface);
  return restored(interface, [&] {
    return restore_volume(interface.mesh, interface.volume, surface, surfaces);
  });
}

VolumeShift restore_flat_volume(Interface& interface) {
  return restored(interface, [&] { return restore_volume(interface.mesh, interface.volume); });
}

void record(State& state, std::size_t i, const VolumeShift& shift) {
  state.volume_shift[i] = shift.length;
  state.shift_over_edge = std::max(state.shift_over_edge, shift.over_edge);
  widen(state.field_excess, shift.field_excess);
}

ShiftVerdict ShiftJudge::judge(const State& state, bool can_shorten) {
  const double shift = state.shift_over_edge;
  MENISCUS_ASSERT(shift >= 0.0, "a shift of {:g} edges", shift);
  if (shift <= kMostShiftOverEdge || state.tolerates_shift || !state.events.empty())
    return ShiftVerdict::accept;
  if (!can_shorten || shift > kShiftLeft * before_) return ShiftVerdict::accept_for_good;
  before_ = shift;
  return ShiftVerdict::shorten;
}

}  // namespace meniscus
