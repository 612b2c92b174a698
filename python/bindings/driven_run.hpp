#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "meniscus/app/run_record.hpp"
#include "meniscus/app/simulation.hpp"
#include "meniscus/io/table.hpp"
#include "python/bindings/python_case.hpp"
#include "python/bindings/snapshot.hpp"

namespace meniscus::python {

/// A table of a run in memory: what its file holds, and as much without a file.
struct RunTable {
  std::vector<std::string> columns;
  std::vector<std::vector<io::Cell>> rows;
};
struct RunTables {
  RunTable history, drops, events;
};

/// A run that a caller steps: what `meniscus run` and `meniscus resume` do, one step at a time,
/// with a folder or without. Between calls the state at t_k is solved and recorded. Under mpirun
/// every rank makes the same calls.
class DrivenRun {
 public:
  /// Makes the first meshes, solves the flow and records step 0. Without a folder nothing is
  /// written.
  static std::unique_ptr<DrivenRun> begin(PythonCase c,
                                          const std::optional<std::filesystem::path>& folder,
                                          bool is_overwrite);
  /// Goes on from a checkpoint, or from the newest one of a run's folder: there, or in the folder
  /// `output`, which takes along the rows and frames of that run. `settings` are "key=value".
  static std::unique_ptr<DrivenRun> resume(const std::filesystem::path& source,
                                           const std::optional<std::filesystem::path>& output,
                                           const std::vector<std::string>& settings);
  DrivenRun(const DrivenRun&) = delete;
  DrivenRun& operator=(const DrivenRun&) = delete;
  ~DrivenRun() = default;

  /// Takes a step, solves and records. Throws RunFailure at the end of the run, when no step can be
  /// taken, and ever after.
  void step();
  /// Writes the checkpoint of the present state and says in run.json that the run was stopped.
  void stop();
  void write_checkpoint(const std::filesystem::path& file);
  /// Sets keys of the case that act on the imposed flow, from the present time on.
  void set_flow(const std::vector<std::string>& settings);

  [[nodiscard]] const Evolution& evolution() const { return simulation_.evolution(); }
  [[nodiscard]] bool has_ended() const { return simulation_.has_ended(); }
  [[nodiscard]] bool has_failed() const { return !failure_.empty(); }
  [[nodiscard]] const PythonCase& given() const { return case_; }
  [[nodiscard]] const std::optional<std::filesystem::path>& folder() const { return folder_; }
  /// Settings that `set_flow` made since the last step.
  [[nodiscard]] std::size_t num_settings_at_step() const { return settings_at_step_; }
  [[nodiscard]] const RunTables& tables() const { return tables_; }
  [[nodiscard]] PhaseSeconds seconds() const { return simulation_.seconds(); }
  [[nodiscard]] std::shared_ptr<const SurfaceSnapshot> surfaces();
  [[nodiscard]] std::shared_ptr<const VolumeSnapshot> volume();

 private:
  DrivenRun(PythonCase c, std::optional<std::filesystem::path> folder, Simulation simulation,
            RunRecord record);
  void start();
  void record_state();
  void add_rows(const HistoryRow& history, const std::vector<DropRow>& drops);
  void read_earlier_rows();
  void write_record(const std::string& status);
  void end(const std::string& status);
  void note_failure(const std::exception& failure);
  void require_going() const;

  PythonCase case_;
  std::optional<std::filesystem::path> folder_;
  Simulation simulation_;
  RunRecord record_;
  RunPhysics physics_;
  RunTables tables_;
  std::string failure_;
  std::size_t settings_at_step_ = 0;
  bool is_stopped_ = false;  // as run.json says
  std::shared_ptr<const SurfaceSnapshot> surfaces_;
  std::shared_ptr<const VolumeSnapshot> volume_;
};

}  // namespace meniscus::python
