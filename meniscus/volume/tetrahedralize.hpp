#pragma once

#include <optional>

#include "meniscus/core/fault.hpp"
#include "meniscus/linear/communicator.hpp"
#include "meniscus/scene/scene.hpp"

namespace meniscus {

class FacetTable;

/// How element size passes from one surface's resolution to another's.
enum class Grading { linear, exponential, gaussian };

struct VolumeMeshOptions {
  Grading grading = Grading::linear;
  double interior_growth =
      0.5;  ///< growth of size per distance inside a region that no farther surface bounds
  double radius_edge = 1.4;  ///< TetGen's radius-edge bound
  double gap_layers = 0.0;   ///< layers of tetrahedra asked for where surfaces are close; 0: none
  /// A cell may have up to this many times the volume of the regular tetrahedron of the wanted
  /// edge. 2 gives a drop in a sphere about the number of nodes of hooper2001, table 1
  /// (docs/volume-mesh.md).
  double cell_volume = 2.0;
  /// Whether the faces of interfaces will be curved. Then vertices between the surfaces move for
  /// the shape of cells, above all of those on such faces (`smooth_cells`).
  bool curves_interfaces = false;
  /// Which processes share the sizes of cells; each makes the same mesh of the same scene.
  linear::Processes processes = linear::Processes::alone;
  void validate() const;
};

/// A fault is that of the last attempt.
struct [[nodiscard]] VolumeMeshReport : Report {
  int attempt = 0;  ///< 0: first choice; higher: a fallback (docs/volume-mesh.md lists them)
};

/// Tetrahedra of all regions of the scene, validated before it is returned. They conform exactly to
/// every interface and the outer boundary: no surface vertex or face is added, moved or lost. On
/// failure `mesh` is unchanged.
VolumeMeshReport tetrahedralize(const Scene& scene, const VolumeMeshOptions& options,
                                TetMesh& mesh);

/// As above, from the vertices between the surfaces of a mesh that filled nearly the same space
/// before. Those that still have the wanted distances are taken over, which halves the cost.
VolumeMeshReport tetrahedralize(const Scene& scene, const VolumeMeshOptions& options,
                                const TetMesh& before, TetMesh& mesh);

/// What is wrong with a mesh of this scene. Interface faces must be facets of exactly two cells
/// (boundary: one) on the right sides, and volumes be positive. Regions must be consistent, of the
/// volumes that the surfaces enclose, and surface vertices where the scene has them.
[[nodiscard]] std::optional<Fault> find_defect(const TetMesh& mesh, const Scene& scene);
/// The same, where the mesh's facets are known.
[[nodiscard]] std::optional<Fault> find_defect(const TetMesh& mesh, const FacetTable& facets,
                                               const Scene& scene);

}  // namespace meniscus
