#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "meniscus/case/case.hpp"

namespace meniscus {

/// A key of a case and the values that a study gives it.
struct StudyAxis {
  std::string key;
  std::vector<std::string> values;  ///< as TOML
  bool is_logarithmic = false;      ///< the values are those of a logarithmic range
  std::string source;               ///< "study.toml:7"
};

/// The search for the value of a key between steady drops and broken ones.
struct StudyBisection {
  std::string key;
  double from = 0.0, to = 0.0;  ///< the ends, one where drops become steady, one where they break
  double tolerance = 0.005;     ///< the bracket's width over its larger end, when the search ends
  bool is_logarithmic = false;  ///< halves ratios, not differences
  int prolongations = 2;        ///< how often an undecided run goes on to twice its end time
  std::string source;
};

/// A study: runs of one case with other values of some keys.
struct StudyFile {
  std::string name;   ///< of the file, as given
  std::string title;  ///< empty: none
  std::filesystem::path case_file;
  std::vector<std::string> overrides;  ///< key=value, of every run
  std::vector<StudyAxis> axes;
  std::optional<StudyBisection> bisection;
};

/// Reads a study. Throws InvalidInput naming file, line and key at the first fault of the file.
[[nodiscard]] StudyFile read_study_file(const std::filesystem::path& file);

/// A point of a study: one value of each axis.
using StudyPoint = std::vector<std::string>;
/// The full product of the axes; the last one runs fastest. One point where there are no axes.
[[nodiscard]] std::vector<StudyPoint> points_of(const StudyFile& study);

/// The overrides of the case at a point, and with a value of the bisection's key.
[[nodiscard]] std::vector<std::string> overrides_at(const StudyFile& study, const StudyPoint& point,
                                                    std::optional<double> value = std::nullopt);

/// The case at a point. Throws InvalidInput, beginning with the line of the axis whose value is at
/// fault.
[[nodiscard]] Case case_at(const StudyFile& study, const StudyPoint& point,
                           std::optional<double> value = std::nullopt);

/// Reads the case at every point. Throws InvalidInput at the first fault. So it does where the case
/// does not say when a run of a bisection is steady and when broken.
void require_valid_cases(const StudyFile& study);

/// A number with six significant digits, as names of runs and brackets have it.
[[nodiscard]] double rounded(double value);

}  // namespace meniscus
