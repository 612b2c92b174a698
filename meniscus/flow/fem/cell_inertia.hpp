#pragma once
// Private header of the products of cells: what inertia does, cell by cell.

#include <span>
#include <vector>

#include "meniscus/flow/fem/cell_lanes.hpp"
#include "meniscus/flow/fem/elements.hpp"

namespace meniscus::fem::lanes {

/// The matrices of eight cells. Aligned for the widest vectors, as what it is made of is not.
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

  MENISCUS_INLINE void add(const StraightCells& cells, std::size_t n, const Nodal& v,
                           Nodal& r) const {
    const Lanes scale = 20.0 * rate * cells.volume * density[n].of;
    for (std::size_t i = 0; i < 10; ++i) {
      Lanes3 sum = {};
      for (std::size_t j = 0; j < 10; ++j)
        for (std::size_t k = 0; k < 3; ++k) sum[k] += kQuadraticMass[i][j] * v[j][k];
      for (std::size_t k = 0; k < 3; ++k) r[i][k] += scale * sum[k];
    }
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
  lanes::CellSquares straight, curved;
};

}  // namespace meniscus::fem
