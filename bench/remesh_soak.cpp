// The soak of the surface engine: random smooth surfaces, stretched, sheared and remeshed.
//
//   remesh_soak [first seed = 0] [count = 10000]
//
// One line for each seed that has something to tell, then the totals.
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "tests/surface/soak.hpp"

int main(int argc, char** argv) {
  const unsigned first = argc > 1 ? static_cast<unsigned>(std::atoi(argv[1])) : 0;
  const unsigned count = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 10000;
  meniscus::test::SoakResult total;
  int off_law = 0, off_count = 0;
  for (unsigned seed = first; seed < first + count; ++seed) {
    const meniscus::test::SoakResult one = meniscus::test::soak(seed);
    for (const std::string& line : one.log) fmt::print("seed {}: {}\n", seed, line);
    if (one.law_error > 0.05) ++off_law;
    if (one.count_error > 0.05) ++off_count;
    meniscus::test::add(total, one);
    if ((seed - first + 1) % 100 == 0 || seed + 1 == first + count) {
      const double num_judged = total.remeshes - total.rollbacks, mean = total.law_sum / num_judged;
      fmt::print(
          "{} surfaces, {} remeshes, {} rolled back, {} invalid; {} faces, {} below 20 degrees "
          "({:.4f} %), smallest angle {:.2f}; off the law by 5 %: {} surfaces (worst {:.3f}), mean "
          "{:+.4f}, deviation {:.4f}; off their own count: {} (worst {:.3f}); {:.2f} ms of CPU a "
          "remesh, {:.1f} us a vertex\n",
          seed - first + 1, total.remeshes, total.rollbacks, total.invalid, total.faces,
          total.faces_below,
          100.0 * static_cast<double>(total.faces_below) / static_cast<double>(total.faces),
          total.min_angle_deg, off_law, total.law_error, mean,
          std::sqrt(total.law_squares / num_judged - mean * mean), off_count, total.count_error,
          1e3 * total.remesh_seconds / total.remeshes, 1e6 * total.remesh_seconds / total.vertices);
      std::fflush(stdout);
    }
  }
  return total.invalid == 0 ? 0 : 1;
}
