#pragma once

#include <filesystem>
#include <string>

#include "meniscus/app/run_comparison.hpp"
#include "meniscus/case/case.hpp"

namespace meniscus {

/// "nodal, N0 = 110" as a file name: "nodal-n0-110".
[[nodiscard]] std::string file_name_of(const std::string& name);

/// Whether a folder holds the run of this case by this program's commit, and whether it ended.
enum class RunState { absent, unfinished, finished };
[[nodiscard]] RunState state_of_run(const std::filesystem::path& folder, const Case& c);

[[nodiscard]] RunTables read_run_tables(const std::filesystem::path& folder);

/// The file of one table in the record of a run.
[[nodiscard]] std::filesystem::path recorded_file(const std::filesystem::path& results,
                                                  const std::string& run, const char* file);

/// Reads the record of a run from the folder of its case: drops.csv and history.csv, thinned to
/// some hundred steps. So is events.csv if there were events. A first line names program, date and
/// cost. Throws InvalidInput when there is no record.
[[nodiscard]] RunTables read_record(const std::filesystem::path& results, const std::string& run);
void write_record(const std::filesystem::path& results, const std::string& run,
                  const std::filesystem::path& folder);

}  // namespace meniscus
