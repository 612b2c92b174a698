#pragma once

#include <functional>
#include <optional>

#include "meniscus/app/progress.hpp"
#include "meniscus/app/run_directory.hpp"
#include "meniscus/case/case.hpp"
#include "meniscus/evolve/evolution.hpp"

namespace meniscus {

/// When what is written. A frame is due at the first step at or after each multiple of its
/// interval.
enum class Outcome { done, stopped };

/// A run from the state its evolution stands at to its end: solve, record, advance. Everything that
/// depends on the state alone reaches the same files whether or not the run was taken up in
/// between.
class Simulation {
 public:
  /// `describe` adds to a checkpoint what it takes to build the evolution again. Rank 0 has the
  /// directory, and it alone.
  Simulation(Evolution evolution, std::optional<RunDirectory> directory,
             const OutputOptions& output, std::function<void(Archive&)> describe);

  /// When the next frames are due, from the checkpoint the evolution was loaded from.
  void load_schedule(const Archive& archive);
  /// Called after each row, when its files are whole.
  void set_observer(std::function<void(const RunDirectory&)> observer) {
    observer_ = std::move(observer);
  }
  /// Throws RunFailure, a checkpoint being left, when the run cannot go on. Collective.
  Outcome run(Progress& progress);

  [[nodiscard]] const Evolution& evolution() const { return evolution_; }
  /// On rank 0.
  [[nodiscard]] const RunDirectory& directory() const { return *directory_; }
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
  double next_surface_frame_ = 0.0, next_volume_frame_ = 0.0;
  PhaseTimes output_times_;
  PhaseSeconds timed_;  // at the row before
};

}  // namespace meniscus
