#pragma once

#include <filesystem>
#include <span>

namespace meniscus {

/// Makes `report.html` in a run's folder (its files are in docs/notation.md): one page without
/// outside references that needs neither network nor scripts, with what ran, pictures of the
/// interface, plots of the history and the time spent. Files that are missing leave their part of
/// the page out; what cannot be read is named on it. Throws InvalidInput when the folder holds
/// neither run.json nor history.csv, RunFailure when the disk refuses.
void write_report(const std::filesystem::path& run_directory);

/// A picture that stands alone (.svg): the interface at the frames nearest to `times` [1/G], or at
/// six between the first and the last when none are given. Throws InvalidInput without frames.
void write_interface_svg(const std::filesystem::path& run_directory,
                         const std::filesystem::path& out, std::span<const double> times = {});

/// All plots of the history in one picture that stands alone (.svg). Throws InvalidInput without
/// history.csv.
void write_history_svg(const std::filesystem::path& run_directory,
                       const std::filesystem::path& out);

}  // namespace meniscus
