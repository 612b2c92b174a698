#include "meniscus/case/benchmark.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

using testing::HasSubstr;

const std::string kHead =
    "# title: A drop\n# set-up: at rest,\n#   for long\n# equations: Stokes\n"
    "# provenance: a program\n# licence: GPL-3.0-or-later\n";
const std::string kColumns =
    "# column t [1/G]: time\n# column L [R0], error 1e-7, tolerance 0.005: half of the\n#   "
    "length\n";

std::string refusal(const std::string& text) {
  try {
    (void)read_benchmark("made-up", text);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Benchmark, ReadsHeaderAndTable) {
  const Benchmark read = read_benchmark("made-up", kHead + kColumns + "t,L\n0,1\n0.5,1.2\n");
  EXPECT_EQ(read.title, "A drop");
  ASSERT_EQ(read.columns.size(), 1U);
  EXPECT_EQ(read.columns[0].name, "L");
  EXPECT_EQ(read.columns[0].unit, "R0");
  EXPECT_EQ(read.columns[0].meaning, "half of the length");
  EXPECT_EQ(read.columns[0].error, 1e-7);
  EXPECT_EQ(read.columns[0].tolerance, 0.005);
  EXPECT_EQ(read.table.column("L")[1], 1.2);
}

TEST(Benchmark, SaysWhatAHeaderOrTableLacks) {
  EXPECT_THAT(refusal("# title: A drop\n" + kColumns + "t,L\n0,1\n1,2\n"),
              HasSubstr("\"# set-up: "));
  EXPECT_THAT(refusal(kHead + kColumns + "t,L,B\n0,1,1\n1,2,1\n"), HasSubstr("# column B [UNIT]"));
  EXPECT_THAT(refusal(kHead + kColumns + "t,L\n0,1\n0,2\n"), HasSubstr("t does not rise"));
  EXPECT_THAT(refusal(kHead + kColumns + "t,L\n0,1\n1,x\n"), HasSubstr("no finite number"));
  EXPECT_THAT(refusal(kHead + kColumns + "L,t\n0,1\n1,2\n"), HasSubstr("first column is not t"));
}

TEST(Benchmark, EveryShippedOneIsWholeAndWellWithinItsTolerance) {
  EXPECT_GE(benchmark_files().size(), 9U);
  for (const BenchmarkFile& file : benchmark_files()) {
    const Benchmark each = benchmark(std::string(file.name));
    EXPECT_THAT(each.licence, HasSubstr("GPL-3.0-or-later")) << each.name;
    for (const BenchmarkColumn& column : each.columns)
      EXPECT_LT(column.error, 0.5 * column.tolerance) << each.name << ": " << column.name;
  }
}

TEST(Benchmark, NamesTheNearestOne) {
  try {
    (void)benchmark("uniaxial-extention");
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("did you mean \"uniaxial-extension\"?"));
    EXPECT_THAT(error.what(), HasSubstr("two-drops"));
  }
}

}  // namespace
}  // namespace meniscus
