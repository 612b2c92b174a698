#include "meniscus/evolve/step_length.hpp"

#include <algorithm>
#include <limits>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {

double step_length(const State& state, const EvolutionOptions& options) {
  double shortest = std::numeric_limits<double>::infinity(), tension = 0.0;
  for (const Interface& interface : state.scene.interfaces) {
    shortest = std::min(shortest, shortest_edge(interface.mesh));
    tension = std::max(tension, interface.tension);
  }
  if (options.step_edges == StepEdges::mesh && state.mesh)
    shortest = std::min(shortest, shortest_edge(state.mesh->tetrahedra()));
  MENISCUS_ASSERT(shortest > 0.0, "an edge of length {:g}", shortest);
  const double capillary = tension > 0.0 ? std::min(1.0, 1.0 / tension) : 1.0;
  return std::min(options.max_step, options.step_factor * capillary * shortest);
}

}  // namespace meniscus
