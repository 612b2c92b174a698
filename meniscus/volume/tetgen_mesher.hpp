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

/// Its answer: the vertices of the complex in their order, then its own; `failure` says why there
/// are none.
struct [[nodiscard]] MesherResult {
  std::string failure;
  Field<TetVertexId, Vec3> x;
  CellField<CellVertices> cells;
};

/// TetGen's switches in the order in which they are to be tried. p: keep the given facets; Y: add
/// no vertex to them; M: keep facets in one plane apart; q: radius-edge bound / smallest dihedral
/// angle; o/: dihedral angle above which a cell is optimised; T: tolerance of coplanarity; Q: be
/// quiet.
[[nodiscard]] std::vector<std::string> tetgen_switches(double radius_edge);

/// Tetrahedra of all that the complex encloses, by TetGen in memory under the given switches.
/// A tetrahedron is cut when its volume exceeds `volume_factor` h³/(6√2), that of the regular one
/// whose edge h is the mean of `size` over its vertices; `size` is evaluated once per vertex.
MesherResult run_tetgen(const SurfaceComplex& complex, const std::string& switches,
                        const std::function<double(const Vec3&)>& size, double volume_factor);

}  // namespace meniscus
