#pragma once

#include <span>

#include "meniscus/evolve/options.hpp"
#include "meniscus/scene/scene.hpp"
#include "meniscus/surface/known_surfaces.hpp"

namespace meniscus {

/// The drops' contribution to the stress of a dilute suspension, per unit volume fraction [μ_out
/// G]:
///   Σ = V⁻¹ Σ_drops [ ∫_S σ(I − nn − 2/3 I) dS + (λ − λ_out) ∫_S (un + nu) dS ]
/// (kennedy1994, eq. 10; loewenberg1996, eq. 8), V the volume the outermost interfaces enclose,
/// λ and λ_out the viscosities inside and outside each interface. `excess`, by region, is what the
/// laws of generalised-Newtonian drops add to the stress in them (FlowSolver::excess_stress); the
/// matrix has to be Newtonian. Over flat faces with linear velocities, or over curved ones
/// with quadratic velocities. Deviatoric up to the trace of the second integral, which
/// incompressible flow makes zero.
[[nodiscard]] Mat3 drop_stress(const Scene& scene, std::span<const VertexField<Vec3>> velocity,
                               const InterfaceSurfaces& faces, std::span<const Mat3> excess = {});

}  // namespace meniscus
