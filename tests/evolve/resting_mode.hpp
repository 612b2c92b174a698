#pragma once

#include <array>
#include <limits>
#include <string>

namespace meniscus::test {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Both have E0 = 0.5 and Pe_s = 10. They end the table of a drop.
inline constexpr const char* kLinear = "surfactant = {elasticity = 0.5, peclet = 10}";
inline constexpr const char* kLangmuir =
    "surfactant = {equation-of-state = \"langmuir\", elasticity = 0.371313, coverage = 0.5, peclet "
    "= "
    "10}";

/// A mode l of r = 1 + f P_l, Γ = 1 + g P_l on a drop at rest: its rate of decay and g/f.
struct Mode {
  unsigned l = 2;
  double lambda = 1.0;
  double rate = 0.0, g_over_f = 0.0;
};

/// The slow and the fast mode in an unbounded liquid: eigenvectors of (f, g)′ = A(f, g), which
/// Stokes flow in and around a sphere gives with J_n = (l − 1)(l + 2)f − 2E0 g and J_t = E0 g for
/// the jump of traction.
[[nodiscard]] std::array<Mode, 2> modes(unsigned l, double lambda, double E0, double Pe);

/// A run of a drop at rest that begins with a mode, the larger of f and g being 0.0025.
struct RestingRun {
  std::string surfactant = kLinear;
  int nodes = 200;
  double end = 1.0;
  double max_step = 1.0;
  bool is_meshed = false;  ///< quadratic elements in a sphere of radius 10, else boundary integrals
};
/// The rate at which the larger one decays, over the mode's.
struct RelativeRate {
  double value = 0.0;
  int num_steps = 0;
};
[[nodiscard]] RelativeRate relative_rate(const Mode& mode, const RestingRun& run);

}  // namespace meniscus::test
