#include <gtest/gtest.h>

#include "tests/surface/deformation.hpp"

namespace meniscus {
namespace {

TEST(DeformationLong, FullPeriodKeepsTheVolume) {
  // The published period: at t = 1.5 the exact sheet is 0.0044 thick. Springs at rest within 0.2 l0
  // wear the shape less than the default's (docs/surface-remeshing.md).
  const test::DeformationResult r =
      test::deform_and_return({.N0 = 400.0, .period = 3.0, .spring_tolerance = 0.2});
  EXPECT_LE(r.failed_steps, 3) << r.failure;  // of 300
  EXPECT_GE(r.smallest_angle_deg, 5.0);
  EXPECT_LT(r.worst_volume_error, 5e-3);
  EXPECT_LT(r.shape_error, 0.05);
}

}  // namespace
}  // namespace meniscus
