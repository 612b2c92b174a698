#include <cmath>

#include <gtest/gtest.h>

#include "tests/transport/bulk/conduction_run.hpp"

namespace meniscus::bulk {
namespace {

TEST(ConductionLong, OfEveryMediumAsHeatAndAsSpeciesIsExactInTwoThousandths) {
  for (const Medium* medium : {&kSame, &kBetter, &kWorse})
    for (const bool is_species : {false, true}) {
      const auto errors =
          conduction_errors(*medium, {.is_species = is_species, .cell_volume = 0.5, .step = 0.05});
      for (std::size_t r = 0; r < errors.size(); ++r) {
        const ConductionErrors& e = errors[r];
        std::printf("k %g a %g t %g: centre %.3f, surface %.3f, mean %.3f %%\n", medium->k,
                    medium->a, medium->rows[r].t, 100.0 * e.centre, 100.0 * e.surface,
                    100.0 * e.mean);
        EXPECT_LT(std::abs(e.centre), 2e-3);
        EXPECT_LT(std::abs(e.surface), 2e-3);
        EXPECT_LT(std::abs(e.mean), 2e-3);
      }
    }
}

}  // namespace
}  // namespace meniscus::bulk
