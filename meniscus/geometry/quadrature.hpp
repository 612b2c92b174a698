#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace meniscus {

/// A point of a rule on the triangle (three corners) or tetrahedron (four). It has barycentric
/// coordinates, and the share of the area or volume it stands for. The shares of a rule sum to 1.
template <std::size_t Corners>
struct QuadraturePoint {
  std::array<double, Corners> barycentric{};
  double share = 0.0;
};

namespace detail {

/// Writes the points that have `a` at all corners but one, and `share` each.
template <std::size_t Corners, std::size_t Count>
constexpr void add_corner_orbit(std::array<QuadraturePoint<Corners>, Count>& rule, std::size_t& q,
                                double a, double share) {
  for (std::size_t k = 0; k < Corners; ++k, ++q) {
    rule[q].barycentric.fill(a);
    rule[q].barycentric[k] = 1.0 - static_cast<double>(Corners - 1) * a;
    rule[q].share = share;
  }
}

}  // namespace detail

/// Degree 4 on triangles, 6 points (dunavant1985): exact for the volume under a quadratic face.
inline constexpr std::array<QuadraturePoint<3>, 6> kTriangleRule4 = [] {
  std::array<QuadraturePoint<3>, 6> rule{};
  std::size_t q = 0;
  detail::add_corner_orbit(rule, q, 0.445948490915964886, 0.223381589678011466);
  detail::add_corner_orbit(rule, q, 0.0915762135097707435, 0.109951743655321868);
  return rule;
}();

/// Degree 5 on triangles, 7 points (radon1948): the kernels of boundary integrals, which are no
/// polynomials, at a distance.
inline constexpr std::array<QuadraturePoint<3>, 7> kTriangleRule5 = [] {
  constexpr double root = 3.87298334620741688518;  // √15
  std::array<QuadraturePoint<3>, 7> rule{};
  rule[0] = {{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}, 9.0 / 40.0};
  std::size_t q = 1;
  detail::add_corner_orbit(rule, q, (6.0 - root) / 21.0, (155.0 - root) / 1200.0);
  detail::add_corner_orbit(rule, q, (6.0 + root) / 21.0, (155.0 + root) / 1200.0);
  return rule;
}();

/// Degree 6 on triangles, 12 points (dunavant1985): exact for a quadratic function times a
/// quadratic one times the area vector of a quadratic face.
inline constexpr std::array<QuadraturePoint<3>, 12> kTriangleRule6 = [] {
  std::array<QuadraturePoint<3>, 12> rule{};
  std::size_t q = 0;
  detail::add_corner_orbit(rule, q, 0.249286745170910421, 0.116786275726379366);
  detail::add_corner_orbit(rule, q, 0.0630890144915022283, 0.0508449063702068170);
  constexpr double a = 0.0531450498448169473, b = 0.310352451033784405;
  constexpr std::array<double, 3> corner = {a, b, 1.0 - a - b};
  constexpr double share = 0.0828510756183735752;
  for (std::size_t k = 0; k < 3; ++k)
    for (const std::size_t turn : {1, 2}) {
      rule[q].barycentric[k] = corner[0];
      rule[q].barycentric[(k + turn) % 3] = corner[1];
      rule[q].barycentric[(k + 3 - turn) % 3] = corner[2];
      rule[q++].share = share;
    }
  return rule;
}();

/// Degree 2 on tetrahedra, 4 points (hammer1956): exact for the products of gradients of a
/// quadratic function where the cell is straight.
inline constexpr std::array<QuadraturePoint<4>, 4> kTetrahedronRule2 = [] {
  std::array<QuadraturePoint<4>, 4> rule{};
  std::size_t q = 0;
  detail::add_corner_orbit(rule, q, 0.138196601125010515, 0.25);  // (5 − √5)/20
  return rule;
}();

/// Degree 5 on tetrahedra, 14 points (walkington2000): exact for the divergence in quadratic cells,
/// of degree 4.
inline constexpr std::array<QuadraturePoint<4>, 14> kTetrahedronRule5 = [] {
  std::array<QuadraturePoint<4>, 14> rule{};
  std::size_t q = 0;
  detail::add_corner_orbit(rule, q, 0.310885919263300610, 0.112687925718015851);
  detail::add_corner_orbit(rule, q, 0.0927352503108912264, 0.0734930431163619495);
  constexpr double a = 0.0455037041256496495, share = 0.0425460207770814664;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j, ++q) {
      rule[q].barycentric.fill(a);
      rule[q].barycentric[i] = rule[q].barycentric[j] = 0.5 - a;
      rule[q].share = share;
    }
  return rule;
}();

/// A point of a rule on [0, 1]; the weights sum to 1.
struct GaussPoint {
  double x = 0.0, weight = 0.0;
};
/// Gauss-Legendre: `count` points, exact to degree 2 count − 1.
[[nodiscard]] std::vector<GaussPoint> gauss_legendre(int count);

/// For integrands like 1/r about a corner of a triangle. Gauss points in (s, t). Barycentric
/// coordinates are 1 − s at the corner, s(1 − t) and st at the next two. The Jacobian s makes the
/// integrands smooth [duffy1982]. 28 points, exact for polynomials of degree 6.
[[nodiscard]] std::span<const QuadraturePoint<3>> corner_rule(std::size_t corner);

}  // namespace meniscus
