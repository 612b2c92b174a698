#include "meniscus/evolve/shared_middles.hpp"

#include "meniscus/linear/shared_work.hpp"

namespace meniscus {

std::vector<Vec3> shared_middles_on_splines(const SurfaceMesh& mesh,
                                            const SurfaceTopology& topology,
                                            const SmoothSurface& smooth) {
  const std::size_t count = topology.edges().size();
  const std::vector<double> values = linear::shared_numbers(
      linear::Communicator::world(), count, 3, [&](std::size_t first, std::size_t end) {
        std::vector<double> part;
        part.reserve(3 * (end - first));
        for (const Vec3& x : middles_on_splines(mesh, topology, smooth, first, end))
          part.insert(part.end(), x.begin(), x.end());
        return part;
      });
  std::vector<Vec3> middles;
  middles.reserve(count);
  for (std::size_t e = 0; e < count; ++e) middles.emplace_back(&values[3 * e]);
  return middles;
}

}  // namespace meniscus
