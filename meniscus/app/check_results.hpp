#pragma once

#include <filesystem>
#include <string>

#include "meniscus/app/run_comparison.hpp"
#include "meniscus/case/case.hpp"

namespace meniscus {

/// "nodal, N0 = 110" as a file name: "nodal-n0-110".
[[nodiscard]] std::string file_name_of(const std::string& name);

/// How far the run in a folder is the one a check asks for: this program's commit and this case.
enum class RunState { absent, unfinished, finished };
[[nodiscard]] RunState state_of_run(const std::filesystem::path& folder, const Case& c);

[[nodiscard]] RunTables read_run_tables(const std::filesystem::path& folder);

/// Where the record of a run keeps one of its tables.
[[nodiscard]] std::filesystem::path recorded_file(const std::filesystem::path& results,
                                                  const std::string& run, const char* file);

/// What is kept of a run beside its case: drops.csv and history.csv thinned to a hundred-odd steps,
/// and events.csv if anything happened, each headed by who made it and at what cost. Throws
/// InvalidInput when there is no such record.
[[nodiscard]] RunTables read_record(const std::filesystem::path& results, const std::string& run);
void write_record(const std::filesystem::path& results, const std::string& run,
                  const std::filesystem::path& folder);

}  // namespace meniscus
