#pragma once

#include <string>

#include "meniscus/flow/fem/constraints.hpp"
#include "meniscus/flow/fem/node_positions.hpp"
#include "meniscus/scene/scene.hpp"

namespace meniscus::fem {

/// The conditions of the outer boundary's patches at one instant, by node of the velocity.
struct BoundaryConditions {
  Constraints constraints;
  Field<NodeId, Vec3> traction;  ///< ∫φ t dS of the open patches [μ_out G R0²]
  bool has_open_patch = false;
  std::string failure;  ///< why there is no flow under these conditions; empty if there is
};

/// Where patches meet, a node obeys ImposedVelocity first (that of the lowest patch id), then every
/// NoPenetration. Without an open patch imposed velocities that are not the linear flow lose their
/// net flux through the boundary's elements along the nodes' area vectors, as interpolated data
/// have one of O(h²) or, on quadratic elements, O(h³).
[[nodiscard]] BoundaryConditions boundary_conditions(const OuterBoundary& boundary,
                                                     const FaceNodeTable& faces,
                                                     const NodePositions& positions, double t);

/// Unit normals of the flat pieces that the given patches have at each node of a surface: faces of
/// one patch whose normals lie within 40° of each other make one piece, whose normal is that of its
/// area vector.
[[nodiscard]] Field<NodeId, std::vector<Vec3>> piece_normals(const OuterBoundary& boundary,
                                                             const std::vector<PatchId>& wanted,
                                                             const FaceNodeTable& faces,
                                                             std::int32_t num_nodes);

}  // namespace meniscus::fem
