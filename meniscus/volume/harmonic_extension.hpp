#pragma once

#include "meniscus/linear/multigrid_solver.hpp"
#include "meniscus/mesh/tet_mesh.hpp"

namespace meniscus {

/// The pattern of the matrices of a mesh's harmonic extension: an entry for every edge. It stays
/// the same while the mesh is only moved. It holds no values. Rows are the free vertices, from
/// `first_free` on.
struct HarmonicPattern {
  HarmonicPattern(const TetMesh& mesh, TetVertexId first_free);

  TetVertexId first_free;
  linear::CsrMatrix stiffness;  ///< columns: the free vertices
  linear::CsrMatrix coupling;   ///< columns: the vertices before `first_free`
};

/// Extends a velocity given at the vertices before `first_free` to those from there on. It is the
/// solution of ∇·(|K|⁻¹∇w) = 0 in linear elements on a mesh as it stands. The weight, one over the
/// cell's volume, makes small cells stiff, so that large ones take up the deformation. Linear in
/// the number of vertices: the matrix is assembled from the edges and solved by multigrid, which is
/// set up once for all velocities. docs/volume-mesh.md has the seconds.
class HarmonicExtension {
 public:
  HarmonicExtension(const HarmonicPattern& pattern, const TetMesh& mesh);

  /// To a residual of 1e-6 of the data's. Returns the iterations of the component that took most.
  int extend(Field<TetVertexId, Vec3>& w) const;

 private:
  HarmonicPattern matrices_;
  linear::MultigridSolver solver_;
};

}  // namespace meniscus
