#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

namespace meniscus::report {

/// A program that runs beside this one, with a pipe into its standard input and one from its
/// standard output.
class Program {
 public:
  /// Starts the program, found on PATH. Throws InvalidInput, beginning with `purpose` and naming
  /// the Debian package, when it cannot be started.
  Program(std::string_view purpose, std::string_view package, std::vector<std::string> command);
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  /// Closes the pipes and waits for the end.
  ~Program();

  /// Returns false when the program no longer reads.
  [[nodiscard]] bool write(std::string_view bytes) const;
  void close_input();
  /// The next line of the output without its end; nothing at the end of the output.
  [[nodiscard]] std::optional<std::string> read_line();
  /// The next `size` bytes of the output, fewer at its end.
  [[nodiscard]] std::string read(std::size_t size);
  /// Closes the pipes and returns the exit status; 128 where a signal ended the program.
  int wait();

 private:
  /// Reads more of the output; false at its end.
  bool fill();

  pid_t process_ = 0;
  int input_ = -1, output_ = -1;
  std::string buffer_;  ///< output that was read and not yet asked for
};

}  // namespace meniscus::report
