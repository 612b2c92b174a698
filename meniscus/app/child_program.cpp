#include "meniscus/app/child_program.hpp"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

constexpr const char* kThisProgram = "/proc/self/exe";
/// Of a shell whose command cannot be started.
constexpr int kNotStarted = 127;

int status_of(int status) {
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

/// In the child: becomes the program. Only calls that are safe between fork and exec.
[[noreturn]] void become(char* const* arguments, int log, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kNotStarted);  // which ended before prctl took effect
  dup2(log, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  execv(kThisProgram, arguments);
  _exit(kNotStarted);
}

}  // namespace

ChildProgram::ChildProgram(const std::vector<std::string>& arguments,
                           const std::filesystem::path& log) {
  std::vector<std::string> words{"meniscus"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0)
    throw RunFailure(fmt::format("{}: cannot be written: {}", log.string(), std::strerror(errno)));
  const pid_t parent = getpid();
  process_ = fork();
  if (process_ == 0) become(pointers.data(), file, parent);
  const int error = errno;
  close(file);
  if (process_ < 0)
    throw RunFailure(fmt::format("no process could be started: {}", std::strerror(error)));
}

ChildProgram::ChildProgram(ChildProgram&& other) noexcept
    : process_(std::exchange(other.process_, -1)) {}

ChildProgram& ChildProgram::operator=(ChildProgram&& other) noexcept {
  std::swap(process_, other.process_);
  return *this;
}

ChildProgram::~ChildProgram() {
  if (process_ < 0) return;
  kill(process_, SIGKILL);
  while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

std::optional<int> ChildProgram::status() {
  int status = 0;
  if (process_ < 0 || waitpid(process_, &status, WNOHANG) != process_) return std::nullopt;
  process_ = -1;
  return status_of(status);
}

void ChildProgram::interrupt() const {
  if (process_ >= 0) kill(process_, SIGINT);
}

}  // namespace meniscus
