#pragma once

#include <string>
#include <vector>

#include "meniscus/core/vec.hpp"

namespace meniscus {

/// value + gradient·x + spot exp(−|x − center|²/(2 width²)).
struct ScalarProfile {
  double value = 0.0;
  Vec3 gradient = Vec3::Zero();  ///< [1/R0]
  double spot = 0.0;             ///< height of the Gaussian
  Vec3 center = Vec3::Zero();    ///< [R0]
  double width = 1.0;            ///< [R0]

  [[nodiscard]] double at(const Vec3& x) const;
  friend bool operator==(const ScalarProfile&, const ScalarProfile&) = default;
};

/// What a bulk scalar meets in one liquid.
struct ScalarLiquid {
  double capacity = 1.0;       ///< γ over the matrix's: ρc of heat, c/T of a species
  double conductivity = 1.0;   ///< k over the matrix's; the diffusivity is k/γ
  double source = 0.0;         ///< q: amount per volume and time [G]
  ScalarProfile initial = {};  ///< T of heat, c = γT of a species
  friend bool operator==(const ScalarLiquid&, const ScalarLiquid&) = default;
};

/// The condition on a bulk scalar at a patch.
struct ScalarCondition {
  enum class Kind {
    none,   ///< nothing is conducted
    value,  ///< T is given: `value` + `gradient`·x
    flux    ///< k ∂T/∂n is given
  } kind = Kind::none;
  double value = 0.0;
  Vec3 gradient = Vec3::Zero();  ///< [1/R0]
  double flux = 0.0;             ///< into the domain [1/R0]
  friend bool operator==(const ScalarCondition&, const ScalarCondition&) = default;
};

/// A scalar that the liquids conduct and convect:
///   Pe (γ ∂T/∂t + γ v·∇T − q) = ∇·(k∇T) + Br 2μ D:D,
/// T and the normal component of k∇T being continuous across interfaces. Of heat T is the
/// temperature. Of a species T is the concentration that the matrix would have in equilibrium with
/// the liquid: c = γT jumps by the partition coefficient. What liquids and patches add to it they
/// hold themselves, in the order of `Scene::scalars`.
struct Scalar {
  std::string name;
  bool is_species = false;
  double peclet = 1.0;  ///< Pe = G R0²/D of the matrix; 0: T conducts at once, inf: not at all
  bool is_convected = true;
  double brinkman = 0.0;  ///< Br = μ_out (G R0)²/(k_out × unit of T)
  // What T does to the flow, by its difference from a reference.
  double reference = 0.0;
  double tension_slope = 0.0;       ///< σ is multiplied by 1 + slope (T − reference)
  Vec3 buoyancy = Vec3::Zero();     ///< body force by T − reference [μ_out G/R0]
  double viscosity_exponent = 0.0;  ///< μ is multiplied by exp(−exponent (T − reference))

  [[nodiscard]] bool acts_on_flow() const {
    return tension_slope != 0.0 || viscosity_exponent != 0.0 || !buoyancy.isZero(0.0);
  }
  friend bool operator==(const Scalar&, const Scalar&) = default;
};

}  // namespace meniscus
