#include "meniscus/evolve/stability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "meniscus/core/error.hpp"
#include "meniscus/scene/interface_tension.hpp"
#include "meniscus/surface/remesh.hpp"

namespace meniscus {
namespace {

/// [1/h] The largest wave number that a triangulation of edge h shows, √6.
const double kLargestWave = std::sqrt(6.0);

double sum_of_viscosities(const Scene& scene, const Interface& interface) {
  return scene.liquids[interface.inside].viscosity + scene.liquids[interface.outside].viscosity;
}

/// ρ: the rate at which a speed convects a wave, over that at which tension smooths it.
double convection_ratio(double speed, double viscosities, double tension) {
  return 2.0 * viscosities * speed / tension;
}

/// Length of the interval of decay rates, times the step, in which a scheme is stable.
double stability_interval(TimeScheme scheme) {
  switch (scheme) {
    case TimeScheme::rkc:
      return ChebyshevScheme::stability_interval(kMostStages, ChebyshevScheme::kMostDamping);
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
    const double h = *std::ranges::min_element(edges);
    const double modulus = std::max(largest_tension(interface), largest_elasticity(interface));
    rate =
        std::max(rate, kLargestWave * modulus / (2.0 * sum_of_viscosities(scene, interface) * h));
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
  const double ratio = convection_ratio(speed, viscosities, tension);
  return std::clamp(kSlipAtOne / std::cbrt(ratio), kLeastSlip, kMostSlip);
}

WaveSpectrum wave_spectrum(const Scene& scene, const InterfaceMotion& motion,
                           std::span<const VertexField<Vec3>> velocity, double dt) {
  MENISCUS_ASSERT(motion.size() == scene.interfaces.size() && velocity.size() == motion.size(),
                  "{} motions and {} velocities of {} interfaces", motion.size(), velocity.size(),
                  scene.interfaces.size());
  WaveSpectrum waves{.decay = fastest_rate(scene, TimeScheme::rkc) * dt};
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const Interface& interface = scene.interfaces[i];
    if (interface.tension == 0.0) continue;  // nothing decays
    const VertexField<double> edges = mean_edges(interface.mesh),
                              tension = vertex_tension(interface);
    const double viscosities = sum_of_viscosities(scene, interface);
    for (const VertexId v : edges.ids()) {
      const double past = (velocity[i][v] - motion[i][v]).norm();
      waves.ratio = std::max(waves.ratio, convection_ratio(past, viscosities, tension[v]));
      waves.convection = std::max(waves.convection, kLargestWave * past * dt / edges[v]);
    }
  }
  return waves;
}

}  // namespace meniscus
