#include "meniscus/evolve/stability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "meniscus/evolve/chebyshev.hpp"
#include "meniscus/surface/remesh.hpp"

namespace meniscus {
namespace {

/// Length of the interval of decay rates, times the step, in which a scheme is stable.
double stability_interval(TimeScheme scheme) {
  switch (scheme) {
    case TimeScheme::rkc:
      return ChebyshevScheme::stability_interval(kMostStages);
    case TimeScheme::semi_implicit:
      return std::numeric_limits<double>::infinity();
    case TimeScheme::euler:
    case TimeScheme::rk2:
      break;
  }
  return 2.0;  // |1 − z| ≤ 1 and |1 − z + z²/2| ≤ 1
}

}  // namespace

double capillary_rate(const Scene& scene) {
  double rate = 0.0;
  for (const Interface& interface : scene.interfaces) {
    const VertexField<double> edges = mean_edges(interface.mesh);
    const double viscosities =
        scene.liquids[interface.inside].viscosity + scene.liquids[interface.outside].viscosity;
    const double h = *std::ranges::min_element(edges);
    rate = std::max(rate, std::sqrt(6.0) * interface.tension / (2.0 * viscosities * h));
  }
  return rate;
}

double longest_stable_step(const Scene& scene, TimeScheme scheme) {
  return stability_interval(scheme) / capillary_rate(scene);
}

double aimed_slip(double speed, double viscosities, double tension) {
  const double ratio = 2.0 * viscosities * speed / tension;
  return std::clamp(kSlipAtOne / std::cbrt(ratio), kLeastSlip, kMostSlip);
}

int num_stable_stages(const Scene& scene, double dt) {
  return std::min(kMostStages, ChebyshevScheme::num_stages_for(capillary_rate(scene) * dt));
}

}  // namespace meniscus
