#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "meniscus/app/bracket.hpp"
#include "meniscus/case/study_file.hpp"

namespace meniscus {

/// A run of a study: the case at a point and, in a bisection, at a value of its key.
struct StudyRun {
  std::size_t point = 0;        ///< index into the study's points
  std::optional<double> value;  ///< of the bisection's key
  std::string name;             ///< of its folder: "viscosity-ratio=0.1_capillary-number=0.2"
};

/// What a run came to, as its folder tells.
struct StudyRunResult {
  std::string failure = {};  ///< why it failed, in one line; empty where it is done
  std::string ended = {};    ///< "time", or the rule that ended it
  std::int64_t steps = 0;
  std::size_t drops = 0, events = 0;
  double t = 0.0;                    ///< [1/G]
  std::vector<double> volumes = {};  ///< of the drops at the end [R0³]
  double L = 0.0, B = 0.0, D = 0.0;  ///< of the largest drop at the end [R0]
  std::optional<double> angle_deg = {};

  [[nodiscard]] Verdict verdict() const;
};

/// The folders of a study's runs, and what is to be done for each.
class StudyFolders {
 public:
  /// Does not write. Throws InvalidInput when `output` cannot be a folder.
  StudyFolders(StudyFile study, std::filesystem::path output, bool is_overwrite);

  [[nodiscard]] const StudyFile& study() const { return study_; }
  [[nodiscard]] const std::vector<StudyPoint>& points() const { return points_; }
  [[nodiscard]] const std::filesystem::path& output() const { return output_; }
  [[nodiscard]] StudyRun run_at(std::size_t point,
                                std::optional<double> value = std::nullopt) const;
  [[nodiscard]] std::filesystem::path folder(const StudyRun& run) const;
  [[nodiscard]] std::filesystem::path log(const StudyRun& run) const;

  /// The arguments with which this program brings a run forward: a new run, one that was stopped,
  /// or one of a bisection that is prolonged. None when the run is done. Throws InvalidInput where
  /// the folder holds another run, unless that may be replaced.
  [[nodiscard]] std::optional<std::vector<std::string>> next_command(const StudyRun& run) const;
  /// What a run that is done came to.
  [[nodiscard]] StudyRunResult result(const StudyRun& run) const;
  /// What a run came to whose command ended with a status other than 0.
  [[nodiscard]] StudyRunResult failure(const StudyRun& run, int status) const;

 private:
  [[nodiscard]] std::vector<std::string> new_run(const StudyRun& run) const;

  StudyFile study_;
  std::filesystem::path output_;
  bool is_overwrite_;
  std::vector<StudyPoint> points_;
  std::vector<std::string> names_;  // by point
};

}  // namespace meniscus
