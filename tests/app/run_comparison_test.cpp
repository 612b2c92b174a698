#include "meniscus/app/run_comparison.hpp"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

using Measure = CheckedQuantity::Measure;

/// Two drops, D = f(t) + drop, y = (1 − 2·drop)·t, over t = 0, 0.1 … 2.
template <class F>
RunTables made_run(F f, double drift = 0.0) {
  RunTables run;
  run.drops.columns = {"step", "t", "drop", "volume_drift", "y", "D"};
  run.history.columns = {"step", "t", "min_gap"};
  for (int step = 0; step <= 20; ++step) {
    const double t = 0.1 * step;
    const std::string k = std::to_string(step), time = fmt::format("{}", t);
    for (int drop = 0; drop < 2; ++drop)
      run.drops.rows.push_back({k, time, std::to_string(drop), fmt::format("{}", drift),
                                fmt::format("{}", (1 - 2 * drop) * t),
                                fmt::format("{}", f(t) + drop)});
    run.history.rows.push_back({k, time, fmt::format("{}", 1.0 + (t - 1.0) * (t - 1.0))});
  }
  return run;
}

CheckedQuantity quantity(const std::string& column) {
  CheckedQuantity result;
  result.column = column;
  result.tolerance = 0.01;
  return result;
}

CheckRow only_row(const CheckedQuantity& q, const std::optional<io::Table>& reference = {}) {
  CheckFile check;
  check.runs = {{"one", {}, false, {q}}, {"other", {}, false, {}}};
  const std::map<std::string, RunTables> runs = {
      {"one", made_run([](double t) { return t * t; })},
      {"other", made_run([](double t) { return 1.02 * t * t; })}};
  return compare("a case", check, runs, reference).at(0);
}

io::Table reference_of(double factor) {
  return {{"t", "D"},
          {{"0", "0"},
           {"0.5", fmt::format("{}", 0.25 * factor)},
           {"1", fmt::format("{}", factor)},
           {"3", fmt::format("{}", 9.0 * factor)}}};
}

TEST(RunComparison, TakesAnEventsRowAndSaysSoWhereThereIsNone) {
  RunTables run = made_run([](double t) { return t; });
  run.events = {{"step", "t", "x"}, {{"4", "0.4", "-2.8"}, {"5", "0.5", "2.9"}}};
  CheckFile check;
  CheckedQuantity q = quantity("x");
  q.measure = Measure::last;
  q.reference = 2.88;
  q.is_absolute = true;
  for (const int event : {0, 1, 2}) {
    q.event = event;
    check.runs.assign(1, {"one", {}, false, {q}});
    const CheckRow row = compare("a case", check, {{"one", run}}, std::nullopt).at(0);
    EXPECT_EQ(row.quantity, fmt::format("x of event {}", event));
    ASSERT_EQ(row.worst.has_value(), event < 2);
    if (event == 1) {
      EXPECT_NEAR(row.worst->deviation, 0.02, 1e-12);
    }
  }
}

TEST(RunComparison, FindsTheWorstPlaceOfACurveWithinTheRun) {
  const CheckRow row = only_row(quantity("D"), reference_of(1.005));
  ASSERT_TRUE(row.worst);
  EXPECT_EQ(row.compared, 2);  // neither t = 0, where D = 0, nor t = 3, which the run never reached
  EXPECT_NEAR(row.worst->deviation, 1.0 / 1.005 - 1.0, 1e-12);
  EXPECT_TRUE(row.passes());
  EXPECT_FALSE(only_row(quantity("D"), reference_of(1.02)).passes());
}

TEST(RunComparison, TakesADifferenceOfDropsAndAnExtreme) {
  CheckedQuantity q = quantity("y");
  q.minus_drop = 1;
  q.measure = Measure::largest;
  q.reference = 4.0;
  const CheckRow row = only_row(q);
  ASSERT_TRUE(row.worst);
  EXPECT_DOUBLE_EQ(row.worst->measured, 4.0);
}

TEST(RunComparison, TakesTheExtremeOverAllDropsAndTheMagnitude) {
  CheckedQuantity q = quantity("y");
  q.is_of_all_drops = true;
  q.measure = Measure::smallest;
  q.reference = -2.0;
  const CheckRow row = only_row(q);
  EXPECT_EQ(row.quantity, "smallest y of all drops");
  ASSERT_TRUE(row.worst);
  EXPECT_DOUBLE_EQ(row.worst->measured, -2.0);
  q.is_magnitude = true;
  const CheckRow magnitude = only_row(q);
  EXPECT_EQ(magnitude.quantity, "smallest |y| of all drops");
  ASSERT_TRUE(magnitude.worst);
  EXPECT_DOUBLE_EQ(magnitude.worst->measured, 2.0);
}

TEST(RunComparison, LeavesEmptyCellsOutOfTheExtremeOverAllDrops) {
  RunTables run = made_run([](double t) { return 1.0 + t; });
  for (std::size_t row : {0U, 7U}) run.drops.rows[row].back() = "";
  CheckedQuantity q = quantity("D");
  q.is_of_all_drops = true;
  q.measure = Measure::largest;
  q.reference = 4.0;
  CheckFile check;
  check.runs.assign(1, {"one", {}, false, {q}});
  const CheckRow row = compare("a case", check, {{"one", run}}, std::nullopt).at(0);
  ASSERT_TRUE(row.worst);
  EXPECT_DOUBLE_EQ(row.worst->measured, 4.0);  // of drop 1 at t = 2
}

TEST(RunComparison, ReadsTheHistoryWhereDropsHaveNoSuchColumn) {
  CheckedQuantity q = quantity("min_gap");
  q.measure = Measure::smallest;
  q.reference = 1.1;
  q.is_absolute = true;
  const CheckRow row = only_row(q);
  ASSERT_TRUE(row.worst);
  EXPECT_NEAR(row.worst->deviation, -0.1, 1e-12);
  EXPECT_FALSE(row.passes());
}

TEST(RunComparison, ComparesTwoRunsOverTheirCommonRange) {
  CheckedQuantity q = quantity("D");
  q.against = "other";
  const CheckRow row = only_row(q);
  ASSERT_TRUE(row.worst);
  EXPECT_EQ(row.compared, 50);  // of 51 places one is t = 0
  EXPECT_NEAR(row.worst->deviation, 1.0 / 1.02 - 1.0, 1e-9);
}

TEST(RunComparison, ExtrapolatesAnErrorInInverseNodesAway) {
  CheckFile check;
  std::map<std::string, RunTables> runs;
  CheckedExtrapolation entry;
  entry.name = "limit";
  entry.quantity = quantity("D");
  entry.quantity.at = {1.0};
  entry.quantity.reference = 0.5;
  for (const int nodes : {100, 200, 400}) {
    const std::string name = std::to_string(nodes);
    check.runs.push_back({name, {}, false, {}});
    runs[name] = made_run([&](double t) { return 0.5 * t + 3.0 / nodes; });
    entry.runs.push_back(name);
    entry.nodes.push_back(nodes);
  }
  check.extrapolations = {entry};
  const std::vector<CheckRow> rows = compare("a case", check, runs, {});
  ASSERT_EQ(rows.size(), 4U);  // drift of three runs, then the limit
  ASSERT_TRUE(rows[3].worst);
  EXPECT_NEAR(rows[3].worst->measured, 0.5, 1e-12);
  runs.erase("200");
  EXPECT_FALSE(compare("a case", check, runs, {}).back().worst);
}

TEST(RunComparison, HoldsTheVolumeOfEveryRun) {
  CheckFile check;
  check.runs = {{"one", {}, false, {}}};
  const auto drifting = [&](double drift) {
    return compare("a case", check, {{"one", made_run([](double) { return 0.0; }, drift)}}, {});
  };
  EXPECT_TRUE(drifting(-1e-7).at(0).passes());
  EXPECT_FALSE(drifting(-1e-5).at(0).passes());
}

// Each drop is shifted by 0.006 in each of 20 steps; what step 0 has is of the shape as given.
TEST(RunComparison, HoldsTheSumOfVolumeCorrectionsOfRunsWithAllTheirSteps) {
  RunTables run = made_run([](double) { return 0.0; });
  run.drops.columns.emplace_back("volume_correction");
  for (std::vector<std::string>& row : run.drops.rows)
    row.emplace_back(row[0] == "0" ? "0.5" : "0.006");
  CheckFile check;
  check.runs = {{"one", {}, false, {}}};
  const std::vector<CheckRow> rows = compare("a case", check, {{"one", run}}, {});
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[1].quantity, "sum of volume_correction");
  EXPECT_NEAR(rows[1].worst->measured, 0.12, 1e-12);
  EXPECT_FALSE(rows[1].passes());  // 0.1 unless the check says otherwise
  check.runs[0].most_correction = 0.13;
  EXPECT_TRUE(compare("a case", check, {{"one", run}}, {}).at(1).passes());
  run.history.rows.erase(run.history.rows.begin() + 5);  // as a record leaves steps out
  EXPECT_EQ(compare("a case", check, {{"one", run}}, {}).size(), 1U);
}

TEST(RunComparison, InterpolatesAFallingAbscissaToo) {
  const Series series{{3.0, 2.0, 1.0}, {30.0, 20.0, 10.0}};
  EXPECT_DOUBLE_EQ(value_at(series, 2.5).value(), 25.0);
  EXPECT_FALSE(value_at(series, 0.5));
}

TEST(RunComparison, InterpolatesCubicallyWhereTheAbscissaGoesOneWay) {
  const auto cubic = [](double x) { return 1.0 + x * (2.0 + x * (-3.0 + x)); };
  Series series;
  for (const double x : {0.0, 0.5, 1.5, 2.0, 4.0}) {
    series.x.push_back(x);
    series.y.push_back(cubic(x));
  }
  EXPECT_NEAR(value_at(series, 0.9).value(), cubic(0.9), 1e-14);
  EXPECT_NEAR(value_at(series, 1.7).value(), cubic(1.7), 1e-14);
  EXPECT_DOUBLE_EQ(value_at(series, 0.1).value(), 1.0 + 0.2 * (cubic(0.5) - 1.0));  // an end
  for (double& x : series.x) x = -x;
  EXPECT_NEAR(value_at(series, -1.7).value(), cubic(1.7), 1e-14);
  const Series turning{{0.0, 1.0, 2.0, 1.5}, {0.0, 1.0, 4.0, 9.0}};
  EXPECT_DOUBLE_EQ(value_at(turning, 1.5).value(), 2.5);
}

TEST(RunComparison, NamesAColumnThatNoTableHas) {
  EXPECT_THROW((void)only_row(quantity("Q"), reference_of(1.0)), InvalidInput);
}

}  // namespace
}  // namespace meniscus
