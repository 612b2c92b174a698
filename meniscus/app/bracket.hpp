#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "meniscus/case/study_file.hpp"

namespace meniscus {

/// What became of a run of a bisection.
enum class Verdict {
  steady,
  broken,
  undecided,  ///< neither, however often it was prolonged
  failed
};

/// The bracket of a critical value: the value nearest to it where drops become steady, and the one
/// where they break. It follows from the verdicts alone, in whatever order they come.
class Bracket {
 public:
  explicit Bracket(const StudyBisection& bisection) : bisection_(bisection) {}

  void add(double value, Verdict verdict) { verdicts_[value] = verdict; }
  [[nodiscard]] const std::map<double, Verdict>& verdicts() const { return verdicts_; }
  /// The values to try next: the ends, then the middle of the bracket. Empty when the search ends.
  [[nodiscard]] std::vector<double> wanted() const;

  enum class Result {
    open,        ///< values are still wanted
    critical,    ///< the bracket is narrow enough
    all_steady,  ///< at both ends: there is no critical value between
    all_broken,
    undecided,  ///< a run was undecided, which ends the search
    failed      ///< a run failed
  };
  [[nodiscard]] Result result() const;

  /// The ends of the bracket, the values of each verdict nearest to the other. None where the
  /// verdict is on neither end of the search; the end `to` where it is on both.
  [[nodiscard]] std::optional<double> steady() const { return nearest(Verdict::steady); }
  [[nodiscard]] std::optional<double> broken() const { return nearest(Verdict::broken); }
  /// The middle of a bracket with two ends.
  [[nodiscard]] std::optional<double> middle() const;
  /// Width over the larger end.
  [[nodiscard]] std::optional<double> relative_width() const;

 private:
  [[nodiscard]] std::optional<double> nearest(Verdict verdict) const;
  [[nodiscard]] bool has(Verdict verdict) const;

  StudyBisection bisection_;
  std::map<double, Verdict> verdicts_;
};

[[nodiscard]] const char* word_for(Verdict verdict);
/// "critical", "all steady", …, as study.csv has it.
[[nodiscard]] const char* word_for(Bracket::Result result);

}  // namespace meniscus
