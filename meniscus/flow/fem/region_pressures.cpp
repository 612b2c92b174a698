#include "meniscus/flow/fem/region_pressures.hpp"

#include <algorithm>

namespace meniscus::fem {

Field<RegionId, double> viscosities_around(const StokesProblem& problem) {
  const TetMesh& mesh = problem.mesh;
  const std::int32_t num_regions = 1 + std::ranges::max_element(mesh.region)->value;
  Field<RegionId, double> inside(num_regions, 0.0), around(num_regions, 0.0),
      ratios(num_regions, 1.0);
  for (const EmbeddedSurface& interface : mesh.interfaces)
    for (const auto& [inner, outer] : interface.sides) {
      inside[mesh.region[inner]] += problem.viscosity[inner];
      around[mesh.region[inner]] += problem.viscosity[outer];
      inside[mesh.region[outer]] += problem.viscosity[outer];
      around[mesh.region[outer]] += problem.viscosity[inner];
    }
  for (const RegionId region : ratios.ids())
    if (region != RegionId{0} && inside[region] > 0.0)
      ratios[region] = around[region] / inside[region];
  return ratios;
}

Field<RegionId, double> constant_pressure_shares(const StokesProblem& problem) {
  Field<RegionId, double> shares = viscosities_around(problem);
  for (double& share : shares) share = 2.0 / 3.0 * std::max(0.0, share - 1.0);
  return shares;
}

}  // namespace meniscus::fem
