#include "meniscus/app/ranks.hpp"

#include <csignal>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "meniscus/app/interrupt.hpp"
#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

TEST(OneRank, CallsWhatItIsGivenAndPassesOnWhatThatThrows) {
  EXPECT_EQ(num_ranks(), 1);
  EXPECT_TRUE(is_first_rank());
  EXPECT_TRUE(any_rank(true));
  EXPECT_FALSE(any_rank(false));
  int calls = 0;
  on_first_rank([&] { ++calls; });
  EXPECT_EQ(calls, 1);
  on_first_and_last_rank([&] { calls *= 2; }, [&] { calls += 5; });
  EXPECT_EQ(calls, 7);
  EXPECT_THROW(on_first_and_last_rank([] {}, [] { throw RunFailure("no"); }), RunFailure);
  EXPECT_EQ(text_of_first_rank("frame"), "frame");
  EXPECT_EQ(on_all_ranks([] { return 7; }), 7);
  EXPECT_THROW(on_first_rank([] { throw InvalidInput("no"); }), InvalidInput);
  EXPECT_THROW((void)on_all_ranks([]() -> int { throw RunFailure("no"); }), RunFailure);
  require_all_failed(RunFailure("alone, which is all"));  // returns
}

// In a process of its own: a signal once seen is not forgotten.
TEST(Interrupt, ASignalIsSeenAndDoesNotEndTheProgram) {
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      watch_for_interrupts();
      const bool was = is_interrupted();
      (void)raise(signal);
      _exit(!was && is_interrupted() ? 0 : 1);
    }
    int status = -1;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << signal;
  }
}

}  // namespace
}  // namespace meniscus
