#pragma once

#include <memory>
#include <vector>

#include "meniscus/mesh/surface_mesh.hpp"
#include "meniscus/mesh/surface_tree.hpp"

namespace meniscus {

/// The velocity with which a set of surfaces moves, known at the vertices of each and read at any
/// point near them. It is that of the nearest point, linear on its face. So it outlives a remeshing
/// of the surfaces. Search trees are built at the first question.
class SurfaceMotion {
 public:
  /// Adds a surface with the velocities of its vertices [G R0].
  void add(SurfaceMesh mesh, VertexField<Vec3> velocity);
  /// Velocity at the nearest point of all surfaces; zero when there is none.
  [[nodiscard]] Vec3 at(const Vec3& x) const;
  /// Whether no motion is known: necks then count as thinning, and gaps as closing.
  [[nodiscard]] bool is_unknown() const { return surfaces_.empty(); }

 private:
  struct Surface {
    SurfaceMesh mesh;
    VertexField<Vec3> velocity;
    std::shared_ptr<const SurfaceTree> tree;
  };
  mutable std::vector<Surface> surfaces_;
};

}  // namespace meniscus
