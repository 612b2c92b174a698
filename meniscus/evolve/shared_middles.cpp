#include "meniscus/evolve/shared_middles.hpp"

#include "meniscus/linear/collective.hpp"
#include "meniscus/linear/communicator.hpp"

namespace meniscus {

std::vector<Vec3> shared_middles_on_splines(const SurfaceMesh& mesh,
                                            const SurfaceTopology& topology,
                                            const SmoothSurface& smooth) {
  const linear::Communicator communicator = linear::Communicator::world();
  const std::size_t count = topology.edges().size();
  const auto ranks = static_cast<std::size_t>(communicator.size());
  const auto first = [&](std::size_t rank) { return count * rank / ranks; };
  std::vector<std::int32_t> num_values;
  for (std::size_t rank = 0; rank < ranks; ++rank)
    num_values.push_back(static_cast<std::int32_t>(3 * (first(rank + 1) - first(rank))));
  const auto own = static_cast<std::size_t>(communicator.rank());
  std::vector<double> values(3 * count), part;
  for (const Vec3& x : middles_on_splines(mesh, topology, smooth, first(own), first(own + 1)))
    part.insert(part.end(), x.begin(), x.end());
  linear::gather(communicator, part, num_values, values);
  std::vector<Vec3> middles;
  middles.reserve(count);
  for (std::size_t e = 0; e < count; ++e) middles.emplace_back(&values[3 * e]);
  return middles;
}

}  // namespace meniscus
