#include "meniscus/flow/fem/edge_integrals.hpp"

#include "meniscus/core/vector_clones.hpp"
#include "meniscus/flow/fem/elements.hpp"

namespace meniscus::fem {
namespace {

using PerCell = CellBatch::PerCell<double>;
using PerCell3 = std::array<PerCell, 3>;
using OfCells = std::array<EdgeIntegrals<PerCell>, 6>;

/// A vector of plain numbers, which compilers vectorise across cells; they do not with Eigen's.
struct Vector {
  double x, y, z;
  friend Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vector operator*(double s, Vector a) { return {s * a.x, s * a.y, s * a.z}; }
  friend double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend Vector cross(Vector a, Vector b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
};
Vector get(const PerCell3& from, std::size_t m) { return {from[0][m], from[1][m], from[2][m]}; }
void put(PerCell3& to, std::size_t m, Vector value) {
  to[0][m] = value.x;
  to[1][m] = value.y;
  to[2][m] = value.z;
}

MENISCUS_VECTOR_CLONES
void integrate(const CellBatch& cells, OfCells& integrals) {
  std::array<PerCell3, 4> gradient;
  PerCell viscous, stabilisation, mass, eighth;  // μV, τV, V/12μ, V/8
  for (std::size_t m = 0; m < CellBatch::size; ++m) {
    const BarycentricTetrahedron<Vector> tet =
        linear_tetrahedron<Vector>({get(cells.corner[0], m), get(cells.corner[1], m),
                                    get(cells.corner[2], m), get(cells.corner[3], m)});
    for (std::size_t k = 0; k < 4; ++k) put(gradient[k], m, tet.gradient[k]);
    const double volume = tet.volume, viscosity = cells.viscosity[m];
    viscous[m] = viscosity * volume;
    stabilisation[m] = volume * pspg_parameter(volume, viscosity);
    mass[m] = volume / (12.0 * viscosity);
    eighth[m] = 0.125 * volume;
  }
  for (std::size_t k = 0; k < 6; ++k) {
    const PerCell3 &at_a = gradient[kCellEdges[k][0]], &at_b = gradient[kCellEdges[k][1]];
    EdgeIntegrals<PerCell>& edge = integrals[k];
    for (std::size_t m = 0; m < CellBatch::size; ++m) {
      const Vector a = get(at_a, m), b = get(at_b, m);
      const double half = 0.5 * viscous[m],
                   turned = cells.edge[k][m] % 2 != 0 ? -eighth[m] : eighth[m];
      edge.xx[m] = viscous[m] * (a.x * b.x);
      edge.yy[m] = viscous[m] * (a.y * b.y);
      edge.zz[m] = viscous[m] * (a.z * b.z);
      edge.stabilisation[m] = stabilisation[m] * dot(a, b);
      edge.xy[m] = half * (a.x * b.y + a.y * b.x);
      edge.xz[m] = half * (a.x * b.z + a.z * b.x);
      edge.yz[m] = half * (a.y * b.z + a.z * b.y);
      edge.mass[m] = mass[m];
      edge.x[m] = turned * (a.x - b.x);
      edge.y[m] = turned * (a.y - b.y);
      edge.z[m] = turned * (a.z - b.z);
      edge.unused[m] = 0.0;
    }
  }
}

/// Four numbers as one, wherever they are.
using Four [[gnu::vector_size(32), gnu::aligned(8), gnu::may_alias]] = double;

/// Four cells at a time: four of their integrals are a 4 × 4 matrix. It is turned over, so that
/// each cell's are side by side, as in the sums.
MENISCUS_VECTOR_CLONES
void add(const OfCells& integrals, const std::array<CellBatch::PerCell<std::int32_t>, 6>& edge,
         EdgeIntegrals<double>* sums) {
  for (std::size_t m = 0; m < CellBatch::size; m += 4)
    for (std::size_t k = 0; k < 6; ++k)
      for (std::size_t part = 0; part < 3; ++part) {
        const PerCell* const row = &integrals[k].xx + 4 * part;
        const auto &r0 = reinterpret_cast<const Four&>(row[0][m]),
                   &r1 = reinterpret_cast<const Four&>(row[1][m]),
                   &r2 = reinterpret_cast<const Four&>(row[2][m]),
                   &r3 = reinterpret_cast<const Four&>(row[3][m]);
        const Four even = __builtin_shufflevector(r0, r1, 0, 4, 2, 6),
                   odd = __builtin_shufflevector(r0, r1, 1, 5, 3, 7),
                   even_below = __builtin_shufflevector(r2, r3, 0, 4, 2, 6),
                   odd_below = __builtin_shufflevector(r2, r3, 1, 5, 3, 7);
        const auto sum = [&](std::size_t n) -> Four& {
          return reinterpret_cast<Four*>(sums + edge[k][m + n] / 2)[part];
        };
        sum(0) += __builtin_shufflevector(even, even_below, 0, 1, 4, 5);
        sum(1) += __builtin_shufflevector(odd, odd_below, 0, 1, 4, 5);
        sum(2) += __builtin_shufflevector(even, even_below, 2, 3, 6, 7);
        sum(3) += __builtin_shufflevector(odd, odd_below, 2, 3, 6, 7);
      }
}

}  // namespace

void CellBatch::add_to(std::span<EdgeIntegrals<double>> sums) const {
  OfCells integrals;
  integrate(*this, integrals);
  add(integrals, edge, sums.data());
}

}  // namespace meniscus::fem
