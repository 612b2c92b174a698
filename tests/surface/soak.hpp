#pragma once

#include <string>
#include <vector>

namespace meniscus::test {

/// What became of one random surface, or pair of surfaces, that was stretched, sheared and remeshed
/// ten times.
struct SoakResult {
  int remeshes = 0;
  int rollbacks = 0;     ///< remeshes that left the surface as it was
  int invalid = 0;       ///< surfaces handed back with a defect, or crossing their neighbour
  long faces = 0;        ///< in all surfaces after each remesh
  long faces_below = 0;  ///< of them with an angle below 20°
  double min_angle_deg = 180.0;
  double law_error = 0.0;       ///< largest |N_S/∮ρ dS − 1|, eq. 2 on the exact smooth surface
  double law_sum = 0.0;         ///< of N_S/∮ρ dS − 1 after each remesh
  double law_squares = 0.0;     ///< of its squares
  double count_error = 0.0;     ///< the same with the integral of the remesh's own report
  double remesh_seconds = 0.0;  ///< CPU time of all remeshes
  int vertices = 0;             ///< in all surfaces after each remesh
  std::vector<std::string> log;  ///< one line for each rollback and each defect
};

/// Kind 0: a random star; 1: a chain of capsules; 2: two shapes that nearly touch. The seed alone
/// decides everything.
[[nodiscard]] SoakResult soak(unsigned seed);

/// The sum of counts and the worst of the rest.
void add(SoakResult& total, const SoakResult& one);

}  // namespace meniscus::test
