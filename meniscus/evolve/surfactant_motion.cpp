#include "meniscus/evolve/surfactant_motion.hpp"

#include <algorithm>
#include <cmath>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/sphere_radius.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/scene/interface_tension.hpp"

namespace meniscus {
namespace {

double sum(const VertexField<double>& values) {
  double total = 0.0;
  for (const double each : values) total += each;
  return total;
}

/// Where rates of amounts take the concentration of an interface that moves to `end`.
VertexField<double> concentration_after(const Interface& start, const SurfaceMesh& end,
                                        const VertexField<double>& rates, double duration) {
  VertexField<double> amounts = vertex_amounts(start.mesh, *surfactant_concentration(start));
  for (const VertexId v : amounts.ids()) amounts[v] += duration * rates[v];
  return concentration_of(end, amounts);
}

}  // namespace

SurfactantTransport surfactant_transport(const Scene& scene,
                                         std::span<const VertexField<Vec3>> velocity,
                                         const InterfaceMotion& motion) {
  SurfactantTransport transport(scene.interfaces.size());
  for (std::size_t i = 0; i < transport.size(); ++i) {
    const Interface& interface = scene.interfaces[i];
    if (!interface.surfactant) continue;
    VertexField<Vec3> slip = velocity[i];
    for (const VertexId v : slip.ids()) slip[v] -= motion[i][v];
    transport[i].emplace(interface.mesh, slip, interface.surfactant->diffusivity);
  }
  return transport;
}

AmountRates amount_rates(const SurfactantTransport& transport, const Scene& scene) {
  AmountRates rates(transport.size());
  for (std::size_t i = 0; i < rates.size(); ++i)
    if (transport[i])
      rates[i] = transport[i]->rates(*surfactant_concentration(scene.interfaces[i]));
  return rates;
}

AmountRates mean_amount_rates(const SurfactantTransport& transport, const Scene& start,
                              const InterfaceMotion& motion, double duration) {
  MENISCUS_ASSERT(transport.size() == start.interfaces.size() && motion.size() == transport.size(),
                  "{} {} {}", transport.size(), start.interfaces.size(), motion.size());
  AmountRates rates(transport.size());
  for (std::size_t i = 0; i < rates.size(); ++i) {
    if (!transport[i]) continue;
    const Interface& interface = start.interfaces[i];
    rates[i] = transport[i]->mean_rates(*surfactant_concentration(interface),
                                        {interface.mesh, motion[i], duration});
  }
  return rates;
}

ConcentrationRates concentration_rates(const Scene& start, const Scene& end,
                                       const AmountRates& rates, double duration) {
  ConcentrationRates result(rates.size());
  for (std::size_t i = 0; i < rates.size(); ++i) {
    if (!start.interfaces[i].surfactant) continue;
    const VertexField<double>& before = *surfactant_concentration(start.interfaces[i]);
    result[i] =
        concentration_after(start.interfaces[i], end.interfaces[i].mesh, rates[i], duration);
    for (const VertexId v : before.ids()) result[i][v] = (result[i][v] - before[v]) / duration;
  }
  return result;
}

AmountRates amount_rates_of(const Scene& start, const Scene& end, const ConcentrationRates& rates,
                            double duration) {
  AmountRates result(rates.size());
  for (std::size_t i = 0; i < rates.size(); ++i) {
    const Interface& interface = start.interfaces[i];
    if (!interface.surfactant) continue;
    VertexField<double> after = *surfactant_concentration(interface);
    const VertexField<double> before = vertex_amounts(interface.mesh, after);
    for (const VertexId v : after.ids()) after[v] += duration * rates[i][v];
    result[i] = vertex_amounts(end.interfaces[i].mesh, after);
    for (const VertexId v : before.ids()) result[i][v] = (result[i][v] - before[v]) / duration;
  }
  return result;
}

void move_surfactant(Scene& scene, const Scene& start, const AmountRates& rates, double duration) {
  MENISCUS_ASSERT(rates.size() == scene.interfaces.size(), "{} {}", rates.size(),
                  scene.interfaces.size());
  for (std::size_t i = 0; i < rates.size(); ++i)
    if (start.interfaces[i].surfactant)
      *surfactant_concentration(scene.interfaces[i]) =
          concentration_after(start.interfaces[i], scene.interfaces[i].mesh, rates[i], duration);
}

double surfactant_error(const Scene& start, const AmountRates& second, const AmountRates& first,
                        double dt) {
  double largest = 0.0;
  for (std::size_t i = 0; i < second.size(); ++i) {
    const Interface& interface = start.interfaces[i];
    if (!interface.surfactant) continue;
    const VertexField<double> area = vertex_areas(interface.mesh);
    const double amount = sum(vertex_amounts(interface.mesh, *surfactant_concentration(interface))),
                 mean = amount / sum(area),
                 scale = sphere_radius(interface.volume) / mean_edge(interface.mesh) / mean;
    for (const VertexId v : area.ids())
      largest = std::max(largest, scale * dt * std::abs(second[i][v] - first[i][v]) / area[v]);
  }
  return largest;
}

}  // namespace meniscus
