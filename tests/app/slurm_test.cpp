#include "meniscus/app/slurm.hpp"

#include <gtest/gtest.h>

namespace meniscus {
namespace {

TEST(Slurm, ReadsTheTasksOfArraysAndNothingElse) {
  const std::vector<QueuedTask> tasks = parse_queue(
      "RUNNING 12 0 /home/a/curve/slurm/0.sh\n"
      "PENDING 12 31 /home/a/curve/slurm/0.sh\n"
      "COMPLETED    7 2    /data/two words/slurm/1.sh\n"
      "RUNNING 13 N/A /home/a/one.sh\n"     // a job of no array
      "PENDING 14 [3-9] /home/a/more.sh\n"  // tasks that squeue has put together
      "PENDING 15 4%2 /home/a/more.sh\n"
      "slurm_load_jobs error: Unable to contact slurm controller\n"
      "\n"
      "RUNNING 16");
  ASSERT_EQ(tasks.size(), 3U);
  EXPECT_EQ(tasks[0].job, "12_0");
  EXPECT_EQ(tasks[0].state, "RUNNING");
  EXPECT_EQ(tasks[0].index, 0U);
  EXPECT_EQ(tasks[0].script, "/home/a/curve/slurm/0.sh");
  EXPECT_EQ(tasks[1].job, "12_31");
  EXPECT_EQ(tasks[1].index, 31U);
  EXPECT_EQ(tasks[2].job, "7_2");
  EXPECT_EQ(tasks[2].script, "/data/two words/slurm/1.sh");
  EXPECT_TRUE(parse_queue("").empty());
}

TEST(Slurm, KnowsWhichTasksAreOver) {
  const auto is_over = [](const char* state) {
    return QueuedTask{"12_0", state, "a.sh", 0}.is_over();
  };
  for (const char* state : {"COMPLETED", "CANCELLED", "FAILED", "TIMEOUT", "NODE_FAIL", "PREEMPTED",
                            "BOOT_FAIL", "DEADLINE", "OUT_OF_MEMORY"})
    EXPECT_TRUE(is_over(state)) << state;
  for (const char* state : {"PENDING", "CONFIGURING", "RUNNING", "COMPLETING", "SUSPENDED", ""})
    EXPECT_FALSE(is_over(state)) << state;
}

TEST(Slurm, ScriptsNameTheirTasksInOrder) {
  const std::vector<ArrayTask> tasks{
      {"a run", {"meniscus", "run", "it's.toml"}, "a.log", "a.status"},
      {"b", {"meniscus", "run", "b.toml"}, "b.log", "b.status"}};
  EXPECT_EQ(names_in_script(array_script(tasks)), (std::vector<std::string>{"a run", "b"}));
}

}  // namespace
}  // namespace meniscus
