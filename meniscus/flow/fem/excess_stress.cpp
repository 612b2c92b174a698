#include "meniscus/flow/fem/excess_stress.hpp"

#include "meniscus/flow/fem/cell_state.hpp"

namespace meniscus::fem {
namespace {

template <class Element>
void add_cells(const StokesProblem& problem, const StokesState& state, Element& element,
               std::vector<Mat3>& excess) {
  for (const CellId c : problem.mesh.cells.ids()) {
    if (problem.law(c) == nullptr) continue;
    const CellState<Element> cell(problem.space, state, c);
    Mat3& sum = excess[static_cast<std::size_t>(problem.mesh.region[c].value)];
    for (const auto& point : element.points(c)) {
      const Mat3 gradient = cell.velocity_gradient(point);
      const double difference = viscosity_at(problem, c, gradient) - problem.viscosity[c];
      sum += 2.0 * point.weight * difference * rate_of_strain(gradient);
    }
  }
}

}  // namespace

std::vector<Mat3> excess_stress(const StokesProblem& problem, const StokesState& state) {
  if (!problem.is_generalised()) return {};
  std::vector<Mat3> excess(static_cast<std::size_t>(problem.laws.size()), Mat3::Zero());
  with_element(problem.space, problem.positions,
               [&](auto& element) { add_cells(problem, state, element, excess); });
  return excess;
}

}  // namespace meniscus::fem
