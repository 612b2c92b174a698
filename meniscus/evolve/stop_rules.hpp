#pragma once

#include <array>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "meniscus/core/named_constant.hpp"
#include "meniscus/evolve/record.hpp"
#include "meniscus/scene/scene.hpp"
#include "meniscus/topology/events.hpp"

namespace meniscus {

/// [1/G] The window over which rules measure how fast a drop's length changes.
inline constexpr double kRateWindow = 1.0;
/// [R0] A drop nearer to an open patch than this ends the run where a case does not set a distance:
/// some edge lengths, within which the patch's traction shapes the drop.
inline constexpr double kDefaultPatchGap = 0.1;

inline constexpr std::array kStopConstants{NamedConstant{"rate-window", kRateWindow}};

/// Why a run ended.
enum class Ending {
  time,    ///< it reached its end time
  steady,  ///< the drops' lengths no longer change
  broken,  ///< a drop broke up or merged, or grows without bound
  length,  ///< a drop is longer than it was to become
  patch    ///< a drop came to an open patch
};
/// "time", "steady", …, as run.json has it.
[[nodiscard]] const char* word_for(Ending ending);

/// When a run ends before its end time.
struct StopRules {
  /// [G R0] Steady: L of every drop changes more slowly, and no faster than before.
  std::optional<double> steady_rate = {};
  bool is_broken_by_event = false;
  /// [R0] Broken: a drop is longer, and L grows at a rising rate.
  std::optional<double> broken_length = {};
  std::optional<double> length = {};  ///< [R0] upper bound of L
  double patch_gap = 0.0;             ///< [R0] distance from an open patch; 0: none

  [[nodiscard]] bool any() const {
    return steady_rate || is_broken_by_event || broken_length || length || patch_gap > 0.0;
  }
};

/// L of a drop at one time.
struct DropLength {
  int drop = 0;
  double L = 0.0;  ///< [R0]
};

/// The lengths of the drops over the last while, and how fast they change. Drops that change their
/// number in an event begin anew.
class LengthRates {
 public:
  void add(double t, std::vector<DropLength> drops);
  /// Whether every L stayed within bound · window during the last window, and within no more than
  /// during the one before. False before two windows have passed.
  [[nodiscard]] bool are_steady(double bound) const;
  /// Whether a drop is longer than `length` and grew more in the last window than in the one
  /// before. Windows are halves of the time so far where that is shorter.
  [[nodiscard]] bool is_runaway(double length) const;

 private:
  struct Sample {
    double t;
    std::vector<DropLength> drops;
  };
  struct Extent {
    double least, largest;
  };
  [[nodiscard]] double length_at(double t, std::size_t drop) const;
  [[nodiscard]] Extent extent(double from, double to, std::size_t drop) const;

  std::deque<Sample> samples_;  // at rising times; the first at most two windows back
};

/// The end of a run, and what led to it as a line for the user.
struct RunEnd {
  Ending ending = Ending::time;
  std::string text;
};

/// Judges each step of a run by its rules.
class StopJudge {
 public:
  explicit StopJudge(const StopRules& rules) : rules_(rules) {}

  /// Adds a time of an earlier part of the run.
  void add(double t, std::vector<DropLength> drops) { rates_.add(t, std::move(drops)); }
  /// The end of the run, if it ends at this step.
  [[nodiscard]] std::optional<RunEnd> judge(double t, std::span<const DropRow> drops,
                                            std::span<const TopologyEvent> events,
                                            const Scene& scene);

 private:
  StopRules rules_;
  LengthRates rates_;
};

/// The open patch that a drop is nearer to than `gap`, and the drop. None where nothing is.
struct PatchContact {
  int drop = 0;
  std::string patch;
};
[[nodiscard]] std::optional<PatchContact> find_patch_contact(const Scene& scene, double gap);

}  // namespace meniscus
