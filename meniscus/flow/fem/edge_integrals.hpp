#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace meniscus::fem {

/// What linear tetrahedra give to the matrices at an edge from a to b. Left out is what cancels
/// between the cells around it (see `EdgeSums`). Each is a number, or one per cell of several.
template <class T>
struct alignas(32) EdgeIntegrals {
  T xx, yy, zz, stabilisation;  ///< of Σ μV g_a g_bᵀ; Σ τV g_a·g_b
  T xy, xz, yz, mass;           ///< of the former's symmetric part; Σ V/12μ
  T x, y, z, unused;            ///< of Σ V/8 (g_a − g_b)
};

/// Several linear tetrahedra, quantity by quantity, so that an instruction works on several cells.
struct alignas(64) CellBatch {
  static constexpr std::size_t size = 16;
  template <class T>
  using PerCell = std::array<T, size>;

  std::array<std::array<PerCell<double>, 3>, 4> corner;  ///< [R0]
  PerCell<double> viscosity;                             ///< [μ_out]
  /// 2·edge + whether it is seen from its end, by edges as in `kCellEdges`.
  std::array<PerCell<std::int32_t>, 6> edge;

  /// Adds the integrals over the cells to those of their edges.
  void add_to(std::span<EdgeIntegrals<double>> sums) const;
};

}  // namespace meniscus::fem
