#include "meniscus/app/benchmark_comparison.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

using testing::HasSubstr;

/// A table with columns t and others, each a function of t.
template <class... F>
io::Table sampled(const std::vector<std::string>& columns, double begin, double end, int intervals,
                  F... functions) {
  io::Table table{.columns = columns, .rows = {}};
  for (int k = 0; k <= intervals; ++k) {
    const double t = begin + (end - begin) * k / intervals;
    table.rows.push_back({fmt::format("{}", t), fmt::format("{}", functions(t))...});
  }
  return table;
}

double length(double t) { return 2.0 - std::exp(-t); }
double breadth(double t) { return std::exp(-0.3 * t); }

Benchmark reference() {
  return {.name = "made-up",
          .title = "A drop",
          .licence = "",
          .columns = {{"L", "R0", "length", 1e-7, 0.01}, {"B", "R0", "breadth", 1e-7, 0.01}},
          .table = sampled({"t", "L", "B"}, 0.0, 4.0, 80, length, breadth)};
}

std::string refusal(const io::Table& table, const std::vector<std::string>& chosen = {}) {
  try {
    (void)compare_with_benchmark(reference(), table, "mine.csv", chosen);
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "accepted";
}

TEST(BenchmarkComparison, FindsAKnownDifferenceOverTheOverlap) {
  // Off by 0.02 sin 3t, which is largest at π/6 and at π/2, and of root-mean-square 0.02/√2 over
  // periods.
  const io::Table mine = sampled({"t", "B", "L"}, -1.0, 2.0 * M_PI / 3.0, 1000, breadth,
                                 [](double t) { return length(t) + 0.02 * std::sin(3.0 * t); });
  const BenchmarkComparison found = compare_with_benchmark(reference(), mine, "mine.csv", {});
  ASSERT_EQ(found.columns.size(), 2U);
  EXPECT_TRUE(found.missing.empty());
  const ColumnDifference& L = found.columns[0];
  EXPECT_EQ(L.begin, 0.0);
  EXPECT_NEAR(L.end, 2.0 * M_PI / 3.0, 1e-12);
  EXPECT_EQ(L.compared, 42);  // rows of the benchmark: 0, 0.05 … 2.05
  // The row at 1.55 is the nearest to an extremum, that at π/2.
  EXPECT_NEAR(L.largest, 0.02 * std::cos(3.0 * (0.5 * M_PI - 1.55)), 1e-8);
  EXPECT_NEAR(L.rms, 0.02 / std::sqrt(2.0), 5e-4);
  EXPECT_FALSE(L.is_within());
  EXPECT_LT(found.columns[1].largest, 1e-9);  // cubics through rows 0.003 apart
  EXPECT_TRUE(found.columns[1].is_within());
}

TEST(BenchmarkComparison, TakesTheRowsOfTheCoarserTable) {
  const io::Table mine =
      sampled({"t", "L"}, 0.5, 3.5, 3, [](double t) { return length(t) - 0.005; });
  const BenchmarkComparison found = compare_with_benchmark(reference(), mine, "mine.csv", {});
  ASSERT_EQ(found.columns.size(), 1U);
  EXPECT_EQ(found.columns[0].compared, 4);
  EXPECT_NEAR(found.columns[0].rms, 0.005, 1e-6);
  EXPECT_EQ(found.missing, std::vector<std::string>{"B"});
  EXPECT_THAT(comparison_text(reference(), found, "mine.csv"), HasSubstr("not in mine.csv: B"));
}

TEST(BenchmarkComparison, LeavesOutEmptyCellsAndColumnsNotChosen) {
  io::Table mine = sampled({"t", "L", "B"}, 0.0, 4.0, 40, length, breadth);
  mine.rows[3][1].clear();
  const BenchmarkComparison found = compare_with_benchmark(reference(), mine, "mine.csv", {"L"});
  ASSERT_EQ(found.columns.size(), 1U);
  EXPECT_EQ(found.columns[0].compared, 40);
  EXPECT_THAT(comparison_csv(found), HasSubstr("\nL,R0,0,4,40,0,"));
}

TEST(BenchmarkComparison, RefusesInOneLine) {
  const auto table = [](const std::vector<std::string>& columns) {
    return sampled(columns, 0.0, 1.0, 4, length);
  };
  EXPECT_THAT(refusal(table({"time", "L"})),
              HasSubstr("mine.csv: has no column `t`; it has time, L"));
  EXPECT_THAT(refusal(table({"t", "length"})), HasSubstr("none of the columns L, B"));
  EXPECT_THAT(refusal(table({"t", "L"}), {"B"}), HasSubstr("mine.csv: has no column B"));
  EXPECT_THAT(refusal(table({"t", "L"}), {"W"}),
              HasSubstr("W is not one of benchmark made-up's: L, B"));
  EXPECT_THAT(refusal(sampled({"t", "L"}, 5.0, 6.0, 4, length)), HasSubstr("does not overlap"));
  io::Table mine = table({"t", "L"});
  mine.rows[2][0] = "0.1";
  EXPECT_THAT(refusal(mine), HasSubstr("row 3 below the header: t = 0.1 does not rise from 0.25"));
  for (const char* cell : {"nan", "one", "1.0x"}) {
    mine = table({"t", "L"});
    mine.rows[1][1] = cell;
    EXPECT_THAT(refusal(mine), HasSubstr("row 2 below the header: L = `")) << cell;
  }
}

}  // namespace
}  // namespace meniscus
