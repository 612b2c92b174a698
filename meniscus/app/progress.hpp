#pragma once

#include <chrono>
#include <string>

#include "meniscus/evolve/record.hpp"

namespace meniscus {

/// Shows the progress of a run on standard output, on rank 0 only, unless quiet. On a terminal it
/// rewrites one line. In a pipe, a file or under mpirun it writes plain lines, at most one every
/// few seconds.
class Progress {
 public:
  Progress(double start, double end, bool is_quiet);
  void show(const HistoryRow& history, const std::vector<DropRow>& drops);
  /// Ends the line, so that what follows starts on its own.
  void close();
  /// Writes a separate line, unless quiet. A closed pipe does not end the run.
  void say(const std::string& line) const;

 private:
  using Clock = std::chrono::steady_clock;
  double start_, end_;
  bool is_quiet_, is_terminal_, is_line_open_ = false;
  Clock::time_point began_ = Clock::now();
  Clock::time_point shown_{};
};

}  // namespace meniscus
