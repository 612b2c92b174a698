#pragma once

#include "meniscus/surface/curvature.hpp"

namespace meniscus::test {

/// An estimate that shares no code with the fits of curvature.hpp, to check them against: CGAL's
/// jet fitting (cazals2005) of degree 4 to three rings, by singular values, the plane and the
/// normal its own. Curvatures converge with third order on any mesh, relaxed or not, once three
/// rings are a height function: where the surface turns by well under 90° over three edges. About
/// a tenth of a millisecond a vertex, fifty times the cost of the fits; where fewer than fifteen
/// vertices are around (solids of few faces) it asks for more rings, and fails on a surface of
/// fewer.
[[nodiscard]] VertexField<VertexCurvature> jet_curvature(const SurfaceMesh& mesh,
                                                         const SurfaceTopology& topology);

}  // namespace meniscus::test
