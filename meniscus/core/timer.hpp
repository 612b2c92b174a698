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
  [[nodiscard]] double sum() const {
    double sum = 0.0;
    for (const auto& [phase, seconds] : seconds_) sum += seconds;
    return sum;
  }

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

/// Adds to one phase the time between its construction and destruction that no other phase counted.
class RemainderTimer {
 public:
  RemainderTimer(PhaseTimes& times, std::string phase)
      : times_(times), phase_(std::move(phase)), before_(times.sum()), start_(Clock::now()) {}
  RemainderTimer(const RemainderTimer&) = delete;
  RemainderTimer& operator=(const RemainderTimer&) = delete;
  ~RemainderTimer() {
    const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
    times_.add(phase_, elapsed - (times_.sum() - before_));
  }

 private:
  using Clock = std::chrono::steady_clock;
  PhaseTimes& times_;
  std::string phase_;
  double before_;
  Clock::time_point start_;
};

/// Calls a function, adds its time to one phase, and returns its result.
template <class Function>
auto time_phase(PhaseTimes& times, std::string phase, Function&& function) {
  const PhaseTimer timer(times, std::move(phase));
  return function();
}

}  // namespace meniscus
