#include "meniscus/report/comparison.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"
#include "meniscus/report/report.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/report/synthetic_run.hpp"

namespace meniscus {
namespace {

using report::Difference;
using test::get;
using test::message_of;
using test::put;
namespace fs = std::filesystem;

report::RunData run_with(const test::TemporaryFolder& folder, const std::string& name,
                         const std::string& drops) {
  fs::create_directories(folder / name);
  put(folder / (name + "/history.csv"), "step,t\n0,0\n");
  put(folder / (name + "/drops.csv"), "step,t,drop,D\n" + drops);
  return report::load_run(folder / name);
}

TEST(Comparison, LinearBetweenRows) {
  const double t[] = {0.0, 1.0, 3.0}, y[] = {1.0, 2.0, -2.0};
  EXPECT_EQ(report::value_at(t, y, 0.0), 1.0);
  EXPECT_EQ(report::value_at(t, y, 3.0), -2.0);
  EXPECT_DOUBLE_EQ(report::value_at(t, y, 2.0), 0.0);
  EXPECT_TRUE(std::isnan(report::value_at(t, y, 3.1)));
  EXPECT_TRUE(std::isnan(report::value_at(t, y, -0.1)));
}

/// D = t against a triangle with rows at other times: |difference| is largest at its corner, 0.5 at
/// t = 1, and the later rows of the longer run do not count.
TEST(Comparison, LargestDifferenceIsAtARowOfEither) {
  const test::TemporaryFolder folder;
  const report::RunData first = run_with(folder, "a", "0,0,0,0\n1,2,0,2\n2,4,0,9\n");
  const report::RunData second = run_with(folder, "b", "0,0,0,0\n1,1,0,1.5\n2,2,0,2.1\n");
  const report::RunData runs[] = {first, second};
  EXPECT_EQ(report::common_end(runs), 2.0);
  const std::vector<Difference> list = report::differences(first, second, 2.0);
  ASSERT_EQ(list.size(), 1U);
  EXPECT_EQ(list[0].quantity, "D");
  EXPECT_DOUBLE_EQ(list[0].largest, 0.5);
  EXPECT_EQ(list[0].t_of_largest, 1.0);
  EXPECT_DOUBLE_EQ(list[0].at_end, 2.1);
  EXPECT_DOUBLE_EQ(list[0].first_at_end, 2.0);
}

TEST(Comparison, DropsThatOnlyOneHasAreLeftOut) {
  const test::TemporaryFolder folder;
  const report::RunData first = run_with(folder, "a", "0,0,0,0\n0,0,1,5\n1,2,0,2\n1,2,1,5\n");
  const report::RunData second = run_with(folder, "b", "0,0,1,5\n1,2,1,6\n");
  const std::vector<Difference> list = report::differences(first, second, 2.0);
  ASSERT_EQ(list.size(), 1U);
  EXPECT_EQ(list[0].drop, 1);
  EXPECT_EQ(list[0].largest, 1.0);
}

TEST(Comparison, PageShowsAllRuns) {
  const test::TemporaryFolder folder;
  test::write_synthetic_run(folder / "coarse", {.num_frames = 5, .num_vertices = 60});
  test::write_synthetic_run(folder / "fine", {.num_frames = 9, .num_vertices = 200});
  const fs::path folders[] = {folder / "coarse", folder / "fine"};
  write_comparison(folders, folder / "both.html");
  const std::string page = get(folder / "both.html");
  for (const char* part : {"<title>coarse, fine</title>", "2 runs compared", "fine against coarse",
                           "D of drop 0", "id=\"app\""}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
  write_comparison(folders, folder / "again.html");
  EXPECT_EQ(get(folder / "again.html"), page);
}

TEST(Comparison, NamesAreAsLongAsTheyMustBe) {
  const test::TemporaryFolder folder;
  std::vector<fs::path> folders;
  for (const char* name : {"a/x/run", "b/x/run", "b/y/run", "other"}) {
    folders.push_back(folder / name);
    test::write_synthetic_run(folders.back(), {.num_frames = 1, .num_vertices = 60});
  }
  write_comparison(folders, folder / "all.html");
  EXPECT_NE(get(folder / "all.html").find("<title>a/x/run, b/x/run, y/run, other</title>"),
            std::string::npos);
}

TEST(Comparison, RefusesTooFewAndWhatIsNoRun) {
  const test::TemporaryFolder folder;
  test::write_synthetic_run(folder / "run", {.num_frames = 1});
  const fs::path one[] = {folder / "run"};
  EXPECT_EQ(message_of<InvalidInput>([&] { write_comparison(one, folder / "page.html"); }),
            "1 runs were given to compare; from 2 to 8 can be");
  const fs::path two[] = {folder / "run", folder / "none"};
  EXPECT_THROW(write_comparison(two, folder / "page.html"), InvalidInput);
  EXPECT_FALSE(fs::exists(folder / "page.html"));
}

}  // namespace
}  // namespace meniscus
