#pragma once

#include <optional>

#include "meniscus/core/fault.hpp"
#include "meniscus/mesh/surface_mesh.hpp"
#include "meniscus/mesh/surface_tree.hpp"

namespace meniscus {

/// What makes a surface unfit as an interface, with the place. There is none when it is a finite,
/// closed, oriented manifold in one piece that encloses positive volume. It must lack degenerate
/// faces and (exact predicates, CGAL) self-intersection.
[[nodiscard]] std::optional<Fault> find_defect(const SurfaceMesh& mesh);
/// The first face without area.
[[nodiscard]] std::optional<Fault> find_degenerate_face(const SurfaceMesh& mesh);
/// The first place where faces of a closed oriented manifold cross or touch others that they are
/// not joined to (exact predicates). About 0.6 µs per face.
[[nodiscard]] std::optional<Fault> find_self_intersection(const SurfaceMesh& mesh);
/// The first place where two surfaces cross or touch; none if they do not.
[[nodiscard]] std::optional<Fault> find_intersection(const SurfaceMesh& a, const SurfaceMesh& b);
/// The same for finite surfaces, b by its tree, for many others.
[[nodiscard]] std::optional<Fault> find_intersection(const SurfaceMesh& a, const SurfaceTree& b);
/// Whether a point lies inside a closed surface (exact ray shooting); a point on
/// the surface does not.
[[nodiscard]] bool encloses(const SurfaceMesh& mesh, const Vec3& point);
/// Whether a point lies inside the surface of a tree, for many points: about 1 µs each.
[[nodiscard]] bool encloses(const SurfaceTree& tree, const Vec3& point);
/// Smallest distance between the vertices of either surface and the faces of the other [R0].
[[nodiscard]] double smallest_gap(const SurfaceMesh& a, const SurfaceMesh& b);

}  // namespace meniscus
