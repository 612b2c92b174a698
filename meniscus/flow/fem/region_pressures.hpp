#pragma once

#include "meniscus/flow/fem/stokes_problem.hpp"

namespace meniscus::fem {

/// μ_o/μ by region, means over the cells on both sides of the region's interfaces. Region 0, the
/// matrix, and regions that no interface encloses have 1.
[[nodiscard]] Field<RegionId, double> viscosities_around(const StokesProblem& problem);

/// The correction of the inverse of the mass matrix over μ, by region and as a fraction of that
/// inverse. It makes it the Schur complement's for a pressure constant in one region and zero
/// elsewhere. Such a pressure drives the flow of a source, which has to go on in the liquid around.
/// For a sphere of volume V with μ inside and μ_o around,
///   sup_v (∮v·n)² / ∫2μ D:D = V / (4μ_o/3 + 2μ/3),
/// where a pressure that varies has V/(2μ), and the mass matrix over μ says V/μ for both. That is
/// too much by μ_o/μ for the constant one, next to the others. The fraction is 2/3 (μ_o/μ − 1)
/// where that is positive, by `viscosities_around`.
[[nodiscard]] Field<RegionId, double> constant_pressure_shares(const StokesProblem& problem);

}  // namespace meniscus::fem
