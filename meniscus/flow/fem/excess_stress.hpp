#pragma once

#include <vector>

#include "meniscus/flow/fem/stokes_problem.hpp"

namespace meniscus::fem {

/// ∫2(μ(γ̇) − μ)D over the liquid of each region, by region [μ_out G R0³]. Empty where
/// all are Newtonian.
[[nodiscard]] std::vector<Mat3> excess_stress(const StokesProblem& problem,
                                              const StokesState& state);

}  // namespace meniscus::fem
