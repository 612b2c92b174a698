#include "meniscus/case/check_file.hpp"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

using testing::HasSubstr;

class CheckFileTest : public testing::Test {
 protected:
  std::filesystem::path file_ =
      std::filesystem::path(testing::TempDir()) / ("check-" + std::to_string(getpid()) + ".toml");
  ~CheckFileTest() override { std::filesystem::remove(file_); }

  CheckFile read(const std::string& text) {
    std::ofstream(file_) << text;
    return read_check_file(file_);
  }
  std::string refusal(const std::string& text) {
    try {
      (void)read(text);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "accepted";
  }
};

TEST_F(CheckFileTest, ReadsAnEventsColumnAsOneNumber) {
  const CheckFile check = read(R"(
[[run]]
name = "pinch"
  [[run.quantity]]
  column = "x"
  event = 1
  reference = 2.88
  source = "a computation"
)");
  const CheckedQuantity& quantity = check.runs.at(0).quantities.at(0);
  EXPECT_EQ(quantity.event, 1);
  EXPECT_EQ(quantity.measure, CheckedQuantity::Measure::last);
}

TEST_F(CheckFileTest, ReadsHowFarVolumesMayBePutRight) {
  EXPECT_EQ(read("[[run]]\nname = \"a\"\n").runs[0].most_correction, 0.1);
  EXPECT_EQ(read("[[run]]\nname = \"a\"\nmost-correction = 2.0\n").runs[0].most_correction, 2.0);
  EXPECT_THAT(refusal("[[run]]\nname = \"a\"\nmost-correction = 0.0\n"),
              HasSubstr("most-correction: must be positive"));
}

TEST_F(CheckFileTest, ReadsRunsQuantitiesAndExtrapolations) {
  const CheckFile check = read(R"(
[[run]]
name = "N0 = 200"
set = ["drop[0].nodes=200"]
short = true
  [[run.quantity]]
  column = "L"
  tolerance = 0.015
[[run]]
name = "N0 = 400"
once = true
  [[run.quantity]]
  column = "y"
  drop = 1
  minus-drop = 0
  measure = "largest"
  against = "N0 = 200"
  absolute = true
  [[run.quantity]]
  column = "x"
  event = 0
  magnitude = true
  reference = 2.8
  source = "a page"
  [[run.quantity]]
  column = "volume"
  all-drops = true
  measure = "smallest"
  against = "N0 = 200"
[[extrapolation]]
name = "limit"
runs = ["N0 = 200", "N0 = 400"]
nodes = [200, 400]
order = 1.4
column = "L"
at = [3.25]
reference = 1.759827
source = "axisymmetric"
)");
  ASSERT_EQ(check.runs.size(), 2U);
  EXPECT_TRUE(check.runs[0].is_short);
  EXPECT_FALSE(check.runs[0].is_once);
  EXPECT_TRUE(check.runs[1].is_once);
  EXPECT_EQ(check.runs[0].quantities.at(0).tolerance, 0.015);
  const CheckedQuantity& y = check.runs[1].quantities.at(0);
  EXPECT_EQ(y.measure, CheckedQuantity::Measure::largest);
  EXPECT_EQ(y.minus_drop, 0);
  EXPECT_TRUE(y.is_absolute);
  EXPECT_FALSE(y.is_magnitude);
  EXPECT_TRUE(check.runs[1].quantities.at(1).is_magnitude);
  EXPECT_TRUE(check.runs[1].quantities.at(2).is_of_all_drops);
  ASSERT_EQ(check.extrapolations.size(), 1U);
  EXPECT_EQ(check.extrapolations[0].order, 1.4);
  EXPECT_EQ(check.extrapolations[0].quantity.at, std::vector<double>{3.25});
}

TEST_F(CheckFileTest, NamesTheLineOfAFault) {
  EXPECT_THAT(refusal("[[run]]\nnam = \"a\"\n"), HasSubstr(":2: nam: not a key here"));
  EXPECT_THAT(refusal("[[run]]\nset = []\n"), HasSubstr("name: is missing"));
  EXPECT_THAT(refusal("[[run]]\nname = 3\n"), HasSubstr(":2: name: a text is wanted"));
  EXPECT_THAT(
      refusal("[[run]]\nname = \"a\"\n[[run.quantity]]\ncolumn = \"D\"\nmeasure = \"mean\"\n"),
      HasSubstr("allowed are curve, largest, smallest, last"));
  EXPECT_THAT(
      refusal("[[run]]\nname = \"a\"\n[[run.quantity]]\ncolumn = \"D\"\nall-drops = true\n"),
      HasSubstr("all-drops: only for the measures largest and smallest"));
  EXPECT_THAT(refusal("[run]\n"), HasSubstr("write [[run]]"));
  EXPECT_THAT(refusal("[[run]\n"), HasSubstr(":1: "));
  EXPECT_THAT(refusal(""), HasSubstr("no [[run]]"));
}

TEST_F(CheckFileTest, WantsASourceAndAPlaceForANumber) {
  const std::string head = "[[run]]\nname = \"a\"\n[[run.quantity]]\ncolumn = \"D\"\n";
  EXPECT_THAT(refusal(head + "reference = 1.0\nat = [1.0]\n"), HasSubstr("source"));
  EXPECT_THAT(refusal(head + "reference = 1.0\nsource = \"s\"\n"), HasSubstr("the one place"));
  EXPECT_THAT(refusal(head + "measure = \"largest\"\n"), HasSubstr("needs a reference"));
  EXPECT_THAT(refusal(head + "against = \"b\"\n"), HasSubstr("no run of this file"));
}

}  // namespace
}  // namespace meniscus
