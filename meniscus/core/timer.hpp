#pragma once

#include <chrono>
#include <map>
#include <string>

namespace meniscus {

/// Seconds of wall time spent in each named phase of a run.
class PhaseTimes {
 public:
  void add(const std::string& phase, double seconds) { seconds_[phase] += seconds; }
  [[nodiscard]] double operator[](const std::string& phase) const {
    const auto found = seconds_.find(phase);
    return found == seconds_.end() ? 0.0 : found->second;
  }
  [[nodiscard]] const std::map<std::string, double>& all() const { return seconds_; }

 private:
  std::map<std::string, double> seconds_;
};

/// Adds the time from its construction to its destruction to one phase.
class PhaseTimer {
 public:
  PhaseTimer(PhaseTimes& times, std::string phase)
      : times_(times), phase_(std::move(phase)), start_(Clock::now()) {}
  PhaseTimer(const PhaseTimer&) = delete;
  PhaseTimer& operator=(const PhaseTimer&) = delete;
  ~PhaseTimer() {
    times_.add(phase_, std::chrono::duration<double>(Clock::now() - start_).count());
  }

 private:
  using Clock = std::chrono::steady_clock;
  PhaseTimes& times_;
  std::string phase_;
  Clock::time_point start_;
};

}  // namespace meniscus
