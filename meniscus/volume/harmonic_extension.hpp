#pragma once

#include "meniscus/mesh/tet_mesh.hpp"

namespace meniscus {

/// Replaces w at the vertices from `first_free` on by the solution of ∇·(|K|⁻¹∇w) = 0 in linear
/// elements, with the values at the vertices before it as data. The weight, one over the cell's
/// volume, makes small cells stiff, so that large ones take up the deformation.
/// Conjugate gradients to a residual of 1e-6; about 1e-5 s per vertex.
void extend_harmonically(const TetMesh& mesh, TetVertexId first_free, Field<TetVertexId, Vec3>& w);

}  // namespace meniscus
