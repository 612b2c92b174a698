#include "meniscus/scene/interface_tension.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {
namespace {

template <class Fields>
auto* find_concentration(Fields& fields) {
  const auto at = std::ranges::find(fields, kSurfactantField, &CarriedField<VertexId>::name);
  MENISCUS_ASSERT(at != fields.end(), "an interface has a surfactant and no field of it");
  return &at->values;
}

/// Why a concentration has no tension above zero; empty where it has.
std::string complaint(const Surfactant& surfactant, double concentration) {
  if (!(concentration >= 0.0)) return "must not be negative";
  if (const double limit = packing_limit(surfactant.state); !(concentration < limit))
    return fmt::format("must stay below the packing limit {:.4g}", limit);
  if (const double limit = zero_tension_concentration(surfactant.state); !(concentration < limit))
    return fmt::format("leaves no tension from {:.4g} on", limit);
  return {};
}

/// σ at a concentration Γ on an interface with surfactant [μ_out G R0].
double tension_at(const Interface& interface, double concentration) {
  return interface.tension * relative_tension(interface.surfactant->state, concentration).value;
}

}  // namespace

const VertexField<double>* surfactant_concentration(const Interface& interface) {
  return interface.surfactant ? find_concentration(interface.fields.on_vertices) : nullptr;
}

VertexField<double>* surfactant_concentration(Interface& interface) {
  return interface.surfactant ? find_concentration(interface.fields.on_vertices) : nullptr;
}

bool has_surfactant(const Scene& scene) {
  return std::ranges::any_of(scene.interfaces, [](const Interface& interface) {
    return interface.surfactant.has_value();
  });
}

bool has_soluble_surfactant(const Scene& scene) {
  return std::ranges::any_of(scene.interfaces, [](const Interface& interface) {
    return interface.surfactant && interface.surfactant->adsorption;
  });
}

VertexField<double> vertex_tension(const Interface& interface) {
  VertexField<double> tension(interface.mesh.num_vertices(), interface.tension);
  if (const VertexField<double>* concentration = surfactant_concentration(interface))
    for (const VertexId v : tension.ids()) tension[v] = tension_at(interface, (*concentration)[v]);
  if (interface.tension_factor.size() == tension.size())
    for (const VertexId v : tension.ids()) tension[v] *= interface.tension_factor[v];
  return tension;
}

double largest_tension(const Interface& interface) {
  if (!interface.tension_factor.empty()) {
    const VertexField<double> tension = vertex_tension(interface);
    return *std::ranges::max_element(tension);
  }
  const VertexField<double>* concentration = surfactant_concentration(interface);
  if (concentration == nullptr) return interface.tension;
  return tension_at(interface, *std::ranges::min_element(*concentration));
}

VertexField<double> vertex_elasticity(const Interface& interface) {
  VertexField<double> elasticity;
  const VertexField<double>* concentration = surfactant_concentration(interface);
  if (concentration == nullptr) return elasticity;
  for (const double each : *concentration)
    elasticity.add(-interface.tension * each *
                   relative_tension(interface.surfactant->state, each).slope);
  return elasticity;
}

double largest_elasticity(const Interface& interface) {
  double largest = 0.0;
  for (const double each : vertex_elasticity(interface)) largest = std::max(largest, each);
  return largest;
}

double tension_energy(const Interface& interface) {
  if (!has_varying_tension(interface)) return interface.tension * surface_area(interface.mesh);
  const VertexField<double> area = vertex_areas(interface.mesh),
                            tension = vertex_tension(interface);
  double sum = 0.0;
  for (const VertexId v : area.ids()) sum += tension[v] * area[v];
  return sum;
}

std::optional<Fault> find_surfactant_fault(const Scene& scene) {
  for (const Interface& interface : scene.interfaces) {
    const VertexField<double>* concentration = surfactant_concentration(interface);
    if (concentration == nullptr) continue;
    for (const VertexId v : concentration->ids())
      if (const std::string why = complaint(*interface.surfactant, (*concentration)[v]);
          !why.empty())
        return Fault{
            FaultKind::concentration,
            fmt::format("the surfactant on drop {} at {} has the concentration {:.4g}, "
                        "which {}",
                        interface.drop, text_of(interface.mesh.x[v]), (*concentration)[v], why),
            interface.mesh.x[v]};
  }
  return {};
}

}  // namespace meniscus
