#include "meniscus/evolve/volume_restoration.hpp"

#include <cmath>

#include "meniscus/evolve/interface_motion.hpp"
#include "meniscus/surface/carry_fields.hpp"

namespace meniscus {

void carry_fields(State& state, std::size_t i, const SurfaceMesh& before) {
  Interface& interface = state.scene.interfaces[i];
  if (interface.fields.empty()) return;
  widen(state.field_excess, move_fields(interface.fields, before, interface.mesh));
}

void restore_volume(State& state, std::size_t i, SurfaceShape surface) {
  Interface& interface = state.scene.interfaces[i];
  const SurfaceMesh before = interface.fields.empty() ? SurfaceMesh() : interface.mesh;
  const double shift = restore_volume(interface.mesh, interface.volume, surface);
  carry_fields(state, i, before);
  state.volume_shift[i] = std::abs(shift);
}

}  // namespace meniscus
