#pragma once

#include <span>

#include "meniscus/evolve/surfactant_motion.hpp"
#include "meniscus/linear/communicator.hpp"

namespace meniscus {

/// How long rates are damped, and by which processes together.
struct Damping {
  double duration = 0.0;  ///< [1/G]
  linear::Processes processes = linear::Processes::alone;
  /// How many times as stiff A is around drops without viscosity; straight in
  /// (μ_out − μ_in)/(μ_out + μ_in) to 1 where both liquids are as viscous.
  double stiffness_around_thin = 1.0;
};

/// What the semi-implicit scheme makes of normal speeds s: s* with
///   (1 + b(τA))(s* − s0) = s − s0,   A = σ/(2(μ_in + μ_out)) (−Δ_s + k/R²)^½,   τ the duration,
///   b(q) = q²/(q + q0),   q0 = `kUndampedShare`.
/// σ|q|/(2(μ_in + μ_out)) is the rate at which waves of wave number q decay that are short against
/// all other lengths; long ones decay more slowly. k is `kSphereStiffness`, R the radius of the
/// sphere of the drop's volume, s0 = `about`. `viscosity` is by region.
///
/// −Δ_s is the cotangent Laplacian with the masses |∂V/∂x_v|, so that the volume's rate
/// Σ|∂V/∂x_v| s_v stays zero if it is. (1 + b(τA))⁻¹ is a sum of shifted inverses of −Δ_s, within
/// 3 %.
[[nodiscard]] NormalSpeeds damped_speeds(const Scene& scene, std::span<const double> viscosity,
                                         const NormalSpeeds& speeds, const NormalSpeeds& about,
                                         const Damping& damping);

/// Which share of a shape's spin is carried along rather than damped: 1/(1 + b(τA))² at the slowest
/// wave, l = 2. A spin is found from normal speeds, of which tension may have made a part. Of that
/// part an undamped step would be no longer stable than an explicit one. Where tension is fast, a
/// shape does not turn by itself.
[[nodiscard]] double share_of_spin(const Interface& interface, std::span<const double> viscosity,
                                   const Damping& damping);

/// What is expected of normal speeds s in an implicit stage of liquids with inertia, s* with
///   s* − s0 = (s − s0)/(1 + q²),   q = στ²κ³/(ρ_in + ρ_out + 2(μ_in + μ_out)τκ²),
/// τ = `duration` and κ² = −Δ_s + k/R², s0 and k as for `damped_speeds`. q is what a stage would
/// change in a wave of wave number κ if tension met the liquids' mass and viscosity together.
/// 1/(1 + q²) is a rational function of κ², the sum of three shifted inverses.
[[nodiscard]] NormalSpeeds expected_speeds(const Scene& scene, const NormalSpeeds& speeds,
                                           const NormalSpeeds& about, double duration);

/// `damped_speeds` for rates ∂Γ/∂t of concentrations, less their means. The largest Gibbs
/// elasticity E = −Γ dσ/dΓ is in the place of σ. An elastic surface evens out short waves of Γ at
/// the rate E|q|/(2(μ_in + μ_out)). The masses are the areas S_v of the carriers, at whose vertices
/// the interfaces are, so that Σ S_v ∂Γ_v/∂t stays what it is. How the surface stretches belongs to
/// these rates. Where a film all but resists it, stretching and flux cancel. Damping one of them
/// would leave the other.
[[nodiscard]] ConcentrationRates damped_concentration_rates(
    const Scene& scene, std::span<const double> viscosity, const ConcentrationRates& rates,
    const ConcentrationRates& about, const SceneCarriers& carriers, const Damping& damping);

}  // namespace meniscus
