#pragma once

#include <span>
#include <vector>

#include "meniscus/evolve/options.hpp"
#include "meniscus/evolve/remeshed_interface.hpp"
#include "meniscus/evolve/state.hpp"
#include "meniscus/mesh/surface_tree.hpp"

namespace meniscus {

/// Search trees of the surfaces of a scene, by which the remesher finds close surfaces. Empty
/// without gap layers or in a scene with a single surface.
class CloseSurfaces {
 public:
  CloseSurfaces(const Scene& scene, double gap_layers);
  /// The trees of all surfaces but interface i.
  [[nodiscard]] std::vector<const SurfaceTree*> others(std::size_t i) const;

 private:
  std::vector<SurfaceTree> trees_;  // trees of the interfaces, then of the outer boundary
};

/// Remeshes an interface that has these neighbours, and restores the volume of flat faces, even if
/// remeshing fails. Fields are transferred.
[[nodiscard]] RemeshedInterface remeshed(Interface interface, const EvolutionOptions& options,
                                         std::vector<const SurfaceTree*> neighbours);

/// Remeshes interfaces and restores their volumes, each beside the others as they were before, so
/// that the result depends on no order. The ranks of `options.processes` remesh a share each and
/// exchange what they made. Collective.
std::vector<InterfaceRemesh> remesh_interfaces(State& state, const EvolutionOptions& options,
                                               std::span<const std::size_t> interfaces);
/// Whether all interfaces may stay as they are (`is_fit`).
[[nodiscard]] bool are_interfaces_fit(const Scene& scene, const EvolutionOptions& options);
/// The indices of all interfaces of a scene.
[[nodiscard]] std::vector<std::size_t> all_interfaces(const Scene& scene);

}  // namespace meniscus
