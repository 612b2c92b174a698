#pragma once

#include <memory>

#include "meniscus/flow/fem/options.hpp"
#include "meniscus/flow/scalar_solver.hpp"

namespace meniscus::bulk {

/// Bulk scalars by finite elements of the kind that the flow's velocity has. Every process does all
/// the work, and gets the same bits.
[[nodiscard]] std::unique_ptr<ScalarSolver> make_finite_element_scalars(fem::Elements elements);

}  // namespace meniscus::bulk
