#include "meniscus/core/child_process.hpp"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace meniscus {
namespace {

constexpr ChildLimits kLimits{.seconds = 60};

TEST(ChildProcess, SharesTheMemory) {
  std::vector<int> numbers;
  const ChildResult result = run_in_child([&] { numbers.assign(1000, 7); }, kLimits);
  EXPECT_EQ(result.failure, "");
  EXPECT_EQ(numbers, std::vector<int>(1000, 7));
}

TEST(ChildProcess, IsAnotherProcess) {
  pid_t child = 0;
  EXPECT_EQ(run_in_child([&] { child = getpid(); }, kLimits).failure, "");
  EXPECT_NE(child, 0);
  EXPECT_NE(child, getpid());
}

TEST(ChildProcess, TellsWhatIsThrown) {
  const auto thrown = [](auto fault) {
    return run_in_child([&] { throw fault; }, kLimits).failure;
  };
  EXPECT_EQ(thrown(std::runtime_error("facets meet")), "facets meet");
  EXPECT_EQ(thrown(std::bad_alloc()), "out of memory");
}

TEST(ChildProcess, TellsHowItCrashed) {
  for (int time = 0; time < 3; ++time) {  // the second crash must end as the first
    const ChildResult aborted = run_in_child(
        [] {
          std::fputs("the matrix is singular\nmore\n", stderr);
          std::abort();
        },
        kLimits);
    EXPECT_EQ(aborted.signal, SIGABRT);
    EXPECT_EQ(aborted.failure, "it was ended by signal 6 (Aborted): the matrix is singular");
    const ChildResult killed = run_in_child([] { std::raise(SIGSEGV); }, kLimits);
    EXPECT_EQ(killed.signal, SIGSEGV);
    EXPECT_EQ(run_in_child([] { _exit(0); }, kLimits).failure, "it ended without an answer");
  }
}

TEST(ChildProcess, EndsAnEndlessLoop) {
  const auto loop = [] {
    while (getpid() > 0) {
    }
  };
  EXPECT_EQ(run_in_child(loop, {.seconds = 1}).failure, "it took more than 1 s of processor time");
}

TEST(ChildProcess, TakesNoMoreMemoryThanAllowed) {
  constexpr std::size_t mebibyte = std::size_t{1} << 20U;
  const auto failure = [](std::size_t bytes) {
    return run_in_child([=] { const std::vector<char> taken(bytes); },
                        {.seconds = 60, .memory = 256 * mebibyte})
        .failure;
  };
  EXPECT_EQ(failure(64 * mebibyte), "");
  EXPECT_NE(failure(512 * mebibyte), "");
  const std::vector<char> here(512 * mebibyte);  // the limit is the child's alone
  EXPECT_EQ(here.back(), 0);
}

TEST(ChildProcess, LeavesFilesHandlersAndLimitsAlone) {
  rlimit before{}, after{};
  getrlimit(RLIMIT_CPU, &before);
  const auto handler = std::signal(SIGABRT, SIG_IGN);
  EXPECT_EQ(run_in_child([] { close(STDERR_FILENO); }, kLimits).failure, "");
  EXPECT_EQ(std::signal(SIGABRT, handler), SIG_IGN);
  getrlimit(RLIMIT_CPU, &after);
  EXPECT_EQ(before.rlim_cur, after.rlim_cur);
  EXPECT_NE(fcntl(STDERR_FILENO, F_GETFD), -1);
}

TEST(ChildProcess, TriesOnACopyOfTheMemory) {
  int number = 1;
  EXPECT_EQ(try_in_child([&] { number = 2; }, kLimits).failure, "");
  EXPECT_EQ(number, 1);
  const auto failure = [](auto work) { return try_in_child(work, kLimits).failure; };
  EXPECT_EQ(failure([] { throw std::runtime_error("an array is damaged"); }),
            "an array is damaged");
  EXPECT_EQ(failure([] { throw std::bad_alloc(); }), "out of memory");
  EXPECT_EQ(failure([] { std::raise(SIGSEGV); }), "it was ended by signal 11 (Segmentation fault)");
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);  // no child is left to be waited for
}

TEST(ChildProcess, LeavesNoProcessBehind) {
  for (int i = 0; i < 3; ++i) EXPECT_EQ(run_in_child([] {}, {.seconds = 1}).failure, "");
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);  // no child is left to be waited for
}

TEST(ChildProcess, ServesSeveralThreads) {
  std::vector<double> sums(8);
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < sums.size(); ++i)
      threads.emplace_back([&, i] {
        const auto add = [&] {
          for (int k = 0; k < 1000; ++k) sums[i] += std::vector<double>(100 + k, 1.0).back();
        };
        EXPECT_EQ(run_in_child(add, kLimits).failure, "");
      });
  }
  EXPECT_EQ(sums, std::vector<double>(sums.size(), 1000.0));
}

}  // namespace
}  // namespace meniscus
