#pragma once

#include "meniscus/evolve/interface_motion.hpp"
#include "meniscus/flow/flow_solution.hpp"

namespace meniscus {

/// Lets a curved surface follow the liquid in the mean over its faces. With n·v it does so at the
/// vertices alone. So v ← v + c n with
///
///   c = ∫φ (u·ν − (n·u)_h) dS / ∫φ dS,   u = v − U,
///
/// φ is the hat function of the vertex, ν the normal of the quadratic faces. (n·u)_h is the
/// quadratic function through n·u at vertices and middles; n is interpolated to the middles. So c
/// takes out by how much the vertices' normals differ from those of the surface that the flow is
/// solved on. Else a shape along which liquid flows would settle where n·v = 0 with the wrong n. U,
/// the rigid motion of the shape, needs no correction. Errors are O(h⁴) where rings are symmetric.
/// A mean leaves the rates of the shortest waves as they were. The inverse of the mass matrix in
/// its place would raise them to four times as much (docs/time-stepping.md).
void follow_faces(const SurfaceMesh& mesh, const VertexField<Vec3>& normals,
                  const MiddleNodes& middles, VertexField<Vec3>& velocity);

}  // namespace meniscus
