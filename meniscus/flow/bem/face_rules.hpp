#pragma once

#include <array>
#include <cmath>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/bem/interface_elements.hpp"

namespace meniscus::bem {

// Points at which integrands that are singular at a point x are taken on a face. Each is handed on
// as visit(barycentric coordinates, y, n dS), the three of std::array<double, 3>, Vec3 and Vec3.

namespace detail {

/// Largest size of a part over its distance. The seven-point rule then integrates the kernels of
/// both layers to about 1e-4 of their size.
inline constexpr double kSizePerDistance = 1.0;
/// Parts of 6e-5 of the face: surfaces that all but touch.
inline constexpr int kMostQuarterings = 14;

using FacePart = std::array<Vec3, 3>;  // barycentric corners of a part of a face

inline bool is_small_beside(double size, double distance) {
  return size <= kSizePerDistance * distance;
}

template <class Visit>
void visit_point(const InterfaceElements::Face& face, const QuadraturePoint<3>& point,
                 const Visit& visit) {
  const TriangleShape<kQuadraticNodes> shape = quadratic_shape(point.barycentric);
  visit(point.barycentric, weighted_sum(shape.value, face.nodes),
        point.share * tangents(shape, face.nodes).area());
}

template <class Visit>
void visit_part(const InterfaceElements::Face& face, const FacePart& b, int depth, const Vec3& x,
                const Visit& visit) {
  const Vec3 middle = (b[0] + b[1] + b[2]) / 3.0;
  const Vec3 at = weighted_sum(quadratic_values({middle[0], middle[1], middle[2]}), face.nodes);
  const double size = std::ldexp(face.size, -depth), distance = (at - x).norm();
  if (!is_small_beside(size, distance) && depth < kMostQuarterings) {
    const FacePart half = {0.5 * (b[1] + b[2]), 0.5 * (b[2] + b[0]), 0.5 * (b[0] + b[1])};
    for (const FacePart& part : {FacePart{b[0], half[2], half[1]}, FacePart{half[2], b[1], half[0]},
                                 FacePart{half[1], half[0], b[2]}, half})
      visit_part(face, part, depth + 1, x, visit);
    return;
  }
  const double share = std::ldexp(1.0, -2 * depth);
  for (const auto& [w, part] : kTriangleRule5) {
    const Vec3 at_point = w[0] * b[0] + w[1] * b[1] + w[2] * b[2];
    visit_point(face, {{at_point[0], at_point[1], at_point[2]}, share * part}, visit);
  }
}

}  // namespace detail

/// For x a vertex of the face itself (`corner` 0, 1, 2).
template <class Visit>
void visit_corner_points(const InterfaceElements::Face& face, std::size_t corner,
                         const Visit& visit) {
  MENISCUS_ASSERT(corner < 3, "corner {}", corner);
  for (const QuadraturePoint<3>& point : corner_rule(corner))
    detail::visit_point(face, point, visit);
}

/// For x off the face, which is quartered until every part is small beside its distance. So the
/// error is about the same at any distance.
template <class Visit>
void visit_near_points(const InterfaceElements::Face& face, const Vec3& x, const Visit& visit) {
  // The first point is the middle.
  if (detail::is_small_beside(face.size, (face.points[0].x - x).norm())) {
    for (std::size_t q = 0; q < face.points.size(); ++q)
      visit(kTriangleRule5[q].barycentric, face.points[q].x, face.points[q].area);
    return;
  }
  detail::visit_part(face, {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}, 0, x, visit);
}

/// For x the vertex `corner` of the face, or off the face where `corner` is 3.
template <class Visit>
void visit_points(const InterfaceElements::Face& face, std::size_t corner, const Vec3& x,
                  const Visit& visit) {
  if (corner < 3)
    visit_corner_points(face, corner, visit);
  else
    visit_near_points(face, x, visit);
}

}  // namespace meniscus::bem
