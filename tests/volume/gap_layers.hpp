#pragma once

#include "meniscus/scene/scene.hpp"

namespace meniscus {

/// Layers of tetrahedra in the gaps of a volume mesh. A vertex of an interface has as many layers
/// before it as there are edges on the shortest path from it to another surface, or to a sheet of
/// its own that faces it (normals turned by more than 120°), by way of vertices that lie on no
/// surface: one layer where a single edge spans the gap.
struct GapLayers {
  int fewest = 0;          ///< 0: no gap as narrow as that
  double mean = 0.0;       ///< over the vertices at gaps
  int num_vertices = 0;    ///< vertices at gaps
  double narrowest = 0.0;  ///< width of the narrowest gap found [R0]
};

/// The layers of all gaps at most `widest` wide [R0]: between an interface and another one or the
/// outer boundary, and between two sheets of one interface.
[[nodiscard]] GapLayers gap_layers(const TetMesh& mesh, const Scene& scene, double widest);

}  // namespace meniscus
