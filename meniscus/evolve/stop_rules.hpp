#pragma once

#include <array>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "meniscus/core/archive.hpp"
#include "meniscus/core/named_constant.hpp"
#include "meniscus/evolve/record.hpp"
#include "meniscus/scene/scene.hpp"
#include "meniscus/topology/events.hpp"

namespace meniscus {

/// [1/G] The window over which rules measure how fast a drop's length changes.
inline constexpr double kRateWindow = 1.0;
/// [G] A drop that grows more slowly than this share of its length is no runaway. Its rate may rise
/// by the noise of a steady length.
inline constexpr double kLeastGrowth = 1e-3;
/// [mean edge at the vertex] A drop nearer to an open patch than this ends the run where a case
/// does not set a distance. The gap would have no room for a layer of cells as large as the drop's
/// faces.
inline constexpr double kPatchGapInEdges = 1.0;

inline constexpr std::array kStopConstants{NamedConstant{"rate-window", kRateWindow},
                                           NamedConstant{"least-growth", kLeastGrowth},
                                           NamedConstant{"patch-gap-in-edges", kPatchGapInEdges}};

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
  bool is_ended_by_patch = false;     ///< a drop comes to an open patch
  /// [R0] How near that is; none: `kPatchGapInEdges`.
  std::optional<double> patch_gap = {};

  [[nodiscard]] bool any() const {
    return steady_rate || is_broken_by_event || broken_length || length || is_ended_by_patch;
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
  void save(Archive& archive) const;
  /// Nothing where the archive holds none. Throws InvalidInput where entries do not fit together.
  void load(const Archive& archive);
  [[nodiscard]] bool is_empty() const { return samples_.empty(); }
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

/// The step that a run would take next.
struct StepAhead {
  double dt = 0.0;  ///< [1/G]
  /// [G R0] Of the vertices of every interface; none: at rest.
  std::span<const VertexField<Vec3>> motion = {};
};

/// Judges each step of a run by its rules.
class StopJudge {
 public:
  explicit StopJudge(const StopRules& rules) : rules_(rules) {}

  /// The lengths of earlier steps, to which a resumed run adds those that it knows.
  [[nodiscard]] LengthRates& past() { return rates_; }
  [[nodiscard]] const LengthRates& past() const { return rates_; }
  /// The end of the run, if it ends at this step, before the `next` one.
  [[nodiscard]] std::optional<RunEnd> judge(double t, std::span<const DropRow> drops,
                                            std::span<const TopologyEvent> events,
                                            const Scene& scene, const StepAhead& next);

 private:
  StopRules rules_;
  LengthRates rates_;
};

/// An open patch that a drop has come to, and the drop.
struct PatchContact {
  int drop = 0;
  std::string patch;
};
/// The first drop with a vertex nearer to an open patch than `gap` [R0]. Without `gap` the mean
/// edge at the vertex is taken. A vertex that would be so near after the step ahead counts too. A
/// step bounds the way of vertices in edges, but for the rigid motion of their drop. One step could
/// carry a drop through the patch. None where nothing is that near.
[[nodiscard]] std::optional<PatchContact> find_patch_contact(const Scene& scene,
                                                             const StepAhead& next,
                                                             std::optional<double> gap = {});

}  // namespace meniscus
