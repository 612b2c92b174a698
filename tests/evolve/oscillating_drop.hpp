#pragma once

#include <string>

#include "tests/evolve/oscillation_mode.hpp"

namespace meniscus::test {

/// A drop that begins with the velocity of its own mode, in a sphere of radius `of.b`.
struct OscillatingDrop {
  Oscillation of;
  std::complex<double> guess;  ///< of its rate
  int nodes = 200;
  double steps = 40.0;    ///< a period, all of the same length
  double periods = 1.0;   ///< of the run
  double height = 0.002;  ///< f at the start
  std::string more = {};  ///< further lines of the case, after [time]
};
/// The rate s that fits f(t) best.
[[nodiscard]] std::complex<double> fitted_rate(const OscillatingDrop& drop);
/// f at the end of the run.
[[nodiscard]] double last_height(const OscillatingDrop& drop);
/// The rate at which f decays in that many steps of length `step`, of a mode that does not
/// oscillate.
[[nodiscard]] double decay_rate(OscillatingDrop drop, double step, int steps);

}  // namespace meniscus::test
