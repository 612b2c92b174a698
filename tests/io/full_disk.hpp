#pragma once

#include <csignal>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace meniscus::test {

/// Runs `action` in a child process in which no file can grow above `limit` bytes, as on a disk
/// that fills; true if it returned true.
template <class Action>
bool holds_on_full_disk(rlim_t limit, Action action) {
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit size = {limit, limit};
    bool is_true = ::setrlimit(RLIMIT_FSIZE, &size) == 0;
    try {
      is_true = is_true && action();
    } catch (...) {
      is_true = false;
    }
    ::_exit(is_true ? 0 : 1);
  }
  int status = 1;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace meniscus::test
