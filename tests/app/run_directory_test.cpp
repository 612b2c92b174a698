#include "meniscus/app/run_directory.hpp"

#include <csignal>
#include <optional>
#include <set>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "meniscus/core/error.hpp"
#include "tests/io/temporary_folder.hpp"

namespace meniscus {
namespace {

std::string refusal(auto&& action) {
  try {
    action();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

TEST(RunDirectory, IsOneProgramsAlone) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "run";
  std::optional<RunDirectory> first = RunDirectory::create(path, false);
  const std::string expected =
      path.string() + " is being written by process " + std::to_string(getpid());
  EXPECT_EQ(refusal([&] { (void)RunDirectory::create(path, true); }), expected);
  EXPECT_EQ(refusal([&] { (void)RunDirectory::take_up(path, 0, 0.0); }), expected);
  EXPECT_TRUE(holds_run(path));  // what is refused removes nothing
  first.reset();
  EXPECT_EQ(refusal([&] { (void)RunDirectory::take_up(path, 0, 0.0); }), "");
}

TEST(RunDirectory, IsFreeAgainWhenItsProgramIsKilled) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "run";
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const RunDirectory mine = RunDirectory::create(path, false);
    (void)!write(ready[1], "x", 1);
    pause();
    _exit(0);
  }
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  EXPECT_NE(refusal([&] { (void)RunDirectory::create(path, true); }).find(std::to_string(child)),
            std::string::npos);
  ASSERT_EQ(kill(child, SIGKILL), 0);
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
  EXPECT_EQ(refusal([&] { (void)RunDirectory::create(path, true); }), "");
  close(ready[0]);
  close(ready[1]);
}

std::set<std::string> names_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.insert(entry.path().filename().string());
  return names;
}

HistoryRow row_of_step(std::int64_t step) {
  HistoryRow row;
  row.step = step;
  row.t = 0.1 * static_cast<double>(step);
  row.drops = 1;
  return row;
}

TEST(RunDirectory, KeepsTheLastTwoCheckpointsAndThoseAroundEvents) {
  const test::TemporaryFolder folder;
  RunDirectory run = RunDirectory::create(folder / "run", false);
  for (std::int64_t step = 0; step <= 5; ++step) {
    TopologyEvent event;
    event.neck_radius = 0.01;
    HistoryRow history;
    history.step = step;
    if (step == 2) run.add_events(history, {event});
    run.write_checkpoint({}, step);
  }
  const std::set<std::string> names = names_in(run.path());
  std::set<std::string> expected{"history.csv", "drops.csv", "events.csv", "timing.csv"};
  for (const int step : {1, 2, 4, 5})
    expected.insert("checkpoint-00000" + std::to_string(step) + ".h5");
  EXPECT_EQ(names, expected);
  EXPECT_EQ(newest_checkpoint(run.path()).filename(), "checkpoint-000005.h5");
}

TEST(RunDirectory, TakenUpItDropsTheRowsToBeMadeAgainAndKeepsTheRest) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "run";
  {
    RunDirectory run = RunDirectory::create(path, false);
    for (std::int64_t step = 0; step <= 3; ++step) run.add_rows(row_of_step(step), {DropRow()});
  }
  RunDirectory run = RunDirectory::take_up(path, 2, 0.2);
  EXPECT_EQ(io::read_table(path / "history.csv").column("step"), (std::vector{0.0, 1.0}));
  EXPECT_EQ(io::read_table(path / "drops.csv").column("step"), (std::vector{0.0, 1.0}));
  run.add_rows(row_of_step(2), {DropRow()});
  EXPECT_EQ(io::read_table(path / "history.csv").column("step"), (std::vector{0.0, 1.0, 2.0}));
}

TEST(RunDirectory, TakenUpItHasTheColumnsOfItsBulkScalars) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "run";
  const std::vector<Scalar> scalars{{.name = "heat"}};
  const auto add = [](RunDirectory& run, std::int64_t step) {
    HistoryRow history = row_of_step(step);
    history.scalars.resize(1);
    history.scalars[0].amount = 2.5;
    DropRow drop;
    drop.scalars.resize(1);
    run.add_rows(history, {drop});
    run.add_timing(step, history.t, {{"scalars", 0.5}});
  };
  {
    RunDirectory run = RunDirectory::create(path, false, {scalars});
    add(run, 0);
    add(run, 1);
  }
  const std::string history = test::get(path / "history.csv"),
                    drops = test::get(path / "drops.csv");
  {
    RunDirectory run = RunDirectory::take_up(path, 1, 0.1, {scalars});
    add(run, 1);
  }
  EXPECT_EQ(test::get(path / "history.csv"), history);
  EXPECT_EQ(test::get(path / "drops.csv"), drops);
  EXPECT_EQ(io::read_table(path / "history.csv").column("heat_total"), (std::vector{2.5, 2.5}));
  EXPECT_EQ(io::read_table(path / "timing.csv").column("scalars"), (std::vector{0.5, 0.5}));
  EXPECT_NE(refusal([&] { (void)RunDirectory::take_up(path, 1, 0.1); }).find("the header is not"),
            std::string::npos);
}

TEST(RunDirectory, ANewRunRemovesTheFilesOfTheOldOneAndNoOther) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "run";
  {
    RunDirectory run = RunDirectory::create(path, false);
    run.add_rows(row_of_step(0), {DropRow()});
    run.write_text("run.json", "{}");
    run.write_checkpoint({}, 0);
    std::filesystem::create_directories(path / "surface");
    test::put(path / "surface" / "surface-000000.vtp", "x");
  }
  test::put(path / "notes.txt", "mine");
  EXPECT_NE(refusal([&] { (void)RunDirectory::create(path, false); }).find("--overwrite"),
            std::string::npos);
  (void)RunDirectory::create(path, true);
  EXPECT_EQ(names_in(path), (std::set<std::string>{"history.csv", "drops.csv", "events.csv",
                                                   "timing.csv", "notes.txt"}));
}

TEST(RunDirectory, RefusesAPathThroughAFile) {
  const test::TemporaryFolder folder;
  test::put(folder / "file", "x");
  EXPECT_NE(refusal([&] { require_usable(folder / "file" / "run", true); }).find("is a file"),
            std::string::npos);
  EXPECT_NE(refusal([&] { (void)newest_checkpoint(folder / "none"); }).find("not the folder"),
            std::string::npos);
}

}  // namespace
}  // namespace meniscus
