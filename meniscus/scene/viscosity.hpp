#pragma once

#include <variant>

namespace meniscus {

/// A viscosity that does not depend on the rate of shear.
struct Newtonian {
  friend bool operator==(const Newtonian&, const Newtonian&) = default;
};

/// μ/μ₀ = r + (1 − r)(1 + (λγ̇)^a)^((n−1)/a), μ₀ the viscosity at rest (carreau1972, yasuda1981).
struct CarreauYasuda {
  double time_constant = 1.0;    ///< λ [1/G]
  double power_index = 1.0;      ///< n > 0
  double yasuda_exponent = 2.0;  ///< a > 0; 2: Carreau's
  double infinite_ratio = 0.0;   ///< r = μ∞/μ₀, in [0, 1]
  friend bool operator==(const CarreauYasuda&, const CarreauYasuda&) = default;
};

/// μ/μ₁ = γ̇^(n−1), but never outside [floor, ceiling]; μ₁ the viscosity at the rate 1 [G]
/// (bird1987, ch. 4).
struct PowerLaw {
  double power_index = 1.0;  ///< n > 0
  double floor = 1e-3, ceiling = 1e3;
  friend bool operator==(const PowerLaw&, const PowerLaw&) = default;
};

/// How the viscosity of a generalised-Newtonian liquid depends on the rate of shear
/// γ̇ = sqrt(2 D:D), as a multiple of the liquid's own viscosity.
using ViscosityLaw = std::variant<Newtonian, CarreauYasuda, PowerLaw>;

[[nodiscard]] inline bool is_newtonian(const ViscosityLaw& law) {
  return std::holds_alternative<Newtonian>(law);
}

/// The multiple at one rate, and its slope d ln μ/d ln γ̇. The stress grows with the rate, and the
/// flow is unique, where the slope exceeds −1: all laws above do so for n > 0.
struct RelativeViscosity {
  double value = 1.0;
  double slope = 0.0;
};
[[nodiscard]] RelativeViscosity relative_viscosity(const ViscosityLaw& law, double rate);

}  // namespace meniscus
