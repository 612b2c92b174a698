#include "meniscus/flow/fem/linear_integrals.hpp"

namespace meniscus::fem {

using namespace lanes;

namespace {

MENISCUS_INLINE void set(const StraightCells& cells, LinearIntegrals& integrals) {
  const std::array<Lanes3, 4> gradients = all_gradients(cells.gradient);
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t l = 0; l < 4; ++l) {
      integrals.gradients[k][l] = 20.0 * cells.volume * dot(gradients[k], gradients[l]);
      integrals.values[k][l] = (k == l ? 2.0 : 1.0) * cells.volume;
    }
}

MENISCUS_INLINE void set(const CurvedCells& cells, LinearIntegrals& integrals) {
  integrals = {};
  for (std::size_t q = 0; q < cells.points.size(); ++q) {
    const std::array<double, 4>& b = kTetrahedronRule5[q].barycentric;
    const std::array<Lanes3, 4> gradients = all_gradients(cells.points[q].gradient);
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t l = k; l < 4; ++l) {
        integrals.gradients[k][l] += cells.points[q].weight * dot(gradients[k], gradients[l]);
        integrals.values[k][l] += (b[k] * b[l]) * cells.points[q].weight;
      }
  }
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t l = 0; l < k; ++l) {
      integrals.gradients[k][l] = integrals.gradients[l][k];
      integrals.values[k][l] = integrals.values[l][k];
    }
}

}  // namespace

MENISCUS_VECTOR_CLONES
void set_linear_integrals(std::span<const StraightCells> cells, const Range& range,
                          LinearIntegrals* integrals) {
  for (std::size_t n = range.begin; n < range.end; ++n) set(cells[n], integrals[n - range.begin]);
}
MENISCUS_VECTOR_CLONES
void set_linear_integrals(std::span<const CurvedCells> cells, const Range& range,
                          LinearIntegrals* integrals) {
  for (std::size_t n = range.begin; n < range.end; ++n) set(cells[n], integrals[n - range.begin]);
}

}  // namespace meniscus::fem
