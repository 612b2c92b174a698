#pragma once

#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus {

/// An icosahedron, the coarsest sphere there is to be smoothed, turns its normals by 42°.
inline constexpr double kCreaseDeg = 50.0;

/// Whether normals of a closed surface turn by more than 50° along an edge: none that is smooth
/// fits.
[[nodiscard]] bool has_creases(const SurfaceMesh& mesh, const SurfaceTopology& topology);
/// Whether a closed surface may be too rough for a smooth surface to be fitted to. It has creases,
/// or a twentieth of its angles lie below 15° (slivers).
[[nodiscard]] bool is_rough(const SurfaceMesh& mesh, const SurfaceTopology& topology);

/// Edges where normals turn by more than `kCreaseDeg`.
struct Creases {
  double pieces = 0.0;    ///< how many they are cut into, less one for each
  SurfaceEdge longest{};  ///< the longest of them, if there are any
};
/// The creases of a surface that is to have triangles with edges about `edge` long.
[[nodiscard]] Creases creases(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                              double edge);

/// A polyhedron in triangles with edges about `edge` long, by CGAL's isotropic remeshing. New
/// vertices lie on the given faces. Edges where normals turn by more than `crease_deg` stay lines
/// of edges; with 180 none do.
[[nodiscard]] SurfaceMesh isotropic_remesh(const SurfaceMesh& mesh, double edge,
                                           double crease_deg = kCreaseDeg);

}  // namespace meniscus
