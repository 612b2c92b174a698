#include "meniscus/evolve/energy_check.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "meniscus/evolve/constants.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/scene/interface_tension.hpp"

namespace meniscus {
namespace {

/// Σ tension Σ_v |ẋ · ∂S/∂x_v|: the gross power of tension.
double gross_power(const Scene& scene, const InterfaceMotion& motion) {
  double power = 0.0;
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
    const VertexField<Vec3> gradient = area_gradient(scene.interfaces[i].mesh);
    for (const VertexId v : gradient.ids())
      power += scene.interfaces[i].tension * std::abs(gradient[v].dot(motion[i][v]));
  }
  return power;
}

}  // namespace

double interface_energy(const Scene& scene) {
  double energy = 0.0;
  for (const Interface& interface : scene.interfaces) energy += tension_energy(interface);
  return energy;
}

std::optional<Fault> find_energy_fault(const Step& step, const StageFlow& whole, const Scene& end) {
  if (has_surfactant(step.start) || std::ranges::any_of(step.start.scalars, &Scalar::acts_on_flow))
    return {};
  const double before = interface_energy(step.start), gain = interface_energy(end) - before,
               predicted = step.dt * whole.surface_rate,
               allowed = kMostEnergyShare * step.dt * gross_power(step.start, whole.motion) +
                         kEnergyRoundOff * before;
  const bool is_too_high = gain > std::max(0.0, predicted) + allowed,
             is_off = !whole.damps_waves && std::abs(gain - predicted) > allowed;
  if (is_too_high || is_off || !std::isfinite(gain))
    return Fault{FaultKind::wrong_energy,
                 fmt::format("the interfaces' energy changes by {:.3g} of itself, where the flow "
                             "gives {:.3g}",
                             gain / before, predicted / before)};
  return {};
}

}  // namespace meniscus
