#pragma once

#include <span>
#include <vector>

#include "meniscus/evolve/options.hpp"
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
  void replace(std::size_t i, const SurfaceMesh& mesh);

 private:
  std::vector<SurfaceTree> trees_;  // trees of the interfaces, then of the outer boundary
};

/// The outcome of remeshing one interface. With a fault its triangles are unchanged.
struct [[nodiscard]] InterfaceRemesh : Report {
  int drop = 0;
  bool is_mended = false;      ///< repair changed its shape or triangles before
  double smoothed_over = 0.0;  ///< [R0] smoothing length of the whole surface; 0: not smoothed
  int closed_holes = 0;        ///< holes that closed with a crevice
};

/// Remeshes interface i of a state and restores its volume, even if remeshing fails. Fields are
/// transferred. `state` records the shift and the excess of fields.
InterfaceRemesh remesh_interface(State& state, std::size_t i, const EvolutionOptions& options,
                                 const CloseSurfaces& surfaces);

/// Remeshes interfaces one after the other. Each sees the others as they are at that moment.
std::vector<InterfaceRemesh> remesh_interfaces(State& state, const EvolutionOptions& options,
                                               std::span<const std::size_t> interfaces);
/// Whether all interfaces may stay as they are (`is_fit`).
[[nodiscard]] bool are_interfaces_fit(const Scene& scene, const EvolutionOptions& options);
/// The indices of all interfaces of a scene.
[[nodiscard]] std::vector<std::size_t> all_interfaces(const Scene& scene);

}  // namespace meniscus
