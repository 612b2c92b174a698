#pragma once

#include <memory>

#include "meniscus/flow/fem/known_elements.hpp"
#include "meniscus/flow/scalar_solver.hpp"

namespace meniscus::bulk {

/// Bulk scalars by finite elements of the kind that the flow's velocity has. Every process does all
/// the work, and gets the same bits. `elements` are those of the flow.
[[nodiscard]] std::unique_ptr<ScalarSolver> make_finite_element_scalars(
    std::shared_ptr<fem::KnownElements> elements);

}  // namespace meniscus::bulk
