#include "meniscus/geometry/predicates.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Intersections_3/Segment_3_Triangle_3.h>
#include <CGAL/Intersections_3/Triangle_3_Triangle_3.h>

namespace meniscus {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 point(const Vec3& x) { return {x.x(), x.y(), x.z()}; }
Kernel::Triangle_3 cgal_triangle(const Triangle& x) {
  return {point(x[0]), point(x[1]), point(x[2])};
}

}  // namespace

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return static_cast<int>(CGAL::orientation(point(a), point(b), point(c), point(d)));
}

bool is_degenerate(const Triangle& x) {
  return CGAL::collinear(point(x[0]), point(x[1]), point(x[2]));
}

bool do_intersect(const Triangle& s, const Triangle& t) {
  return CGAL::do_intersect(cgal_triangle(s), cgal_triangle(t));
}

bool do_intersect(const Triangle& triangle, const Vec3& p, const Vec3& q) {
  return CGAL::do_intersect(cgal_triangle(triangle), Kernel::Segment_3(point(p), point(q)));
}

bool contains(const Triangle& triangle, const Vec3& p) {
  return cgal_triangle(triangle).has_on(point(p));
}

bool is_folded(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return orientation(a, b, c, d) == 0 &&
         CGAL::coplanar_orientation(point(a), point(b), point(c), point(d)) == CGAL::POSITIVE;
}

}  // namespace meniscus
