#pragma once

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "meniscus/mesh/tet_mesh.hpp"

namespace meniscus {

/// Triangulated surfaces without names: what a mesher is given.
struct SurfaceComplex {
  std::vector<Vec3> x;
  std::vector<std::array<std::int32_t, 3>> triangles;
};

/// What a mesher gives: the vertices of the complex in their order, then those between the
/// surfaces; `failure` says why there are none.
struct [[nodiscard]] MesherResult {
  std::string failure;
  Field<TetVertexId, Vec3> x;
  CellField<CellVertices> cells;
};

/// TetGen's switches in the order in which they are to be tried. p: keep the given facets; Y: add
/// no vertex to them; M: keep facets in one plane apart. q: radius-edge bound / smallest dihedral
/// angle; o/: dihedral angle above which a cell is optimised; T: tolerance of coplanarity; Q: be
/// quiet.
[[nodiscard]] std::vector<std::string> tetgen_switches(double radius_edge);

/// A vertex that the mesh may have between the surfaces, and the edge wanted there.
struct SizedVertex {
  Vec3 x;
  double size;
};

/// How large tetrahedra are to be.
struct CellTarget {
  std::function<double(const Vec3&)> size;  ///< edge wanted at a point
  /// A tetrahedron is cut when its volume exceeds this times h³/(6√2). That is the volume of the
  /// regular one whose edge h is the mean of `size` over the vertices.
  double volume_factor = 2.0;
  double num_cells = 0.0;  ///< how many are expected, for the time that meshing may take
  /// `size` at the vertices of the surfaces, where that is known.
  std::vector<double> surface_sizes = {};
  /// Vertices to begin with; they may be moved, and further ones are added where cells ask for it.
  std::vector<SizedVertex> vertices = {};
};

/// Tetrahedra of all that the complex encloses, by TetGen under the given switches; `size` is
/// evaluated once per vertex where it is not given. TetGen works in a child process
/// (`run_in_child`), for Debian's library is built with its assertions on. One that does not hold
/// ends the child and is a failure here. Points in special positions bring that out: coplanar and
/// cospherical ones, as on a box.
MesherResult run_tetgen(const SurfaceComplex& complex, const std::string& switches,
                        const CellTarget& target);

}  // namespace meniscus
