#pragma once

#include <string>

#include "meniscus/flow/fem/constraints.hpp"
#include "meniscus/scene/scene.hpp"

namespace meniscus::fem {

/// The conditions of the outer boundary's patches at one instant, by vertex of the volume mesh.
struct BoundaryConditions {
  Constraints constraints;
  Field<TetVertexId, Vec3> traction;  ///< ∫φ t dS of the open patches [μ_out G R0²]
  bool has_open_patch = false;
  std::string failure;  ///< why there is no flow under these conditions; empty if there is
};

/// Where patches meet, a vertex obeys ImposedVelocity first (that of the lowest patch id), then
/// every NoPenetration. Without an open patch imposed velocities that are not the linear flow lose
/// their net flux through the faceted boundary along the area vectors, as interpolated data have
/// one of O(h²).
[[nodiscard]] BoundaryConditions boundary_conditions(const OuterBoundary& boundary,
                                                     const TetMesh& mesh, double t);

/// Unit normals of the flat pieces that the given patches have at each vertex of a surface: faces
/// of one patch whose normals lie within 40° of each other make one piece, whose normal is that of
/// its area vector.
[[nodiscard]] VertexField<std::vector<Vec3>> piece_normals(const SurfaceMesh& mesh,
                                                           const FaceField<PatchId>& patch,
                                                           const std::vector<PatchId>& wanted);

}  // namespace meniscus::fem
