#include "meniscus/evolve/stability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "meniscus/evolve/chebyshev.hpp"
#include "meniscus/scene/interface_tension.hpp"
#include "meniscus/surface/remesh.hpp"

namespace meniscus {
namespace {

/// Length of the interval of decay rates, times the step, in which a scheme is stable.
double stability_interval(TimeScheme scheme) {
  switch (scheme) {
    case TimeScheme::rkc:
      return ChebyshevScheme::stability_interval(kMostStages);
    case TimeScheme::semi_implicit:
    case TimeScheme::implicit:
      return std::numeric_limits<double>::infinity();
    case TimeScheme::euler:
    case TimeScheme::rk2:
      break;
  }
  return 2.0;  // |1 − z| ≤ 1 and |1 − z + z²/2| ≤ 1
}

/// Of what a scheme does not solve for implicitly.
double fastest_rate(const Scene& scene, TimeScheme scheme) {
  const double capillary = capillary_rate(scene);
  return scheme == TimeScheme::rkc ? std::max(capillary, diffusion_rate(scene)) : capillary;
}

}  // namespace

double capillary_rate(const Scene& scene) {
  double rate = 0.0;
  for (const Interface& interface : scene.interfaces) {
    const VertexField<double> edges = mean_edges(interface.mesh);
    const double viscosities =
        scene.liquids[interface.inside].viscosity + scene.liquids[interface.outside].viscosity;
    const double h = *std::ranges::min_element(edges);
    const double modulus = std::max(largest_tension(interface), largest_elasticity(interface));
    rate = std::max(rate, std::sqrt(6.0) * modulus / (2.0 * viscosities * h));
  }
  return rate;
}

double diffusion_rate(const Scene& scene) {
  double rate = 0.0;
  for (const Interface& interface : scene.interfaces) {
    if (!interface.surfactant || interface.surfactant->diffusivity == 0.0) continue;
    const VertexField<double> edges = mean_edges(interface.mesh);
    const double h = *std::ranges::min_element(edges);
    rate = std::max(rate, 20.0 * interface.surfactant->diffusivity / (h * h));
  }
  return rate;
}

double longest_stable_step(const Scene& scene, TimeScheme scheme) {
  return stability_interval(scheme) / fastest_rate(scene, scheme);
}

double aimed_slip(double speed, double viscosities, double tension) {
  const double ratio = 2.0 * viscosities * speed / tension;
  return std::clamp(kSlipAtOne / std::cbrt(ratio), kLeastSlip, kMostSlip);
}

int num_stable_stages(const Scene& scene, double dt) {
  return std::min(kMostStages,
                  ChebyshevScheme::num_stages_for(fastest_rate(scene, TimeScheme::rkc) * dt));
}

}  // namespace meniscus
