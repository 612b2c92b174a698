#pragma once

#include <optional>

#include "meniscus/scene/scene.hpp"

namespace meniscus {

/// The name of the carried field that holds Γ at the vertices, over its initial value.
inline constexpr const char* kSurfactantField = "surfactant";

/// Γ at the vertices of an interface; null where it carries no surfactant.
[[nodiscard]] const VertexField<double>* surfactant_concentration(const Interface& interface);
[[nodiscard]] VertexField<double>* surfactant_concentration(Interface& interface);
[[nodiscard]] bool has_surfactant(const Scene& scene);
/// Whether a surfactant is exchanged with a species.
[[nodiscard]] bool has_soluble_surfactant(const Scene& scene);

/// Whether the tension may differ from place to place.
[[nodiscard]] inline bool has_varying_tension(const Interface& interface) {
  return interface.surfactant.has_value() || !interface.tension_factor.empty();
}
/// σ at the vertices [μ_out G R0].
[[nodiscard]] VertexField<double> vertex_tension(const Interface& interface);
/// The largest σ of the vertices [μ_out G R0].
[[nodiscard]] double largest_tension(const Interface& interface);
/// The Gibbs elasticity −Γ dσ/dΓ at the vertices [μ_out G R0]; empty without surfactant.
[[nodiscard]] VertexField<double> vertex_elasticity(const Interface& interface);
/// The largest of them; 0 without surfactant.
[[nodiscard]] double largest_elasticity(const Interface& interface);
/// Σ σ × area of the flat faces [μ_out G R0³]: the energy of an interface without surfactant.
[[nodiscard]] double tension_energy(const Interface& interface);

/// The first vertex whose Γ is negative, not finite, at the packing limit, or leaves no tension.
[[nodiscard]] std::optional<Fault> find_surfactant_fault(const Scene& scene);

}  // namespace meniscus
