#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "meniscus/app/bracket.hpp"
#include "meniscus/app/study_run.hpp"
#include "meniscus/app/study_workers.hpp"
#include "meniscus/report/study_page.hpp"

namespace meniscus {

/// What the runs at a point of a study came to.
struct StudyPointResult {
  std::optional<Bracket> bracket;  ///< of a bisection
  /// By value of the bisection's key; without a bisection the one run has the key 0.
  std::map<double, StudyRunResult> runs;
};

/// The runs of a study. What they come to does not depend on where they run, and how many at a
/// time.
class Study {
 public:
  explicit Study(StudyFolders folders);

  /// Makes the runs that are wanted, `most` at a time, and calls `say` with a line for each.
  /// Returns false when it was interrupted; runs then stop after their step, or go on without this
  /// process, as the workers have it. Throws RunFailure when the workers refuse a run.
  bool run(StudyWorkers& workers, std::size_t most,
           const std::function<void(const std::string&)>& say);

  [[nodiscard]] const StudyFolders& folders() const { return folders_; }
  [[nodiscard]] const std::vector<StudyPointResult>& results() const { return results_; }
  [[nodiscard]] int num_failed() const;

 private:
  /// The runs that may start now, in order.
  [[nodiscard]] std::vector<StudyRun> wanted() const;
  void add(const StudyRun& run, const StudyRunResult& result);

  StudyFolders folders_;
  std::vector<StudyPointResult> results_;  // by point
};

/// study.csv: one row for each point whose runs are done, in the order of the axes.
[[nodiscard]] std::string study_table(const Study& study);
/// What the bisections of a study came to, one line for each point that is complete.
[[nodiscard]] std::vector<std::string> study_outcomes(const Study& study);
/// The page of a study: curves against the axes, shapes at the end, links to the runs.
[[nodiscard]] report::StudyPage study_page(const Study& study);

}  // namespace meniscus
