#pragma once

#include <chrono>
#include <string>

#include "meniscus/evolve/record.hpp"

namespace meniscus {

/// The progress of a run on standard output: one line rewritten in place on a terminal; into a pipe
/// or file or under mpirun, plain lines, at most one every few seconds; nothing when quiet, and on
/// rank 0 alone.
class Progress {
 public:
  Progress(double start, double end, bool is_quiet);
  void show(const HistoryRow& history, const std::vector<DropRow>& drops);
  /// Ends the line, so that what follows starts on its own.
  void close();
  /// A line of its own, unless quiet. A closed pipe is no reason to end a run.
  void say(const std::string& line) const;

 private:
  using Clock = std::chrono::steady_clock;
  double start_, end_;
  bool is_quiet_, is_terminal_, is_line_open_ = false;
  Clock::time_point began_ = Clock::now();
  Clock::time_point shown_{};
};

}  // namespace meniscus
