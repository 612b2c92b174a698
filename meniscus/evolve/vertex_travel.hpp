#pragma once

#include "meniscus/evolve/interface_motion.hpp"
#include "meniscus/mesh/tet_mesh.hpp"

namespace meniscus {

/// Length of the shortest edge at each vertex [R0].
[[nodiscard]] VertexField<double> shortest_edges(const SurfaceMesh& mesh);

/// How far a step moves vertices, each the largest of all vertices.
struct VertexTravel {
  /// Way of a vertex beyond its interface's mean rigid motion, in shortest edges at the vertex.
  double displacement = 0.0;
  /// Way of the liquid relative to the vertex, in shortest edges over what a step aims at
  /// (`aimed_slip`): the shape slides over the mesh.
  double slip = 0.0;
  /// Half of the way by which the sides of a neck come closer, in radii of the neck.
  double neck_loss = 0.0;
};

/// The travel of a step of length dt from `start`. `velocity` is that of the liquid at the
/// vertices.
[[nodiscard]] VertexTravel vertex_travel(const Scene& start, const InterfaceMotion& motion,
                                         std::span<const VertexField<Vec3>> velocity, double dt);

/// max_v dt |v − w|/l_v over the vertices of a volume mesh that move with w, l_v the shortest edge
/// of the tetrahedra at the vertex.
[[nodiscard]] double courant_number(const TetMesh& mesh, const Field<TetVertexId, Vec3>& v,
                                    const Field<TetVertexId, Vec3>& w, double dt);

}  // namespace meniscus
