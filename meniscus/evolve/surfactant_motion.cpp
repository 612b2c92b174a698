#include "meniscus/evolve/surfactant_motion.hpp"

#include <algorithm>
#include <cmath>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/sphere_radius.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/scene/interface_tension.hpp"

namespace meniscus {
namespace {

/// The carriers of a step: at its start, at its stages, at its end, after remeshing.
constexpr std::size_t kCarriersOfInterface = 4;

/// Where rates of amounts take the concentration of an interface.
VertexField<double> concentration_after(const SurfactantPath& path, std::size_t i,
                                        const VertexField<double>& rates) {
  VertexField<double> amounts =
      path.at_start[i]->mass.amounts(*surfactant_concentration(path.start.interfaces[i]));
  for (const VertexId v : amounts.ids()) amounts[v] += path.duration * rates[v];
  return path.at_end[i]->mass.concentration(amounts);
}

double amount(const Interface& interface, Carriers& carriers) {
  return carriers.of(interface.mesh)->mass.total(*surfactant_concentration(interface));
}

}  // namespace

std::shared_ptr<const Carrier> Carriers::of(const SurfaceMesh& mesh) {
  for (const auto& each : last_)
    if (each->mesh == mesh) return each;
  last_.push_front(std::make_shared<const Carrier>(mesh, shape_));
  return last_.front();
}

SceneCarriers Carriers::of(const Scene& scene) {
  SceneCarriers carriers(scene.interfaces.size());
  for (std::size_t i = 0; i < carriers.size(); ++i)
    if (scene.interfaces[i].surfactant) carriers[i] = of(scene.interfaces[i].mesh);
  last_.resize(std::min(last_.size(), kCarriersOfInterface * carriers.size()));
  return carriers;
}

SurfactantTransport surfactant_transport(const Scene& scene, const SceneCarriers& carriers,
                                         std::span<const VertexField<Vec3>> velocity,
                                         const InterfaceMotion& motion) {
  SurfactantTransport transport(scene.interfaces.size());
  for (std::size_t i = 0; i < transport.size(); ++i) {
    const Interface& interface = scene.interfaces[i];
    if (!interface.surfactant) continue;
    VertexField<Vec3> slip = velocity[i];
    for (const VertexId v : slip.ids()) slip[v] -= motion[i][v];
    transport[i].emplace(carriers[i]->surface, slip, interface.surfactant->diffusivity);
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

SurfactantTransport combined(double a, const SurfactantTransport& first, double b,
                             const SurfactantTransport& second) {
  MENISCUS_ASSERT(first.size() == second.size(), "{} {}", first.size(), second.size());
  SurfactantTransport result(first.size());
  for (std::size_t i = 0; i < result.size(); ++i)
    if (first[i]) result[i].emplace(a, *first[i], b, *second[i]);
  return result;
}

AmountRates mean_amount_rates(const SurfactantTransport& transport, const SurfactantPath& path) {
  MENISCUS_ASSERT(transport.size() == path.start.interfaces.size(), "{} {}", transport.size(),
                  path.start.interfaces.size());
  AmountRates rates(transport.size());
  for (std::size_t i = 0; i < rates.size(); ++i)
    if (transport[i])
      rates[i] =
          transport[i]->mean_rates(*surfactant_concentration(path.start.interfaces[i]),
                                   {path.at_start[i]->mass, path.at_end[i]->mass, path.duration});
  return rates;
}

AmountRates rates_of_sources(const SurfactantTransport& transport, const SurfactantPath& path,
                             const AmountRates& sources) {
  AmountRates rates(transport.size());
  for (std::size_t i = 0; i < rates.size(); ++i)
    if (transport[i])
      rates[i] =
          sources[i].empty()
              ? VertexField<double>(path.start.interfaces[i].mesh.num_vertices(), 0.0)
              : transport[i]->rates_of_sources(
                    sources[i], {path.at_start[i]->mass, path.at_end[i]->mass, path.duration});
  return rates;
}

std::vector<VertexField<double>> species_beside(const Scene& scene, const TetMesh& mesh,
                                                const BulkScalars& scalars) {
  std::vector<VertexField<double>> species(scene.interfaces.size());
  for (std::size_t i = 0; i < species.size(); ++i) {
    const Interface& interface = scene.interfaces[i];
    if (!interface.surfactant || !interface.surfactant->adsorption) continue;
    const auto k = static_cast<std::size_t>(interface.surfactant->adsorption->species);
    const double capacity = scene.liquids[interface.outside].scalars[k].capacity;
    for (const VertexId v : interface.mesh.x.ids())
      species[i].add(
          capacity *
          scalars[k].values[static_cast<std::size_t>(mesh.interfaces[i].vertex(v).value)]);
  }
  return species;
}

ConcentrationRates expected_adsorption(const Scene& scene,
                                       std::span<const VertexField<double>> species,
                                       double duration) {
  ConcentrationRates rates(species.size());
  for (std::size_t i = 0; i < rates.size(); ++i) {
    if (species[i].empty()) continue;
    const Interface& interface = scene.interfaces[i];
    const Adsorption& law = *interface.surfactant->adsorption;
    const double coverage = 1.0 / packing_limit(interface.surfactant->state);
    const VertexField<double>& concentration = *surfactant_concentration(interface);
    for (const VertexId v : concentration.ids()) {
      const double on_empty = law.constant * species[i][v], pull = 1.0 + coverage * on_empty;
      rates[i].add(law.biot * (on_empty - pull * concentration[v]) /
                   (1.0 + duration * law.biot * pull));
    }
  }
  return rates;
}

AmountRates expected_uptake(const Scene& scene, const SceneCarriers& carriers,
                            std::span<const VertexField<double>> species, double duration) {
  AmountRates uptake = expected_adsorption(scene, species, duration);
  for (std::size_t i = 0; i < uptake.size(); ++i)
    if (!uptake[i].empty()) uptake[i] = carriers[i]->mass.amounts(uptake[i]);
  return uptake;
}

ConcentrationRates concentration_rates(const SurfactantPath& path, const AmountRates& rates) {
  ConcentrationRates result(rates.size());
  for (std::size_t i = 0; i < rates.size(); ++i) {
    if (!path.at_start[i]) continue;
    const VertexField<double>& before = *surfactant_concentration(path.start.interfaces[i]);
    result[i] = concentration_after(path, i, rates[i]);
    for (const VertexId v : before.ids()) result[i][v] = (result[i][v] - before[v]) / path.duration;
  }
  return result;
}

AmountRates amount_rates_of(const SurfactantPath& path, const ConcentrationRates& rates) {
  AmountRates result(rates.size());
  for (std::size_t i = 0; i < rates.size(); ++i) {
    if (!path.at_start[i]) continue;
    VertexField<double> after = *surfactant_concentration(path.start.interfaces[i]);
    const VertexField<double> before = path.at_start[i]->mass.amounts(after);
    for (const VertexId v : after.ids()) after[v] += path.duration * rates[i][v];
    result[i] = path.at_end[i]->mass.amounts(after);
    for (const VertexId v : before.ids()) result[i][v] = (result[i][v] - before[v]) / path.duration;
  }
  return result;
}

void move_surfactant(Scene& scene, const SurfactantPath& path, const AmountRates& rates) {
  MENISCUS_ASSERT(rates.size() == scene.interfaces.size(), "{} {}", rates.size(),
                  scene.interfaces.size());
  for (std::size_t i = 0; i < rates.size(); ++i)
    if (path.at_start[i])
      *surfactant_concentration(scene.interfaces[i]) = concentration_after(path, i, rates[i]);
}

void keep_surfactant(Scene& scene, const Scene& before, Carriers& carriers) {
  if (!has_surfactant(before)) return;
  double gone = 0.0, born = 0.0;
  std::vector<double> factor(scene.interfaces.size(), 1.0);
  std::vector<bool> is_born(scene.interfaces.size(), true);
  for (const Interface& old : before.interfaces) {
    if (!old.surfactant) continue;
    const auto same = std::ranges::find(scene.interfaces, old.drop, &Interface::drop);
    if (same == scene.interfaces.end()) {
      gone += amount(old, carriers);
      continue;
    }
    const auto i = static_cast<std::size_t>(same - scene.interfaces.begin());
    is_born[i] = false;
    if (old.mesh != same->mesh || old.fields != same->fields)
      factor[i] = amount(old, carriers) / amount(*same, carriers);
  }
  for (std::size_t i = 0; i < factor.size(); ++i)
    if (is_born[i] && scene.interfaces[i].surfactant) born += amount(scene.interfaces[i], carriers);
  for (std::size_t i = 0; i < factor.size(); ++i) {
    VertexField<double>* concentration = surfactant_concentration(scene.interfaces[i]);
    if (concentration == nullptr) continue;
    for (double& each : *concentration) each *= is_born[i] ? gone / born : factor[i];
  }
}

void take_up(Scene& scene, std::span<const VertexField<double>> uptake, const AmountRates& expected,
             double duration, Carriers& carriers) {
  for (std::size_t i = 0; i < uptake.size(); ++i) {
    if (uptake[i].empty()) continue;
    Interface& interface = scene.interfaces[i];
    const SurfaceMass& mass = carriers.of(interface.mesh)->mass;
    VertexField<double>& concentration = *surfactant_concentration(interface);
    VertexField<double> amounts = mass.amounts(concentration);
    for (const VertexId v : amounts.ids()) amounts[v] += duration * (uptake[i][v] - expected[i][v]);
    concentration = mass.concentration(amounts);
  }
}

double surfactant_error(const SurfactantPath& path, const SurfactantTransport& transport,
                        const AmountRates& second, const AmountRates& first) {
  double largest = 0.0;
  for (std::size_t i = 0; i < second.size(); ++i) {
    if (!path.at_start[i]) continue;
    const Interface& interface = path.start.interfaces[i];
    const VertexField<double> area = path.at_start[i]->mass.areas();
    double total = 0.0;
    for (const double each : area) total += each;
    const double mean = path.at_start[i]->mass.total(*surfactant_concentration(interface)) / total;
    const double scale = sphere_radius(interface.volume) / mean_edge(interface.mesh) / mean;
    VertexField<double> apart = second[i];
    for (const VertexId v : apart.ids()) apart[v] = path.duration * (apart[v] - first[i][v]);
    for (const double each : transport[i]->settled(apart, path.at_start[i]->mass, path.duration))
      largest = std::max(largest, scale * std::abs(each));
  }
  return largest;
}

}  // namespace meniscus
