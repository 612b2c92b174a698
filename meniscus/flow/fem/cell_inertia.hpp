#pragma once
// Private header of the products of cells: what inertia does, cell by cell.

#include <span>

#include "meniscus/flow/fem/cell_lanes.hpp"
#include "meniscus/flow/fem/elements.hpp"

namespace meniscus::fem::lanes {

/// The matrices of four cells. Aligned for the widest vectors, as what it is made of is not.
struct alignas(64) Square {
  std::array<std::array<Lanes, 10>, 10> entry;
};
struct alignas(64) Density {
  Lanes of;
};

/// Adds what the matrices of cells make of a velocity, which is the same for its components.
MENISCUS_INLINE void add_product(const Square& m, const Nodal& v, Nodal& r) {
  for (std::size_t i = 0; i < 10; ++i)
    for (std::size_t j = 0; j < 10; ++j)
      for (std::size_t k = 0; k < 3; ++k) r[i][k] += m.entry[i][j] * v[j][k];
}

/// Nothing beside the stresses.
struct NoInertia {
  template <class Batch>
  MENISCUS_INLINE void add(const Batch&, std::size_t, const Nodal&, Nodal&) const {}
};

/// A matrix for each cell.
struct CellSquares {
  std::span<const Square> matrices;

  template <class Batch>
  MENISCUS_INLINE void add(const Batch&, std::size_t n, const Nodal& v, Nodal& r) const {
    add_product(matrices[n], v, r);
  }
};

/// The masses of straight cells, which are multiples of one another: density times a rate.
struct StraightMasses {
  std::span<const Density> density;
  double rate = 0.0;

  /// 420 times `kQuadraticMass`, by sums. It is 5v_k + Σv + 2Σ_k v_e − 6Σv_e at a corner k. At an
  /// edge e of the corners i and j it is 16v_e − 8v_o + 16Σv_e − 6Σv + 2(v_i + v_j), o = 5 − e
  /// opposite to e. Σv and Σv_e are sums over corners and edges, Σ_k one over the edges at k.
  MENISCUS_INLINE void add(const StraightCells& cells, std::size_t n, const Nodal& v,
                           Nodal& r) const {
    const Lanes scale = 20.0 / 420.0 * rate * cells.volume * density[n].of;
    for (std::size_t k = 0; k < 3; ++k) {
      const Lanes corners = v[0][k] + v[1][k] + v[2][k] + v[3][k];
      const Lanes edges = v[4][k] + v[5][k] + v[6][k] + v[7][k] + v[8][k] + v[9][k];
      std::array<Lanes, 4> at_corner;
      for (std::size_t i = 0; i < 4; ++i) at_corner[i] = 5.0 * v[i][k] + corners - 6.0 * edges;
      for (std::size_t e = 0; e < 6; ++e) {
        const auto [i, j] = kCellEdges[e];
        at_corner[i] += 2.0 * v[4 + e][k];
        at_corner[j] += 2.0 * v[4 + e][k];
        r[4 + e][k] += scale * (16.0 * (v[4 + e][k] + edges) - 8.0 * v[9 - e][k] - 6.0 * corners +
                                2.0 * (v[i][k] + v[j][k]));
      }
      for (std::size_t i = 0; i < 4; ++i) r[i][k] += scale * at_corner[i];
    }
  }
};

/// Values at the points of the rule: four near the corners, four more, and six near the edges, in
/// the order of `kCellEdges`.
using AtPoints = std::array<Lanes3, kTetrahedronRule5.size()>;

/// Points that are near corners or edges alike: the barycentric coordinate b of what they are near,
/// and that of the other corners.
struct Orbit {
  std::size_t first;
  double near = kTetrahedronRule5[first].barycentric[0],
         other = kTetrahedronRule5[first].barycentric[3];
  /// b(2b − 1) of the other corners, and how much more it is of the near ones.
  double corner = other * (2.0 * other - 1.0), near_corner = near * (2.0 * near - 1.0) - corner;
};
inline constexpr std::array<Orbit, 2> kCornerOrbits = {Orbit{0}, Orbit{4}};
inline constexpr Orbit kEdgeOrbit{8};

/// Sums of values at the nodes: of corners, of edges, and of the edges at each corner.
struct NodeSums {
  Lanes corners, edges;
  Corners edges_at;
};
MENISCUS_INLINE NodeSums sums_of(const Nodal& v, std::size_t k) {
  NodeSums sums;
  sums.corners = v[0][k] + v[1][k] + v[2][k] + v[3][k];
  sums.edges_at = {v[4][k] + v[5][k] + v[6][k], v[4][k] + v[7][k] + v[8][k],
                   v[5][k] + v[7][k] + v[9][k], v[6][k] + v[8][k] + v[9][k]};
  sums.edges = sums.edges_at[0] + v[7][k] + v[8][k] + v[9][k];
  return sums;
}

/// Σ_i φ_i v_i at the points: φ_k = b_k(2b_k − 1) at corners, 4b_ib_j at edges.
MENISCUS_INLINE void find_at_points(const Nodal& v, AtPoints& at) {
  for (std::size_t k = 0; k < 3; ++k) {
    const NodeSums sums = sums_of(v, k);
    for (const auto& [first, near, other, corner, near_corner] : kCornerOrbits) {
      const Lanes base = corner * sums.corners + (4.0 * other * other) * sums.edges;
      for (std::size_t i = 0; i < 4; ++i)
        at[first + i][k] =
            base + near_corner * v[i][k] + (4.0 * other * (near - other)) * sums.edges_at[i];
    }
    const auto& [first, near, other, corner, near_corner] = kEdgeOrbit;
    const Lanes base = corner * sums.corners + (4.0 * near * other) * sums.edges;
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [i, j] = kCellEdges[e];
      at[first + e][k] = base + near_corner * (v[i][k] + v[j][k]) +
                         (4.0 * (near - other)) * (near * v[4 + e][k] - other * v[9 - e][k]);
    }
  }
}

/// Values at the points of one component.
using ComponentAtPoints = std::array<Lanes, kTetrahedronRule5.size()>;

/// The transpose of `find_at_points` for component k, added.
MENISCUS_INLINE void add_to_nodes(const ComponentAtPoints& at, std::size_t k, Nodal& r) {
  Lanes to_corners = {}, to_edges = {};
  for (const auto& [first, near, other, corner, near_corner] : kCornerOrbits) {
    const Lanes sum = at[first] + at[first + 1] + at[first + 2] + at[first + 3];
    to_corners += corner * sum;
    to_edges += (4.0 * other * other) * sum;
    for (std::size_t i = 0; i < 4; ++i) r[i][k] += near_corner * at[first + i];
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [i, j] = kCellEdges[e];
      r[4 + e][k] += (4.0 * other * (near - other)) * (at[first + i] + at[first + j]);
    }
  }
  const auto& [first, near, other, corner, near_corner] = kEdgeOrbit;
  Lanes sum = {};
  for (std::size_t e = 0; e < 6; ++e) sum += at[first + e];
  to_corners += corner * sum;
  to_edges += (4.0 * near * other) * sum;
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [i, j] = kCellEdges[e];
    r[i][k] += near_corner * at[first + e];
    r[j][k] += near_corner * at[first + e];
    r[4 + e][k] +=
        to_edges + (4.0 * (near - other)) * (near * at[first + e] - other * at[first + 5 - e]);
  }
  for (std::size_t i = 0; i < 4; ++i) r[i][k] += to_corners;
}

/// Σ_l a_l s_l at the points, s_l linear functions that are given at the corners.
MENISCUS_INLINE ComponentAtPoints sums_of_slopes(const AtPoints& along,
                                                 const std::array<Corners, 3>& slopes) {
  ComponentAtPoints result;
  Lanes3 sum;
  for (std::size_t l = 0; l < 3; ++l)
    sum[l] = slopes[l][0] + slopes[l][1] + slopes[l][2] + slopes[l][3];
  for (const auto& [first, near, other, corner, near_corner] : kCornerOrbits)
    for (std::size_t i = 0; i < 4; ++i) {
      const Lanes3& a = along[first + i];
      const auto by = [&](std::size_t l) {
        return a[l] * (other * sum[l] + (near - other) * slopes[l][i]);
      };
      result[first + i] = by(0) + by(1) + by(2);
    }
  const auto& [first, near, other, corner, near_corner] = kEdgeOrbit;
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [i, j] = kCellEdges[e];
    const Lanes3& a = along[first + e];
    const auto by = [&](std::size_t l) {
      return a[l] * (other * sum[l] + (near - other) * (slopes[l][i] + slopes[l][j]));
    };
    result[first + e] = by(0) + by(1) + by(2);
  }
  return result;
}

/// ρa times the weights of the points, and the derivatives that go with its components. They are by
/// x in straight cells, by barycentric coordinates in curved ones.
MENISCUS_INLINE void weigh(const StraightCells& cells, const Lanes& density, AtPoints& a,
                           Derivatives& d) {
  const Lanes scale = 20.0 * cells.volume * density;
  for (std::size_t q = 0; q < a.size(); ++q)
    for (std::size_t k = 0; k < 3; ++k) a[q][k] *= kTetrahedronRule5[q].share * scale;
  for (Tensor& at_corner : d) {
    const Tensor gradient = gradient_of(at_corner, cells.gradient);
    for (std::size_t l = 0; l < 3; ++l)
      for (std::size_t k = 0; k < 3; ++k) at_corner[l][k] = gradient[k][l];
  }
}
MENISCUS_INLINE void weigh(const CurvedCells& cells, const Lanes& density, AtPoints& a,
                           Derivatives&) {
  for (std::size_t q = 0; q < a.size(); ++q) {
    const auto& [g, weight] = cells.points[q];
    const Lanes scale = weight * density;
    Lanes3 along;
    for (std::size_t l = 0; l < 3; ++l)
      along[l] = scale * (a[q][0] * g[l][0] + a[q][1] * g[l][1] + a[q][2] * g[l][2]);
    a[q] = along;
  }
}

/// Adds ∫ρφ_i a·∇v, a given at the nodes.
template <class Batch>
MENISCUS_INLINE void add_convection(const Batch& cells, const Lanes& density, const Nodal& a,
                                    const Nodal& v, Nodal& r) {
  AtPoints along;
  find_at_points(a, along);
  Derivatives d;
  differentiate(v, d);
  weigh(cells, density, along, d);
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<Corners, 3> slopes;
    for (std::size_t l = 0; l < 3; ++l)
      slopes[l] = {d[0][l][k], d[1][l][k], d[2][l][k], d[3][l][k]};
    add_to_nodes(sums_of_slopes(along, slopes), k, r);
  }
}

/// Masses and convection, by a velocity at the nodes.
template <class Masses>
struct WithConvection {
  Masses masses;
  std::span<const Density> density;
  const double* convecting;

  template <class Batch>
  MENISCUS_INLINE void add(const Batch& cells, std::size_t n, const Nodal& v, Nodal& r) const {
    masses.add(cells, n, v, r);
    Nodal a;
    take(cells.nodes, convecting, a);
    add_convection(cells, density[n].of, a, v, r);
  }
};

}  // namespace meniscus::fem::lanes

namespace meniscus::fem {

/// What inertia does by cells, without convection and with it.
struct CellInertia {
  lanes::StraightMasses straight;
  lanes::CellSquares curved;
};
struct ConvectedCells {
  lanes::WithConvection<lanes::StraightMasses> straight;
  lanes::WithConvection<lanes::CellSquares> curved;
};

}  // namespace meniscus::fem
