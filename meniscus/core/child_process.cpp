#include "meniscus/core/child_process.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/asan_interface.h>
#endif

namespace meniscus {
namespace {

std::string reason(int error_number) { return std::generic_category().message(error_number); }

/// A pipe whose reads and writes never block. Bytes beyond its capacity are lost.
class Pipe {
 public:
  Pipe() : error_(pipe2(ends_.data(), O_CLOEXEC | O_NONBLOCK) == 0 ? 0 : errno) {}
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    for (const int end : ends_)
      if (end >= 0) close(end);
  }
  [[nodiscard]] int error() const { return error_; }
  [[nodiscard]] int writing() const { return ends_[1]; }
  /// The first line that was written to the pipe.
  [[nodiscard]] std::string first_line() const {
    std::array<char, 512> bytes;  // longest line that a message shows
    const ssize_t count = read(ends_[0], bytes.data(), bytes.size());
    const std::string text(bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    return text.substr(0, text.find('\n'));
  }

 private:
  std::array<int, 2> ends_{-1, -1};
  int error_ = 0;
};

/// Memory for the calls of the child, as large as a main thread's usually is.
class Stack {
 public:
  Stack()
      : begin_(mmap(nullptr, kSize, PROT_READ | PROT_WRITE,
                    MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_STACK, -1, 0)) {
    if (begin_ != MAP_FAILED) mprotect(begin_, kGuard, PROT_NONE);
  }
  Stack(const Stack&) = delete;
  Stack& operator=(const Stack&) = delete;
  ~Stack() {
    if (begin_ == MAP_FAILED) return;
#if defined(__SANITIZE_ADDRESS__)
    __asan_unpoison_memory_region(begin_, kSize);  // interrupted calls left their marks
#endif
    munmap(begin_, kSize);
  }
  [[nodiscard]] bool is_there() const { return begin_ != MAP_FAILED; }
  [[nodiscard]] void* top() const { return static_cast<std::byte*>(begin_) + kSize; }

 private:
  static constexpr std::size_t kSize = std::size_t{8} << 20U, kGuard = std::size_t{1} << 16U;
  void* begin_;
};

/// Bytes of addresses that this process has in use; 0 where the system does not say.
std::size_t addresses_in_use() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

struct Job {
  const std::function<void()>& work;
  const ChildLimits& limits;
  int errors;    // takes standard error
  pid_t parent;  // process id that the child expects of its parent
  std::size_t in_use = addresses_in_use();
  std::string failure = {};
  bool is_answered = false;
};

/// Removes the signal handlers inherited from this process, such as those of MPI.
void restore_signals() {
  for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTERM, SIGXCPU})
    std::signal(signal, SIG_DFL);
}

void set_limits(const ChildLimits& limits, std::size_t in_use) {
  const rlimit time{limits.seconds, limits.seconds + 1}, no_core{0, 0};
  setrlimit(RLIMIT_CPU, &time);
  setrlimit(RLIMIT_CORE, &no_core);
  rlimit addresses{};
  if (limits.memory == 0 || in_use == 0 || getrlimit(RLIMIT_AS, &addresses) != 0) return;
  addresses.rlim_cur = std::min<rlim_t>(addresses.rlim_cur, in_use + limits.memory);
  setrlimit(RLIMIT_AS, &addresses);
}

void redirect_output(int errors) {
  if (const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC); nowhere >= 0)
    dup2(nowhere, STDOUT_FILENO);
  dup2(errors, STDERR_FILENO);
}

void do_work(Job& job) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != job.parent) _exit(1);  // the parent ended before prctl took effect
  restore_signals();
  set_limits(job.limits, job.in_use);
  redirect_output(job.errors);
  try {
    job.work();
  } catch (const std::bad_alloc&) {
    job.failure = "out of memory";
  } catch (const std::exception& fault) {
    job.failure = fault.what();
  }
  job.is_answered = true;
}

/// Ends the child. Exit handlers belong to the other process.
int do_job(void* argument) {
  do_work(*static_cast<Job*>(argument));
  _exit(0);
}

int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

std::string words_for(int status, unsigned seconds, const std::string& said) {
  std::string words = "it ended without an answer";
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    words = signal == SIGXCPU
                ? fmt::format("it took more than {} s of processor time", seconds)
                : fmt::format("it was ended by signal {} ({})", signal, strsignal(signal));
  }
  return said.empty() ? words : fmt::format("{}: {}", words, said);
}

}  // namespace

ChildResult run_in_child(const std::function<void()>& work, const ChildLimits& limits) {
  const Pipe errors;
  const Stack stack;
  if (errors.error() != 0)
    return {fmt::format("no pipe could be made: {}", reason(errors.error())), 0};
  if (!stack.is_there()) return {"no process could be started: out of memory", 0};
  Job job{work, limits, errors.writing(), getpid()};
  // The memory is shared, and this thread stands still until the child has ended.
  const pid_t child = clone(do_job, stack.top(), CLONE_VM | CLONE_VFORK | SIGCHLD, &job);
  if (child < 0) return {fmt::format("no process could be started: {}", reason(errno)), 0};
  const int status = wait_for(child);
  if (job.is_answered) return {std::move(job.failure), 0};
  return {words_for(status, limits.seconds, errors.first_line()),
          WIFSIGNALED(status) ? WTERMSIG(status) : 0};
}

ChildResult try_in_child(const std::function<void()>& work, const ChildLimits& limits) {
  constexpr int kDone = 0, kFailed = 3;
  const Pipe errors;
  if (errors.error() != 0)
    return {fmt::format("no pipe could be made: {}", reason(errors.error())), 0};
  Job job{work, limits, errors.writing(), getpid()};
  const pid_t child = fork();
  if (child < 0) return {fmt::format("no process could be started: {}", reason(errno)), 0};
  if (child == 0) {
    do_work(job);
    if (job.failure.empty()) _exit(kDone);
    const ssize_t written = write(STDERR_FILENO, job.failure.data(), job.failure.size());
    _exit(written < 0 ? 1 : kFailed);
  }
  const int status = wait_for(child);
  if (WIFEXITED(status) && WEXITSTATUS(status) == kDone) return {};
  const std::string said = errors.first_line();
  if (WIFEXITED(status) && WEXITSTATUS(status) == kFailed) return {said, 0};
  return {words_for(status, limits.seconds, said), WIFSIGNALED(status) ? WTERMSIG(status) : 0};
}

}  // namespace meniscus
