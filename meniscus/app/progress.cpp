#include "meniscus/app/progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

#include "meniscus/app/ranks.hpp"
#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

// A terminal is repainted a few times a second; a log file gets a line now and then.
constexpr std::chrono::milliseconds kTerminalInterval{100};
constexpr std::chrono::seconds kPipeInterval{5};

std::string duration(double seconds) {
  if (!std::isfinite(seconds)) return "--:--";
  const auto total = static_cast<long>(std::lround(std::max(0.0, seconds)));
  if (total >= 3600)
    return fmt::format("{}:{:02}:{:02}", total / 3600, total / 60 % 60, total % 60);
  return fmt::format("{}:{:02}", total / 60, total % 60);
}

std::string bar(double fraction) {
  constexpr int kWidth = 20;
  MENISCUS_ASSERT(std::isfinite(fraction), "a fraction of {:g}", fraction);
  const int filled = static_cast<int>(std::lround(kWidth * std::clamp(fraction, 0.0, 1.0)));
  return std::string(static_cast<std::size_t>(filled), '#') +
         std::string(static_cast<std::size_t>(kWidth - filled), '.');
}

}  // namespace

// Open MPI gives each rank a terminal of its own, even where output goes to a file.
Progress::Progress(double start, double end, bool is_quiet)
    : start_(start),
      end_(end),
      is_quiet_(is_quiet || !is_first_rank()),
      is_terminal_(num_ranks() == 1 && isatty(STDOUT_FILENO) == 1) {}

void Progress::show(const HistoryRow& history, const std::vector<DropRow>& drops) {
  if (is_quiet_) return;
  const Clock::time_point now = Clock::now();
  const bool is_last = history.t >= end_;
  if (!is_last && now - shown_ < (is_terminal_ ? Clock::duration(kTerminalInterval)
                                               : Clock::duration(kPipeInterval)))
    return;
  shown_ = now;
  const double fraction = end_ > start_ ? (history.t - start_) / (end_ - start_) : 1.0;
  const double elapsed = std::chrono::duration<double>(now - began_).count();
  double D = 0.0, drift = 0.0;
  for (const DropRow& row : drops) {
    if (std::abs(row.shape.D) > std::abs(D)) D = row.shape.D;
    drift = std::max(drift, std::abs(row.volume_drift));
  }
  const std::string line = fmt::format(
      "[{}] t {:.3f}/{:g}  step {}  nodes {}+{}  D {:.4f}  drift {:.0e}  {} left", bar(fraction),
      history.t, end_, history.step, history.surface_nodes, history.nodes.value_or(0), D, drift,
      duration(fraction > 0.0 ? elapsed * (1.0 - fraction) / fraction : INFINITY));
  std::fputs(((is_terminal_ ? "\r" : "") + line + (is_terminal_ ? "\033[K" : "\n")).c_str(),
             stdout);
  std::fflush(stdout);
  is_line_open_ = is_terminal_;
}

void Progress::close() {
  if (is_line_open_) std::fputs("\n", stdout);
  is_line_open_ = false;
}

void Progress::say(const std::string& line) const {
  if (is_quiet_) return;
  std::fputs((line + "\n").c_str(), stdout);
  std::fflush(stdout);
}

}  // namespace meniscus
