#pragma once

#include "meniscus/mesh/tet_mesh.hpp"

namespace meniscus {

/// Moves vertices between the surfaces for the shape of the cells around them. The shape is the
/// mean ratio η = 12 (3V)^⅔/Σl², 1 for the regular cell. Of cells on faces of interfaces half of it
/// counts: curved faces bulge into those cells, and fold them where they are flat. A vertex goes
/// down the gradient of Σ η⁻⁶ over its cells as long as this sum falls. So no cell is inverted. It
/// stays where all cells count as ½ or more, which those on faces never do. Three sweeps over the
/// vertices, each linear in their number.
void smooth_cells(TetMesh& mesh);

}  // namespace meniscus
