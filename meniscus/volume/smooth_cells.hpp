#pragma once

#include "meniscus/mesh/tet_mesh.hpp"

namespace meniscus {

/// Moves vertices between the surfaces away from badly shaped cells. The shape is the mean ratio
/// η = 12 (3V)^⅔/Σl², 1 for the regular cell. Of cells on faces of interfaces half of it counts:
/// curved faces bulge into those cells, and fold them where they are flat. Where the worst cell
/// around a vertex counts as less than ½, the vertex goes down the gradient of Σ η⁻⁶ over its cells
/// as long as this sum falls. So no cell is inverted. Three sweeps over the vertices, each linear
/// in their number.
void smooth_cells(TetMesh& mesh);

}  // namespace meniscus
