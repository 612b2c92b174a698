#include "meniscus/flow/fem/excess_stress.hpp"

#include <algorithm>
#include <limits>

#include "meniscus/flow/fem/cell_state.hpp"

namespace meniscus::fem {
namespace {

template <class Element>
void add_cells(const StokesProblem& problem, const StokesState& state, Element& element,
               GeneralisedLiquids& liquids) {
  for (const CellId c : problem.mesh.cells.ids()) {
    const auto region = static_cast<std::size_t>(problem.mesh.region[c].value);
    double& least = liquids.least_viscosity[region];
    if (problem.law(c) == nullptr) {
      least = problem.viscosity[c];
      continue;
    }
    const CellState<Element> cell(problem.space, state, c);
    for (const auto& point : element.points(c)) {
      const Mat3 gradient = cell.velocity_gradient(point);
      const double viscosity = viscosity_at(problem, c, gradient);
      liquids.excess_stress[region] +=
          2.0 * point.weight * (viscosity - problem.viscosity[c]) * rate_of_strain(gradient);
      least = std::min(least, viscosity);
    }
  }
}

}  // namespace

GeneralisedLiquids generalised_liquids(const StokesProblem& problem, const StokesState& state) {
  if (!problem.is_generalised()) return {};
  const auto num_regions = static_cast<std::size_t>(problem.laws.size());
  GeneralisedLiquids liquids{
      std::vector<Mat3>(num_regions, Mat3::Zero()),
      std::vector<double>(num_regions, std::numeric_limits<double>::infinity())};
  with_element(problem.space, problem.positions,
               [&](auto& element) { add_cells(problem, state, element, liquids); });
  return liquids;
}

}  // namespace meniscus::fem
