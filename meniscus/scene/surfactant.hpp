#pragma once

#include <optional>
#include <variant>

namespace meniscus {

/// σ/σ1 = 1 − β(Γ − 1): surface pressure in proportion to the concentration.
struct LinearState {
  double elasticity = 0.0;  ///< β ≥ 0
  friend bool operator==(const LinearState&, const LinearState&) = default;
};

/// σ/σ1 = [1 + E ln(1 − XΓ)]/[1 + E ln(1 − X)] (Langmuir's isotherm in Szyszkowski's equation).
struct LangmuirState {
  double elasticity = 0.0;  ///< E ≥ 0: gas constant × temperature × Γ∞/σ of the clean surface
  double coverage = 0.0;    ///< X in (0, 1): initial concentration over that of close packing
  friend bool operator==(const LangmuirState&, const LangmuirState&) = default;
};

/// How surface tension depends on the concentration Γ of a surfactant. Γ is over its initial value
/// and σ over the tension σ1 at Γ = 1. A further law is a type here, and what the functions below
/// ask of it.
using EquationOfState = std::variant<LinearState, LangmuirState>;

/// σ/σ1 at one concentration and its slope by Γ, never positive.
struct RelativeTension {
  double value = 1.0;
  double slope = 0.0;
};
/// Γ must be below `packing_limit`.
[[nodiscard]] RelativeTension relative_tension(const EquationOfState& state, double concentration);
/// The concentration of close packing, 1/X; infinite for a law that knows none.
[[nodiscard]] double packing_limit(const EquationOfState& state);
/// The concentration at which no tension is left; infinite for a tension that does not vary.
[[nodiscard]] double zero_tension_concentration(const EquationOfState& state);

/// Exchange with a species dissolved in the liquid outside. Per area and time j = Bi [K c (1 − XΓ)
/// − Γ], X = 1/`packing_limit`, is added to Γ and δj taken from the liquid.
struct Adsorption {
  int species = 0;        ///< its number among the scalars of the scene
  double biot = 0.0;      ///< Bi: rate of desorption [G]
  double constant = 1.0;  ///< K: Γ over c in equilibrium on an empty surface
  double depth = 1.0;     ///< δ: unit of Γ over unit of c and R0
  friend bool operator==(const Adsorption&, const Adsorption&) = default;
};

/// A surfactant on an interface.
struct Surfactant {
  EquationOfState state;
  double diffusivity = 0.0;                   ///< along the surface [G R0²]: 1/Pe_s
  std::optional<Adsorption> adsorption = {};  ///< none: insoluble
  friend bool operator==(const Surfactant&, const Surfactant&) = default;
};

}  // namespace meniscus
