#pragma once

#include <map>
#include <optional>
#include <string>

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
///
/// The end `from` runs first and tells which verdict is on its side. The end `to` is often the
/// costliest run of all, so it is taken to have the other one. It runs only where the first three
/// middles agree with `from`, or where none is left to try.
class Bracket {
 public:
  explicit Bracket(const StudyBisection& bisection) : bisection_(bisection) {}

  void add(double value, Verdict verdict) { verdicts_[value] = verdict; }
  [[nodiscard]] const std::map<double, Verdict>& verdicts() const { return verdicts_; }
  /// The value to try next: `from`, the middle of the bracket or `to`. None when the search ends.
  [[nodiscard]] std::optional<double> wanted() const;

  enum class Result {
    open,        ///< values are still wanted
    critical,    ///< the bracket is narrow enough
    all_steady,  ///< wherever tried, at both ends too: there is no critical value between
    all_broken,
    undecided,  ///< a run was undecided, which ends the search
    failed      ///< a run failed
  };
  [[nodiscard]] Result result() const;

  /// The ends of the bracket, the values of each verdict nearest to the other. None where none was
  /// found; the end `to` where it has the verdict of `from`.
  [[nodiscard]] std::optional<double> steady() const { return nearest(Verdict::steady); }
  [[nodiscard]] std::optional<double> broken() const { return nearest(Verdict::broken); }
  /// The middle of a bracket with two ends.
  [[nodiscard]] std::optional<double> middle() const;
  /// Width over the larger end.
  [[nodiscard]] std::optional<double> relative_width() const;

 private:
  [[nodiscard]] std::optional<double> nearest(Verdict verdict) const;
  [[nodiscard]] bool has(Verdict verdict) const;
  [[nodiscard]] double between(double a, double b) const;
  [[nodiscard]] static double width(double a, double b);

  StudyBisection bisection_;
  std::map<double, Verdict> verdicts_;
};

[[nodiscard]] const char* word_for(Verdict verdict);
/// "critical", "all steady", …, as study.csv has it.
[[nodiscard]] const char* word_for(Bracket::Result result);

}  // namespace meniscus
