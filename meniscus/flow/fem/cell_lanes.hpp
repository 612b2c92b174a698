#pragma once
// Private header of the sources whose functions are compiled for several kinds of processor.

#include <array>
#include <cstddef>
#include <cstdint>

#include "meniscus/core/vector_clones.hpp"
#include "meniscus/geometry/quadrature.hpp"

// GCC 12 takes elements of vectors that are set one by one for uninitialised.
#ifndef __clang__
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

namespace meniscus::fem::lanes {

/// As many as AVX2 has room for. Vectors of eight would go through memory there, at half the speed.
inline constexpr std::size_t kLanes = 4;
/// One number for each of four cells, so that an instruction works on several.
using Lanes [[gnu::vector_size(8 * kLanes)]] = double;
using Lanes3 = std::array<Lanes, 3>;
using Tensor = std::array<Lanes3, 3>;
using Corners = std::array<Lanes, 4>;
using Nodal = std::array<Lanes3, 10>;
/// ∂/∂b_l − ∂/∂b_0 at corner k in [k][l − 1], l = 1, 2, 3, by components.
using Derivatives = std::array<Tensor, 4>;
template <std::size_t Count>
using Numbers = std::array<std::array<std::int32_t, kLanes>, Count>;

/// Which cells four lanes are. The last lanes repeat a cell, of no volume. All that follows is
/// aligned for the widest vectors, whichever the clone.
struct alignas(64) CellNumbers {
  Numbers<10> nodes;
  Numbers<4> pressures;
};
struct StraightCells : CellNumbers {
  Tensor gradient;          // of b_1, b_2, b_3
  Lanes volume, viscosity;  // volume over 20
};
struct CurvedPoint {
  Tensor gradient;  // of b_1, b_2, b_3
  Lanes weight;
};
struct CurvedCells : CellNumbers {
  std::array<CurvedPoint, kTetrahedronRule5.size()> points;
  Lanes viscosity;
};

/// The local node between two corners.
inline constexpr std::array<std::array<std::size_t, 4>, 4> kBetween = {
    {{0, 4, 5, 6}, {4, 1, 7, 8}, {5, 7, 2, 9}, {6, 8, 9, 3}}};

/// The derivatives at the corners: ∂v/∂b_k = 3v_k at corner k, and ∂v/∂b_l = 4v_kl − v_l.
MENISCUS_INLINE void differentiate(const Nodal& v, Derivatives& d) {
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t a = 0; a < 3; ++a) {
      const auto by = [&](std::size_t l) {
        return k == l ? 3.0 * v[k][a] : 4.0 * v[kBetween[k][l]][a] - v[l][a];
      };
      const Lanes first = by(0);
      for (std::size_t l = 1; l < 4; ++l) d[k][l - 1][a] = by(l) - first;
    }
}

/// The transpose of `differentiate`.
MENISCUS_INLINE void differentiate_back(const Derivatives& d, Nodal& r) {
  r = {};
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t a = 0; a < 3; ++a) {
      const Lanes3 by = {d[k][0][a], d[k][1][a], d[k][2][a]};
      for (std::size_t l = 0; l < 4; ++l) {
        const Lanes part = l == 0 ? -(by[0] + by[1] + by[2]) : by[l - 1];
        if (k == l) {
          r[k][a] += 3.0 * part;
        } else {
          r[kBetween[k][l]][a] += 4.0 * part;
          r[l][a] -= part;
        }
      }
    }
}

/// ∂v_a/∂x_b from the derivatives by barycentric coordinates.
MENISCUS_INLINE Tensor gradient_of(const Tensor& by, const Tensor& g) {
  Tensor result;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b)
      result[a][b] = by[0][a] * g[0][b] + by[1][a] * g[1][b] + by[2][a] * g[2][b];
  return result;
}

/// S∇b_l by l.
MENISCUS_INLINE Tensor on_gradients(const Tensor& S, const Tensor& g) {
  Tensor result;
  for (std::size_t l = 0; l < 3; ++l)
    for (std::size_t a = 0; a < 3; ++a)
      result[l][a] = S[a][0] * g[l][0] + S[a][1] * g[l][1] + S[a][2] * g[l][2];
  return result;
}

MENISCUS_INLINE Lanes dot(const Lanes3& a, const Lanes3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The gradients of the four barycentric coordinates from those of the last three.
MENISCUS_INLINE std::array<Lanes3, 4> all_gradients(const Tensor& g) {
  Lanes3 first;
  for (std::size_t a = 0; a < 3; ++a) first[a] = -(g[0][a] + g[1][a] + g[2][a]);
  return {first, g[0], g[1], g[2]};
}

/// Σ_k b_k of what is given by corners.
MENISCUS_INLINE Lanes at_point(const std::array<double, 4>& b, const Corners& of) {
  return b[0] * of[0] + b[1] * of[1] + b[2] * of[2] + b[3] * of[3];
}
MENISCUS_INLINE Tensor at_point(const std::array<double, 4>& b, const Derivatives& d) {
  Tensor result;
  for (std::size_t l = 0; l < 3; ++l)
    for (std::size_t a = 0; a < 3; ++a)
      result[l][a] = at_point(b, Corners{d[0][l][a], d[1][l][a], d[2][l][a], d[3][l][a]});
  return result;
}

MENISCUS_INLINE Lanes3 cross(const Lanes3& a, const Lanes3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// The gradients of barycentric coordinates at a point are the inverse of ∂x/∂b, whose determinant
/// is six times the volume that the weights share out.
MENISCUS_INLINE void set_point(const QuadraturePoint<4>& at, const Derivatives& d,
                               CurvedPoint& to) {
  const Tensor by = at_point(at.barycentric, d);
  const Tensor normals = {cross(by[1], by[2]), cross(by[2], by[0]), cross(by[0], by[1])};
  const Lanes determinant = dot(by[0], normals[0]), inverse = 1.0 / determinant;
  for (std::size_t l = 0; l < 3; ++l)
    for (std::size_t a = 0; a < 3; ++a) to.gradient[l][a] = inverse * normals[l][a];
  to.weight = (at.share / 6.0) * determinant;
}

MENISCUS_INLINE Lanes trace(const Tensor& t) { return t[0][0] + t[1][1] + t[2][2]; }

MENISCUS_INLINE void add_to(Tensor& to, const Tensor& t) {
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) to[a][b] += t[a][b];
}

/// The numbers that stand so many places apart from the first of each lane.
MENISCUS_INLINE void take(const std::array<const double*, kLanes>& first, std::size_t a,
                          Lanes& to) {
  to = Lanes{first[0][a], first[1][a], first[2][a], first[3][a]};
}
template <std::size_t Components, std::size_t Count>
MENISCUS_INLINE std::array<const double*, kLanes> places(const Numbers<Count>& numbers,
                                                         std::size_t i, const double* values) {
  std::array<const double*, kLanes> result;
  for (std::size_t m = 0; m < kLanes; ++m)
    result[m] = values + Components * static_cast<std::size_t>(numbers[i][m]);
  return result;
}
MENISCUS_INLINE void take(const Numbers<4>& numbers, const double* from, Corners& to) {
  for (std::size_t i = 0; i < 4; ++i) take(places<1>(numbers, i, from), 0, to[i]);
}
MENISCUS_INLINE void take(const Numbers<10>& nodes, const double* from, Nodal& to) {
  for (std::size_t i = 0; i < 10; ++i) {
    const std::array<const double*, kLanes> first = places<3>(nodes, i, from);
    for (std::size_t a = 0; a < 3; ++a) take(first, a, to[i][a]);
  }
}
MENISCUS_INLINE void give(const Numbers<4>& numbers, const Corners& from, double* to) {
  for (std::size_t m = 0; m < kLanes; ++m)
    for (std::size_t i = 0; i < 4; ++i) to[numbers[i][m]] += from[i][m];
}
MENISCUS_INLINE void give(const Numbers<10>& nodes, const Nodal& from, double* to) {
  for (std::size_t m = 0; m < kLanes; ++m)
    for (std::size_t i = 0; i < 10; ++i) {
      double* const vector = to + std::ptrdiff_t{3} * nodes[i][m];
      for (std::size_t a = 0; a < 3; ++a) vector[a] += from[i][a][m];
    }
}

}  // namespace meniscus::fem::lanes
