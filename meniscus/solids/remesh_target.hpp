#pragma once

#include <optional>

#include "meniscus/core/fault.hpp"
#include "meniscus/mesh/surface_mesh.hpp"
#include "meniscus/surface/constants.hpp"

namespace meniscus {

/// What a surface is to be remeshed to, all lengths in the unit of its coordinates.
struct RemeshTarget {
  enum class By {
    nodes,         ///< vertices of all pieces together, spread as ρ = C0⟨κ⟩² with one C0
    edge_length,   ///< mean edge of an even mesh
    chordal_error  ///< largest distance of a face from the smooth surface
  };
  static constexpr int kFewestNodes = 12;  ///< of a piece: the icosahedron's
  By by = By::nodes;
  double value = 1000.0;
  double edge_floor = 0.0;        ///< no edge is asked to be shorter; not with edge_length
  double gradation = kGradation;  ///< largest |∇l0| of the rest length
  void validate() const;          ///< Throws InvalidInput naming option, value, range.
};

/// On failure the surface was left as it was.
struct [[nodiscard]] TargetReport : Report {
  int passes = 0;        ///< remeshings from the given surface, until the target was met
  double reached = 0.0;  ///< vertices, mean edge or largest distance of the result
  bool is_met = false;   ///< within the bands below; a shape may need more vertices
  // Where the surface had creases or slivers: see below.
  bool are_creases_rounded = false, are_creases_kept = false;
};

/// Remeshes every piece of a closed surface, of any unit and any number of pieces, each without
/// defect. It does so until the target is met. The vertices come within 2 % of it, the mean edge
/// within 1 %, or the largest distance from the smooth surface in [0.8, 1] of it. Each piece keeps
/// its volume; with chordal_error, that of the smooth surface through its vertices.
///
/// Chordal error: an equilateral triangle of edge l lies off a surface of principal curvatures k1
/// and k2 by (k1 + k2) l²/12 at its centre. It is at most max|k| l²/8 on its edges, hence at most
/// max|k| l²/6 anywhere, which is attained on a sphere. So l0 = (6 e/max|k|)^½, but at most
/// 1/max|k| (six edges around a circle). That is the first guess; the distance of the result is
/// then measured, and the lengths are corrected, for real triangles are not equilateral.
///
/// A surface may have creases (normals turned by over 50° along an edge) or slivers (5 % of the
/// angles below 15°). Such a surface is first given even triangles on its flat faces (CGAL's
/// isotropic remeshing, creases kept). They are half as long as the target's mean edge; with
/// chordal_error, twice the error. The smooth surface of that mesh rounds creases and corners over
/// about that length, and no edge shorter than it is asked for. Where the target is not met so, the
/// mesh is smoothed as a whole over half to twice that length (`DiffusedSurface`). It takes the
/// least that meets it. Sometimes no smooth surface can be remeshed, as where parts are much
/// thinner than the edges asked for. The faces as given are then cut evenly, edges and corners
/// kept. Angles are what the shape allows, and there is no chordal error.
///
/// Transactional, like `remesh`. Throws InvalidInput where the target would take more than
/// `kMostVertices`, or is too coarse for so thin a surface.
TargetReport remesh_to(SurfaceMesh& mesh, const RemeshTarget& target);

}  // namespace meniscus
