#pragma once

#include <span>
#include <vector>

#include "meniscus/evolve/options.hpp"
#include "meniscus/evolve/state.hpp"
#include "meniscus/mesh/surface_tree.hpp"

namespace meniscus {

/// Search trees of the surfaces of a scene, from which the remesher sees where two are close. There
/// are none where no gap layers are asked for, or where the scene has a single surface.
class CloseSurfaces {
 public:
  CloseSurfaces(const Scene& scene, double gap_layers);
  /// All surfaces but interface i.
  [[nodiscard]] std::vector<const SurfaceTree*> others(std::size_t i) const;
  void replace(std::size_t i, const SurfaceMesh& mesh);

 private:
  std::vector<SurfaceTree> trees_;  // of each interface, then of the outer boundary
};

/// What became of one interface that was to be remeshed. With a fault its triangles were left as
/// they were.
struct [[nodiscard]] InterfaceRemesh : Report {
  int drop = 0;
  bool is_mended = false;      ///< its shape or its triangles were changed first
  double smoothed_over = 0.0;  ///< [R0] length that it was smoothed over as a whole
  int closed_holes = 0;        ///< holes through it that went with a crevice
};

/// Remeshes interface i of a state and restores its volume, which a remeshing that fails does too.
/// Fields follow; `state` records the shift and how far fields left their range.
InterfaceRemesh remesh_interface(State& state, std::size_t i, const EvolutionOptions& options,
                                 const CloseSurfaces& surfaces);

/// Remeshes interfaces one after the other, each beside the others as they are then.
std::vector<InterfaceRemesh> remesh_interfaces(State& state, const EvolutionOptions& options,
                                               std::span<const std::size_t> interfaces);
/// 0, 1, …: all of a scene.
[[nodiscard]] std::vector<std::size_t> all_interfaces(const Scene& scene);

}  // namespace meniscus
