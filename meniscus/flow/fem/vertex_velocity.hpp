#pragma once

#include "meniscus/flow/fem/node_positions.hpp"

namespace meniscus::fem {

/// Velocity with which the vertices of an interface move [G R0]. P1: that of their nodes. P2: the
/// quadratic function of tangent-plane coordinates that fits the mid-edge nodes of the faces around
/// a vertex best (weights 1/distance²), at the vertex.
///
/// The flux through a quadratic face weighs its mid-edge nodes alone: incompressibility holds them
/// and leaves the corners free. The quadratic surface of tension is too blunt at the vertices. So
/// tension pulls them inward everywhere, by some 1e-3/Ca at 110 vertices. The middles are rid of
/// it. Where they do not determine the fit, the vertex's own velocity is taken.
[[nodiscard]] VertexField<Vec3> vertex_velocity(const SurfaceMesh& surface,
                                                const FaceNodeTable& faces,
                                                const NodePositions& positions,
                                                const Field<NodeId, Vec3>& v);

}  // namespace meniscus::fem
