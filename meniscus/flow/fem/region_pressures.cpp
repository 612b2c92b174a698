#include "meniscus/flow/fem/region_pressures.hpp"

#include <algorithm>

namespace meniscus::fem {

Field<RegionId, double> constant_pressure_shares(const StokesProblem& problem) {
  const TetMesh& mesh = problem.mesh;
  // A mesh may have regions that no interface encloses; their shares are zero.
  const std::int32_t num_regions = 1 + std::ranges::max_element(mesh.region)->value;
  Field<RegionId, double> inside(num_regions, 0.0), around(num_regions, 0.0),
      shares(num_regions, 0.0);
  for (const EmbeddedSurface& interface : mesh.interfaces)
    for (const auto& [inner, outer] : interface.sides) {
      inside[mesh.region[inner]] += problem.viscosity[inner];
      around[mesh.region[inner]] += problem.viscosity[outer];
      inside[mesh.region[outer]] += problem.viscosity[outer];
      around[mesh.region[outer]] += problem.viscosity[inner];
    }
  for (const RegionId region : shares.ids())
    if (region != RegionId{0} && around[region] > inside[region])
      shares[region] = 2.0 / 3.0 * (around[region] / inside[region] - 1.0);
  return shares;
}

}  // namespace meniscus::fem
