#pragma once

#include "meniscus/geometry/triangle.hpp"

namespace meniscus {

/// Exact predicates (CGAL's filtered kernel): the answer is that of real arithmetic on the given
/// doubles.

/// Sign of det[b − a, c − a, d − a]: +1, 0 or −1.
[[nodiscard]] int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
/// Whether the corners lie on one line.
[[nodiscard]] bool is_degenerate(const Triangle& triangle);
/// Whether two triangles have a point in common; touching counts.
[[nodiscard]] bool do_intersect(const Triangle& s, const Triangle& t);
/// Whether the segment p q and a triangle have a point in common; touching counts.
[[nodiscard]] bool do_intersect(const Triangle& triangle, const Vec3& p, const Vec3& q);
/// Whether a point lies on a triangle, edges and corners included.
[[nodiscard]] bool contains(const Triangle& triangle, const Vec3& p);
/// Whether the triangles a b c and b a d lie folded on one another. Then they are in one plane, and
/// c and d on the same side of a b.
[[nodiscard]] bool is_folded(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace meniscus
