#pragma once

#include <array>
#include <cstddef>

namespace meniscus::fem {

/// A point of a rule on the tetrahedron or triangle: barycentric coordinates, and the share of the
/// volume or area it stands for.
template <std::size_t Corners>
struct RulePoint {
  std::array<double, Corners> barycentric;
  double share;
};

/// Degree 2 on tetrahedra, 4 points (hammer1956): exact for the products of gradients of a
/// quadratic function where the cell is straight.
inline constexpr std::array<RulePoint<4>, 4> kStraightCellRule = [] {
  constexpr double a = 0.138196601125010515, b = 1.0 - 3.0 * a;  // (5 − √5)/20
  std::array<RulePoint<4>, 4> rule{};
  for (std::size_t q = 0; q < 4; ++q) {
    rule[q] = {{a, a, a, a}, 0.25};
    rule[q].barycentric[q] = b;
  }
  return rule;
}();

/// Degree 5 on tetrahedra, 14 points (walkington2000): exact for the divergence in curved cells, of
/// degree 4.
inline constexpr std::array<RulePoint<4>, 14> kCurvedCellRule = [] {
  std::array<RulePoint<4>, 14> rule{};
  std::size_t q = 0;
  constexpr std::array<std::array<double, 2>, 2> vertex_orbits = {
      {{0.310885919263300610, 0.112687925718015851},
       {0.0927352503108912264, 0.0734930431163619495}}};
  for (const auto& [a, share] : vertex_orbits)
    for (std::size_t k = 0; k < 4; ++k, ++q) {
      rule[q] = {{a, a, a, a}, share};
      rule[q].barycentric[k] = 1.0 - 3.0 * a;
    }
  constexpr double a = 0.0455037041256496495, share = 0.0425460207770814664;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j, ++q) {
      rule[q] = {{a, a, a, a}, share};
      rule[q].barycentric[i] = rule[q].barycentric[j] = 0.5 - a;
    }
  return rule;
}();

/// Degree 6 on triangles, 12 points (dunavant1985): exact for a quadratic function times a
/// quadratic one times the area vector of a curved face.
inline constexpr std::array<RulePoint<3>, 12> kFaceRule = [] {
  std::array<RulePoint<3>, 12> rule{};
  std::size_t q = 0;
  constexpr std::array<std::array<double, 2>, 2> orbits = {
      {{0.249286745170910421, 0.116786275726379366},
       {0.0630890144915022283, 0.0508449063702068170}}};
  for (const auto& [a, share] : orbits)
    for (std::size_t k = 0; k < 3; ++k, ++q) {
      rule[q] = {{a, a, a}, share};
      rule[q].barycentric[k] = 1.0 - 2.0 * a;
    }
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

}  // namespace meniscus::fem
