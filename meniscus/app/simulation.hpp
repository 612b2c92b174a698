#pragma once

#include <functional>
#include <optional>
#include <string>

#include "meniscus/app/progress.hpp"
#include "meniscus/app/run_directory.hpp"
#include "meniscus/case/case.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/evolve/evolution.hpp"
#include "meniscus/evolve/stop_rules.hpp"

namespace meniscus {

/// When what is written. A frame is due at the first step at or after each multiple of its
/// interval.
enum class Outcome { done, stopped };

/// Runs an evolution from its present state to the end: solve, record, advance. Output that depends
/// on the state alone is the same whether or not the run was resumed in between. `run` does all of
/// it; a caller with a loop of its own calls `record_state`, `advance`, `record_state`, …
class Simulation {
 public:
  using Description = std::function<void(Archive&)>;
  using RowObserver = std::function<void(const HistoryRow&, const std::vector<DropRow>&)>;

  /// `describe` adds to a checkpoint what is needed to rebuild the evolution. Only rank 0 passes a
  /// directory. A run without one writes nothing.
  Simulation(Evolution evolution, std::optional<RunDirectory> directory,
             const OutputOptions& output, Description describe);

  /// Ends the run at the first step that meets a rule. Reads what rules look back to from the rows
  /// that the folder holds. Collective.
  void stop_when(const StopRules& rules);
  /// Reads the times of the next frames from the checkpoint of the evolution. After `stop_when` it
  /// also reads what rules look back to, where no folder holds it.
  void load(const Archive& archive);
  /// Sets a function to call after each row, when its files are complete.
  void set_observer(std::function<void(const RunDirectory&)> observer) {
    observer_ = std::move(observer);
  }
  /// Throws RunFailure when the run cannot go on; the last checkpoint stays. Collective.
  Outcome run(Progress& progress);

  /// Solves the flow at t_k and records the state: rows, and frames and checkpoint where due.
  /// `show` gets the rows, on rank 0; all ranks get the one of history.csv. Throws RunFailure when
  /// there is no flow. Collective.
  HistoryRow record_state(const RowObserver& show = {});
  /// Takes the step from the recorded state at t_k to t_{k+1}. Throws RunFailure when none can be
  /// taken; the state is the recorded one then, and its checkpoint is written. Collective.
  void advance();
  /// Writes the checkpoint of the recorded state, which a run goes on from bit for bit. Collective.
  void write_checkpoint();
  /// As above, to a file of any name.
  void write_checkpoint(const std::filesystem::path& file);
  /// Replaces the imposed flow and the outer boundary's conditions from t_k on and solves again.
  /// `describe` is that of the new case. Throws RunFailure when there is no flow. Collective.
  void set_surroundings(const Scene& surroundings, Description describe);

  /// Whether the recorded state is the last one: its time is the end's, or a rule was met.
  [[nodiscard]] bool has_ended() const { return has_ended_; }
  [[nodiscard]] const Evolution& evolution() const { return evolution_; }
  /// Why the run ended; none while it goes on or when it stopped. Rank 0 only.
  [[nodiscard]] const std::optional<RunEnd>& end() const { return end_; }
  /// The run's folder. Rank 0 only.
  [[nodiscard]] const RunDirectory& directory() const {
    MENISCUS_ASSERT(directory_, "a rank without the run's folder");
    return *directory_;
  }
  /// Seconds by phase since this process began to simulate.
  [[nodiscard]] PhaseSeconds seconds() const;

 private:
  void keep_state();
  void solve();
  [[nodiscard]] std::string begin_volume_frame();
  void judge(const Rows& rows);
  void write_surface_frame();
  void write_volume_frame(const std::string& file);
  void record(const Rows& rows, bool has_volume_frame, const RowObserver& show);
  [[nodiscard]] double seconds_in(const std::string& phase) const;

  Evolution evolution_;
  std::optional<RunDirectory> directory_;
  OutputOptions output_;
  Description describe_;
  std::function<void(const RunDirectory&)> observer_;
  std::optional<StopJudge> judge_;  // none where no rule ends the run
  std::optional<RunEnd> end_;
  double next_surface_frame_ = 0.0, next_volume_frame_ = 0.0;
  Archive state_;  // at t_k before its solve; rank 0 only
  bool has_ended_ = false, is_begun_ = false, is_after_event_ = false;
  PhaseTimes output_times_;
  PhaseSeconds timed_;  // seconds when the previous row was written
};

}  // namespace meniscus
