#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "meniscus/core/fault.hpp"
#include "meniscus/flow/fem/constraints.hpp"
#include "meniscus/flow/fem/node_positions.hpp"
#include "meniscus/scene/scene.hpp"

namespace meniscus::fem {

/// The conditions of the outer boundary's patches at one instant, by node of the velocity.
struct BoundaryConditions {
  Constraints constraints;
  Field<NodeId, Vec3> traction;  ///< ∫φ t dS of the open patches [μ_out G R0²]
  bool has_open_patch = false;
  std::optional<Fault> fault = {};  ///< why there is no flow under these conditions
};

/// Where patches meet, a node obeys ImposedVelocity first (that of the lowest patch id), then every
/// NoPenetration. Interpolated data have a net flux through the boundary's elements of O(h²) or, on
/// quadratic elements, O(h³). Without an open patch it is taken from the nodes that are not of the
/// linear flow. Each gives in proportion to the flux through it and along its area vector. Walls at
/// rest or sliding in their plane keep their velocity exactly.
[[nodiscard]] BoundaryConditions boundary_conditions(const OuterBoundary& boundary,
                                                     const FaceNodeTable& faces,
                                                     const NodePositions& positions, double t);

/// Unit normals by node of a surface, for all nodes one after the other.
struct PieceNormals {
  std::vector<std::int32_t> start = {0};  ///< num_nodes + 1
  std::vector<Vec3> normals;

  [[nodiscard]] std::span<const Vec3> of(NodeId i) const {
    const auto k = static_cast<std::size_t>(i.value);
    return std::span(normals).subspan(static_cast<std::size_t>(start[k]),
                                      static_cast<std::size_t>(start[k + 1] - start[k]));
  }
};

/// Unit normals of the flat pieces that the given patches have at each node of a surface. Faces of
/// one patch whose normals lie within 40° of each other make one piece. Its normal is that of its
/// area vector.
[[nodiscard]] PieceNormals piece_normals(const OuterBoundary& boundary,
                                         const std::vector<PatchId>& wanted,
                                         const FaceNodeTable& faces, std::int32_t num_nodes);

}  // namespace meniscus::fem
