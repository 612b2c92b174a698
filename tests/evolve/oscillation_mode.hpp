#pragma once

#include <complex>
#include <limits>

#include "meniscus/core/vec.hpp"

namespace meniscus::test {

/// A drop in units of R0, μ_out R0/σ and σ/R0.
struct Oscillation {
  double La = 1.0;                                     ///< ρ_out σ R0/μ_out²
  double lambda = 1.0;                                 ///< μ_in/μ_out
  double density_ratio = 1.0;                          ///< ρ_in/ρ_out
  double b = std::numeric_limits<double>::infinity();  ///< radius of the sphere without slip around
  int l = 2;
  double E0 = 0.0;   ///< elasticity −dσ/dΓ Γ/σ of an insoluble surfactant; 0 without
  double D_s = 0.0;  ///< its surface diffusivity [σR0/μ_out]
};

/// The mode r = 1 + f P_l(cos θ), f ~ e^(−st), of the linearised Navier–Stokes equations in both
/// liquids. With the radial velocity u(r) P_l, u is a sum of r^(l−1) and j_l(q_in r)/r inside, of
/// r^(−l−2) and h_l⁽¹⁾(q_out r)/r outside, and of r^(l−1) and y_l(q_out r)/r too where there is a
/// wall; q² = s La ρ/μ. Velocities are continuous, the normal stress jumps by (l − 1)(l + 2) f.
/// A surfactant Γ = 1 + g P_l, (D_s l(l + 1) − s) g = −(2u − l(l + 1) v), lowers the tension by
/// E0 g P_l, to which shear and normal stress answer; without it the shear stress is continuous.
class OscillationMode {
 public:
  /// The root s nearest to a guess, by the secant method; Im s > 0.
  OscillationMode(const Oscillation& of, std::complex<double> guess);

  [[nodiscard]] std::complex<double> rate() const { return rate_; }
  /// The velocity when f is real, `f0`; the axis is x.
  [[nodiscard]] Vec3 velocity(const Vec3& x, double f0) const;
  /// Re g then.
  [[nodiscard]] double concentration(double f0) const { return f0 * concentration_.real(); }

 private:
  Oscillation of_;
  std::complex<double> rate_;
  Eigen::VectorXcd amplitudes_;         // of the functions above, of f = 1
  std::complex<double> concentration_;  // g of f = 1
};

}  // namespace meniscus::test
