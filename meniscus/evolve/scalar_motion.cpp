#include "meniscus/evolve/scalar_motion.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "meniscus/mesh/sphere_radius.hpp"

namespace meniscus {

bool act_on_flow(const Scene& scene) {
  return std::ranges::any_of(scene.scalars, &Scalar::acts_on_flow);
}

std::optional<Fault> set_tension_factors(Scene& scene, const TetMesh& mesh,
                                         const BulkScalars& scalars) {
  if (std::ranges::none_of(scene.scalars, [](const Scalar& s) { return s.tension_slope != 0.0; }))
    return {};
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
    Interface& interface = scene.interfaces[i];
    interface.tension_factor = VertexField<double>(interface.mesh.num_vertices(), 1.0);
    for (const VertexId v : interface.mesh.x.ids()) {
      const auto node = static_cast<std::size_t>(mesh.interfaces[i].vertex(v).value);
      for (std::size_t k = 0; k < scene.scalars.size(); ++k)
        interface.tension_factor[v] +=
            scene.scalars[k].tension_slope * (scalars[k].values[node] - scene.scalars[k].reference);
      if (interface.tension_factor[v] > 0.0) continue;
      return Fault{FaultKind::concentration,
                   fmt::format("the scalars leave no tension on drop {} at {}", interface.drop,
                               text_of(interface.mesh.x[v])),
                   interface.mesh.x[v]};
    }
  }
  return {};
}

std::vector<ScalarTotals> scalar_totals(std::span<const ScalarMeasures> measures,
                                        const BulkScalars& scalars) {
  std::vector<ScalarTotals> totals;
  for (std::size_t k = 0; k < measures.size(); ++k) {
    ScalarTotals& row = totals.emplace_back();
    for (const ScalarContent& region : measures[k].regions) row.amount += region.amount;
    row.boundary_rate = scalars[k].boundary_rate;
    row.source_rate = scalars[k].source_rate;
    row.least = measures[k].least;
    row.largest = measures[k].largest;
  }
  return totals;
}

std::vector<ScalarOnDrop> scalars_on_drop(const Scene& scene, std::size_t interface,
                                          std::span<const ScalarMeasures> measures) {
  std::vector<ScalarOnDrop> result;
  const Interface& drop = scene.interfaces[interface];
  const double radius = sphere_radius(drop.volume);
  for (const ScalarMeasures& each : measures) {
    ScalarOnDrop& row = result.emplace_back();
    row.amount = each.regions[static_cast<std::size_t>(drop.inside.value)].amount;
    const ScalarExchange& exchange = each.interfaces[interface];
    const double excess = exchange.mean_outside - each.reference;
    if (std::abs(excess) > 1e-12 * (std::abs(exchange.mean_outside) + std::abs(each.reference)))
      row.transfer_number = 2.0 * radius * exchange.outflow / exchange.area / excess;
  }
  return result;
}

}  // namespace meniscus
