#pragma once

#include <complex>
#include <vector>

namespace meniscus {

/// Where the rates of waves lie that decay and are convected, times the step: −decay ≤ Re z ≤ 0 and
/// |Im z| ≤ min(ratio |Re z|, convection).
struct WaveSpectrum {
  double decay = 0.0;
  double ratio = 0.0;
  double convection = 0.0;
};

/// The coefficients of the Runge–Kutta–Chebyshev scheme of second order with s ≥ 3 stages
/// (sommeijer1998, section 2). From y_0, with F_j = f(y_j) at t + c_j Δt:
///   y_1 = y_0 + μ̃_1 Δt F_0,
///   y_j = (1 − μ_j − ν_j) y_0 + μ_j y_{j−1} + ν_j y_{j−2} + Δt (μ̃_j F_{j−1} + γ̃_j F_0).
/// On y' = −r y the end is y_s = P(−rΔt) y_0 with
///   P(z) = a_s + b_s T_s(w0 + w1 z),
/// |P| < 1 on the interval of stability, about a_s for short waves: ⅔ for the least damping ε, ⅓
/// for the largest. T_s is taken at w0 = 1 + ε/s². An ε of 2/13 makes the interval long, but leaves
/// next to no room off the real axis. A larger one takes more stages and leaves room for waves that
/// are convected.
class ChebyshevScheme {
 public:
  struct Stage {
    double mu = 0.0, nu = 0.0, mu_F = 0.0, gamma_F = 0.0;
    double c = 0.0;  ///< place of the stage in the step
  };

  static constexpr double kLeastDamping = 2.0 / 13.0, kMostDamping = 5.0;
  explicit ChebyshevScheme(int num_stages, double damping = kLeastDamping);
  /// The one of fewest stages that lets no wave grow, of the least damping among those tried. Where
  /// none does, that which lets them grow least; more stages have to be worth 1 %.
  static ChebyshevScheme for_waves(const WaveSpectrum& waves, int most_stages);

  /// The stages from y_1 to y_s.
  [[nodiscard]] const std::vector<Stage>& stages() const { return stages_; }
  /// P(z), from its closed form.
  [[nodiscard]] std::complex<double> stability_polynomial(std::complex<double> z) const;
  [[nodiscard]] double stability_polynomial(double z) const;
  /// The largest |P| wherever the rates of these waves lie, found along the edge of that region.
  /// Infinite where waves decay beyond the interval of stability.
  [[nodiscard]] double largest_growth(const WaveSpectrum& waves) const;

  /// β(s): |P(z)| ≤ 1 for −β ≤ z ≤ 0.
  [[nodiscard]] static double stability_interval(int num_stages, double damping = kLeastDamping);
  /// The fewest stages, 3 or more, whose interval is at least this long.
  [[nodiscard]] static int num_stages_for(double interval);

 private:
  std::vector<Stage> stages_;
  double w0_ = 0.0, w1_ = 0.0, a_ = 0.0, b_ = 0.0;
};

}  // namespace meniscus
