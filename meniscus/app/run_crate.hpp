#pragma once

#include <filesystem>

namespace meniscus {

/// Writes ro-crate-metadata.json, which describes the files of a run's folder as RO-Crate 1.1 has
/// it. It has every file of the run that is there with what it holds, the program, and the run as
/// an action with its times. Title, times and version are those of run.json, which must be there.
/// Whoever publishes the folder adds a licence and authors.
void write_run_crate(const std::filesystem::path& folder);

}  // namespace meniscus
