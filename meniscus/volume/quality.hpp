#pragma once

#include "meniscus/mesh/tet_mesh.hpp"

namespace meniscus {

struct MeshQuality {
  double min_dihedral_deg = 0.0, max_dihedral_deg = 0.0;
  double below_10_deg = 0.0;      ///< fraction of cells whose smallest dihedral angle is below 10°
  double min_volume = 0.0;        ///< smallest signed volume [R0³]
  double min_radius_ratio = 0.0;  ///< smallest 3 r_in/R_circum (1: regular)
};
[[nodiscard]] MeshQuality quality(const TetMesh& mesh);
/// Smallest dihedral angle of all cells [degrees]; 180 where there is none.
[[nodiscard]] double smallest_dihedral_deg(const TetMesh& mesh);
/// Smallest dihedral angle of each cell [degrees].
[[nodiscard]] CellField<double> min_dihedral_deg(const TetMesh& mesh);

}  // namespace meniscus
