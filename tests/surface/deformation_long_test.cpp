#include <gtest/gtest.h>

#include "tests/surface/deformation.hpp"

namespace meniscus {
namespace {

TEST(DeformationLong, FullPeriodKeepsTheVolume) {
  // The published period: at t = 1.5 the exact sheet is 0.0044 thick, and ∮⟨κ⟩² asks for some
  // 400 times N0 vertices. N0 = 100 keeps closed and whole; the shape returns to 0.07 only.
  const test::DeformationResult r = test::deform_and_return({.N0 = 100.0, .period = 3.0});
  EXPECT_EQ(r.failed_steps, 0) << r.failure;
  EXPECT_LT(r.worst_volume_error, 5e-3);
  EXPECT_LT(r.shape_error, 0.15);
}

}  // namespace
}  // namespace meniscus
