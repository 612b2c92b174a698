#pragma once

#include <functional>
#include <optional>

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
/// on the state alone is the same whether or not the run was resumed in between.
class Simulation {
 public:
  /// `describe` adds to a checkpoint what is needed to rebuild the evolution. Only rank 0 passes a
  /// directory.
  Simulation(Evolution evolution, std::optional<RunDirectory> directory,
             const OutputOptions& output, std::function<void(Archive&)> describe);

  /// Reads the times of the next frames from the checkpoint of the evolution.
  void load_schedule(const Archive& archive);
  /// Ends the run at the first step that meets a rule. Reads what rules look back to from the rows
  /// that the folder holds. Collective.
  void stop_when(const StopRules& rules);
  /// Sets a function to call after each row, when its files are complete.
  void set_observer(std::function<void(const RunDirectory&)> observer) {
    observer_ = std::move(observer);
  }
  /// Throws RunFailure when the run cannot go on; the last checkpoint stays. Collective.
  Outcome run(Progress& progress);

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
  [[nodiscard]] Archive state_before_solve();
  void write_checkpoint(const Archive& state);
  void record(Progress& progress, bool is_last);
  [[nodiscard]] double seconds_in(const std::string& phase) const;

  Evolution evolution_;
  std::optional<RunDirectory> directory_;
  OutputOptions output_;
  std::function<void(Archive&)> describe_;
  std::function<void(const RunDirectory&)> observer_;
  std::optional<StopJudge> judge_;  // none where no rule ends the run
  std::optional<RunEnd> end_;
  double next_surface_frame_ = 0.0, next_volume_frame_ = 0.0;
  PhaseTimes output_times_;
  PhaseSeconds timed_;  // seconds when the previous row was written
};

}  // namespace meniscus
