#pragma once

#include "meniscus/core/fault.hpp"
#include "meniscus/evolve/time_schemes.hpp"

namespace meniscus {

/// Σ tension · area of the triangulations [μ_out G R0³].
[[nodiscard]] double interface_energy(const Scene& scene);

/// A fault where the step did to the interfaces' energy E what the flow does not. `end` has the
/// interfaces after the step's motion, before remeshing. With the gross power of tension
///   Q = Σ tension Σ_v |ẋ_v · ∂S/∂x_v|
/// of the step's mean motion ẋ, and dE/dt the mean of the rates at the stages, where the flow's
/// power goes into the interfaces:
///   E_end − E_start ≤ max(0, Δt dE/dt) + f Δt Q,
///   |E_end − E_start − Δt dE/dt| ≤ f Δt Q for schemes that resolve every wave in time.
/// A wave that a step amplifies breaks them as its height grows. Where nothing drives the liquids,
/// dE/dt is negative but for what the discrete tension lacks of the gradient of E.
[[nodiscard]] std::optional<Fault> find_energy_fault(const Step& step, const StageFlow& whole,
                                                     const Scene& end);

}  // namespace meniscus
