#pragma once

#include <optional>
#include <vector>

#include "meniscus/evolve/interface_motion.hpp"
#include "meniscus/transport/surface_transport.hpp"

namespace meniscus {

/// Rates at which the amounts of surfactant at the vertices change, by interface; empty where there
/// is none. An amount is ∫φ_v Γ dS (`vertex_amounts`) [R0²], Γ being over its initial value.
using AmountRates = std::vector<VertexField<double>>;

/// Transport of the surfactants of a scene, by interface; empty where there is none.
using SurfactantTransport = std::vector<std::optional<SurfaceTransport>>;
/// For liquid that moves with `velocity` over vertices that move with `motion`.
[[nodiscard]] SurfactantTransport surfactant_transport(const Scene& scene,
                                                       std::span<const VertexField<Vec3>> velocity,
                                                       const InterfaceMotion& motion);

/// The rates at this instant, at the concentrations of the scene.
[[nodiscard]] AmountRates amount_rates(const SurfactantTransport& transport, const Scene& scene);
/// The constant rates that take the amounts of `start` for `duration` along, while its vertices
/// move with `motion`: implicit, of second order with the transport of the middle.
[[nodiscard]] AmountRates mean_amount_rates(const SurfactantTransport& transport,
                                            const Scene& start, const InterfaceMotion& motion,
                                            double duration);

/// Mean rates ∂Γ/∂t at the vertices, by interface; empty where there is no surfactant [G].
using ConcentrationRates = std::vector<VertexField<double>>;
/// Those of the concentrations to which rates of amounts lead, `end` being where the vertices of
/// `start` are after `duration`: they hold how the surface stretched as well.
[[nodiscard]] ConcentrationRates concentration_rates(const Scene& start, const Scene& end,
                                                     const AmountRates& rates, double duration);
/// The rates of amounts that lead there.
[[nodiscard]] AmountRates amount_rates_of(const Scene& start, const Scene& end,
                                          const ConcentrationRates& rates, double duration);

/// Gives interfaces that moved from `start` the concentrations to which these rates lead in
/// `duration`. Σ Γ × area changes by round-off alone.
void move_surfactant(Scene& scene, const Scene& start, const AmountRates& rates, double duration);

/// max_v dt |Δṁ_v|/(S_v ⟨Γ⟩) R/h over all vertices: how far rates of second and of first order take
/// a concentration apart in a step, over the mean concentration, counted as `step_error` counts a
/// displacement over the radius R of the drop's sphere. h is its mean edge.
[[nodiscard]] double surfactant_error(const Scene& start, const AmountRates& second,
                                      const AmountRates& first, double dt);

}  // namespace meniscus
