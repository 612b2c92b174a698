#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace meniscus {

/// This program in a process of its own, beside this one. It ends with this process, however that
/// ends.
class ChildProgram {
 public:
  /// Starts this program with the given arguments. What it prints goes to the file `log`, which is
  /// replaced. Throws RunFailure when the system refuses.
  ChildProgram(const std::vector<std::string>& arguments, const std::filesystem::path& log);
  ChildProgram(ChildProgram&& other) noexcept;
  ChildProgram& operator=(ChildProgram&& other) noexcept;
  ChildProgram(const ChildProgram&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;
  /// Ends the program if it still runs.
  ~ChildProgram();

  /// The exit status if the program has ended: 128 and the signal where one ended it. Does not
  /// wait.
  [[nodiscard]] std::optional<int> status();
  /// Asks it to stop after the current step (`watch_for_interrupts`).
  void interrupt() const;

 private:
  pid_t process_ = -1;  // −1: has ended
};

}  // namespace meniscus
