#include "meniscus/core/timer.hpp"

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

namespace meniscus {
namespace {

using std::chrono::milliseconds;

TEST(PhaseTimes, AddUpByPhase) {
  PhaseTimes times;
  EXPECT_EQ(times["solve"], 0.0);
  EXPECT_TRUE(times.all().empty());  // asking makes no phase
  times.add("solve", 1.5);
  times.add("assemble", 0.25);
  times.add("solve", 2.0);
  EXPECT_EQ(times["solve"], 3.5);
  EXPECT_EQ(times["assemble"], 0.25);
  EXPECT_EQ(times.all().size(), 2u);
}

// A sleep lasts at least as long as asked, and a phase at most as long as what surrounds it: bounds
// that hold on a machine however busy.
TEST(PhaseTimer, AddsTheLifeOfItsScope) {
  PhaseTimes times;
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < 2; ++i) {
    const PhaseTimer timer(times, "sleep");
    std::this_thread::sleep_for(milliseconds(5));
    EXPECT_EQ(times["sleep"] > 0.0, i == 1);  // nothing is added before the end
  }
  const std::chrono::duration<double> all = std::chrono::steady_clock::now() - start;
  EXPECT_GE(times["sleep"], 0.010);
  EXPECT_LE(times["sleep"], all.count());
}

TEST(RemainderTimer, AddsWhatNoPhaseWithinItTook) {
  PhaseTimes times;
  times.add("solve", 1e3);  // of before
  const auto start = std::chrono::steady_clock::now();
  {
    const RemainderTimer timer(times, "assemble");
    std::this_thread::sleep_for(milliseconds(5));
    const PhaseTimer inner(times, "solve");
    std::this_thread::sleep_for(milliseconds(10));
  }
  const std::chrono::duration<double> all = std::chrono::steady_clock::now() - start;
  EXPECT_GE(times["solve"] - 1e3, 0.010);
  EXPECT_GE(times["assemble"], 0.0049);
  EXPECT_LE(times.sum() - 1e3, all.count());
}

TEST(PhaseTimer, CountsAPhaseThatThrows) {
  PhaseTimes times;
  try {
    const PhaseTimer timer(times, "throwing");
    std::this_thread::sleep_for(milliseconds(1));
    throw 1;
  } catch (int) {
  }
  EXPECT_GE(times["throwing"], 0.001);
}

}  // namespace
}  // namespace meniscus
