#include "meniscus/app/simulation.hpp"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numeric>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "meniscus/case/case.hpp"
#include "tests/io/temporary_folder.hpp"

namespace meniscus {
namespace {

/// Seconds of the clock, and by phase, since a row of a run.
struct Spent {
  double wall = 0.0, in_phases = 0.0;
  int events = 0;  // changes of topology
};

int lines_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  int count = 0;
  for (std::string line; std::getline(stream, line);) ++count;
  return count;
}

/// From the first row of a case to its last.
Spent spent_between_rows(const std::string& text) {
  using Clock = std::chrono::steady_clock;
  const test::TemporaryFolder folder;
  const Case c = parse_case(text, "case.toml");
  Evolution evolution(build_scene(c), c.evolution, make_flow_solver(c), make_moving_mesh(c));
  EXPECT_TRUE(evolution.prepare().ok());
  Simulation simulation(std::move(evolution), RunDirectory::create(folder / "run", false), c.output,
                        [](Archive&) {});
  const auto in_phases = [&] {
    double sum = 0.0;
    for (const auto& [phase, seconds] : simulation.seconds()) sum += seconds;
    return sum;
  };
  bool is_first = true;
  Clock::time_point start;
  Spent spent;
  double at_start = 0.0;
  simulation.set_observer([&](const RunDirectory&) {
    if (is_first) {
      start = Clock::now();
      at_start = in_phases();
    }
    is_first = false;
    spent = {std::chrono::duration<double>(Clock::now() - start).count(), in_phases() - at_start,
             lines_of(folder / "run/events.csv") - 1};
  });
  Progress progress(0.0, 1.0, true);
  EXPECT_EQ(simulation.run(progress), Outcome::done);
  return spent;
}

// A preemption between two timers counts against them: runs of a second make it small.
TEST(Simulation, PhasesHoldAllOfTheTime) {
  const std::string drop = "[flow]\nkind = \"quiescent\"\n[[drop]]\naxes = [1.3, 1.3, 0.59]\n";
  for (const std::string& more :
       {std::string("nodes = 200\n[time]\nend = 0.1\n"),
        std::string("nodes = 60\n[time]\nend = 0.1\n[solver]\nelements = \"P2-P1\"\n"),
        std::string("nodes = 400\n[time]\nend = 1.0\n[domain]\nshape = \"unbounded\"\n"
                    "[solver]\nmethod = \"boundary-integral\"\n")}) {
    const Spent spent = spent_between_rows(drop + more);
    std::printf("%.3f of %.3f s\n", spent.in_phases, spent.wall);
    EXPECT_GT(spent.wall, 0.0);
    EXPECT_GE(spent.in_phases, 0.97 * spent.wall) << more;
    EXPECT_LE(spent.in_phases, 1.001 * spent.wall) << more;
  }
}

TEST(Simulation, PhasesHoldAllOfTheTimeOfTwoDropsThatMerge) {
  const auto drops = [](int nodes, const std::string& more) {
    return fmt::format(
        "[flow]\nkind = \"planar-extension\"\ncapillary-number = 0.1\n"
        "[[drop]]\ncenter = [0, 0.83, 0]\nradius = 0.79\nnodes = {0}\n"
        "[[drop]]\ncenter = [0, -0.83, 0]\nradius = 0.79\nnodes = {0}\n"
        "[topology]\ncoalescence-gap = 0.12\n[time]\nmax-step = 0.02\n{1}",
        nodes, more);
  };
  for (const std::string& text :
       {drops(80, "end = 0.1\n"), drops(200,
                                        "end = 0.3\n[domain]\nshape = \"unbounded\"\n"
                                        "[solver]\nmethod = \"boundary-integral\"\n")}) {
    const Spent spent = spent_between_rows(text);
    std::printf("%.3f of %.3f s\n", spent.in_phases, spent.wall);
    EXPECT_EQ(spent.events, 1) << text;
    EXPECT_GE(spent.in_phases, 0.97 * spent.wall) << text;
    EXPECT_LE(spent.in_phases, 1.001 * spent.wall) << text;
  }
}

}  // namespace
}  // namespace meniscus
