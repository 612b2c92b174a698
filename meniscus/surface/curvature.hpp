#pragma once

#include <vector>

#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus {

class RingGatherer;

/// Second-order geometry at a vertex. k1 ≥ k2, positive where the surface bends away from n, so
/// that κ = k1 + k2 = 2 on the unit sphere.
struct VertexCurvature {
  Vec3 n = Vec3::UnitZ();                       ///< unit normal, out of the enclosed liquid
  double k1 = 0.0, k2 = 0.0;                    ///< principal curvatures [1/R0]
  Vec3 d1 = Vec3::UnitX(), d2 = Vec3::UnitY();  ///< their directions

  [[nodiscard]] double sum() const { return k1 + k2; }  ///< κ of eq. 8
  [[nodiscard]] double half_sum() const { return 0.5 * (k1 + k2); }
  /// [(k1² + k2²)/2]^½, the ⟨κ⟩ of eq. 1: 1 on the unit sphere, never zero on a neck.
  [[nodiscard]] double rms() const;
};

/// Iterated least-squares paraboloid around each vertex (zinchenko1997): the normal is turned until
/// the linear terms of the fit vanish. Second order on relaxed meshes; one ring, a second one where
/// the valence makes the fit near singular.
[[nodiscard]] VertexField<VertexCurvature> fitted_curvature(const SurfaceMesh& mesh,
                                                            const SurfaceTopology& topology);

/// An independent estimate. k(e) = −2 n·(x_j − x)/|x_j − x|² is the normal curvature of the circle
/// through the vertex and a neighbour. A quadratic form of the direction e is fitted to these. The
/// normal is turned as above. Exact on spheres of any coarseness, where the paraboloid is too
/// curved by O(h²).
[[nodiscard]] VertexField<VertexCurvature> osculating_curvature(const SurfaceMesh& mesh,
                                                                const SurfaceTopology& topology);
/// That of one vertex, with a gatherer of rings and room for points that the caller keeps.
[[nodiscard]] VertexCurvature osculating_curvature(VertexId v, const SurfaceMesh& mesh,
                                                   const SurfaceTopology& topology,
                                                   RingGatherer& rings,
                                                   std::vector<Vec3>& unrolled);

}  // namespace meniscus
