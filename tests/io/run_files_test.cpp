#include "meniscus/io/run_files.hpp"

#include <gtest/gtest.h>

#include "tests/io/temporary_folder.hpp"

namespace meniscus::io {
namespace {

TEST(RunFiles, CheckpointsComeInRisingOrderOfStepAndNothingElseDoes) {
  const test::TemporaryFolder folder;
  for (const char* name :
       {"checkpoint-1000000.h5", "checkpoint-000020.h5", "checkpoint-000003.h5", "checkpoint-.h5",
        "checkpoint-12x.h5", "checkpoint-5.h5.tmp", "run.json"})
    test::put(folder / name, "");
  std::vector<std::int64_t> steps;
  for (const auto& [step, file] : checkpoints(folder.path())) {
    steps.push_back(step);
    EXPECT_EQ(file.filename(), checkpoint_name(step));
  }
  EXPECT_EQ(steps, (std::vector<std::int64_t>{3, 20, 1000000}));
  EXPECT_TRUE(checkpoints(folder / "missing").empty());
}

}  // namespace
}  // namespace meniscus::io
