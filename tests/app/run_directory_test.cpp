#include "meniscus/app/run_directory.hpp"

#include <csignal>
#include <optional>

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

}  // namespace
}  // namespace meniscus
