#include "meniscus/report/volume_corrections.hpp"

#include <gtest/gtest.h>

namespace meniscus::report {
namespace {

TEST(VolumeCorrections, AreThoseOfTheDropThatWasShiftedMost) {
  const io::Table drops{{"step", "drop", "volume_correction"},
                        {{"0", "0", "0.5"},
                         {"1", "0", "0.01"},
                         {"2", "0", "0.02"},
                         {"3", "1", "0.001"},
                         {"3", "2", "-0.04"},
                         {"4", "1", ""}}};
  EXPECT_NEAR(volume_correction_sum(drops).value(), 0.04, 1e-15);
}

TEST(VolumeCorrections, AreNotKnownFromATableWithoutThem) {
  EXPECT_FALSE(volume_correction_sum({{"step", "drop"}, {{"1", "0"}}}).has_value());
  EXPECT_EQ(volume_correction_sum({{"step", "drop", "volume_correction"}, {}}), 0.0);
}

}  // namespace
}  // namespace meniscus::report
