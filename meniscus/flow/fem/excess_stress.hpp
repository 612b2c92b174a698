#pragma once

#include <vector>

#include "meniscus/flow/fem/stokes_problem.hpp"

namespace meniscus::fem {

/// What generalised Newtonian liquids do that Newtonian ones of their viscosities at rest would
/// not, by region; empty where all are Newtonian.
struct GeneralisedLiquids {
  std::vector<Mat3> excess_stress;      ///< ∫2(μ(γ̇) − μ)D over the region [μ_out G R0³]
  std::vector<double> least_viscosity;  ///< the smallest μ(γ̇) in the region [μ_out]
};
[[nodiscard]] GeneralisedLiquids generalised_liquids(const StokesProblem& problem,
                                                     const StokesState& state);

}  // namespace meniscus::fem
