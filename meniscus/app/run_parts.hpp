#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "meniscus/app/run_directory.hpp"
#include "meniscus/app/run_record.hpp"
#include "meniscus/app/simulation.hpp"
#include "meniscus/case/case.hpp"
#include "meniscus/core/archive.hpp"

namespace meniscus {

// What begins, resumes and ends a run, for the commands and the Python module. Every rank makes the
// same calls.

/// The case with evolution, meshing and either flow solver shared by all ranks.
[[nodiscard]] Case shared_case(Case c);

/// Writes warnings to the log and adds them to `warnings`, for run.json.
[[nodiscard]] WarningListener logged_and_kept(std::vector<std::string>& warnings);

/// The evolution of a new run after its first meshes are made. Throws RunFailure when they cannot
/// be, InvalidInput when the smallest step of the case is too long for its initial shapes.
[[nodiscard]] Evolution begun_evolution(const Case& c, Scene scene);
/// The evolution in the state of a checkpoint. Throws InvalidInput, naming the file, where it does
/// not fit the case.
[[nodiscard]] Evolution resumed_evolution(const Case& c, const Archive& archive,
                                          const std::filesystem::path& checkpoint);

/// Adds to a checkpoint what a resumed run needs to rebuild the evolution: the case, and the folder
/// where its relative file names start.
[[nodiscard]] Simulation::Description case_description(const Case& c,
                                                       const std::filesystem::path& folder);
/// The case that a checkpoint describes, with overrides. Throws InvalidInput, naming the file.
[[nodiscard]] Case case_of_checkpoint(const Archive& archive,
                                      const std::filesystem::path& checkpoint,
                                      std::span<const std::string> overrides);
/// Refuses an end among the overrides that lies before the time t of the checkpoint. The line calls
/// it `name`, and is in the case's unit of time.
void require_end_ahead(const Case& c, double t, std::span<const std::string> overrides,
                       std::string_view name);
/// Refuses overrides of drops, domain and units: the checkpoint holds their evolved state.
void require_changeable(std::span<const std::string> overrides);

/// The folder of a new run, with reference.csv of the case's folder if there is one, on rank 0;
/// none on others. Collective.
[[nodiscard]] std::optional<RunDirectory> new_directory(const std::filesystem::path& folder,
                                                        bool is_overwrite,
                                                        const Evolution& evolution,
                                                        const std::filesystem::path& case_folder);
/// Takes up a run where an evolution stands: in its folder, or in another one that gets its rows
/// and frames. Then `record` goes on as well. A copy that cannot be taken up is removed. On rank 0;
/// the others get none. Collective.
std::optional<RunDirectory> taken_up_run(const std::filesystem::path& source,
                                         const std::filesystem::path& folder,
                                         const Evolution& evolution, RunRecord& record);
/// Throws InvalidInput unless the checkpoint was taken in the given run.
void require_same_run(const Archive& archive, const std::filesystem::path& checkpoint,
                      const std::filesystem::path& run);

/// Brings run.json and the report up to date. Collective.
void finish(const Simulation& simulation, const RunRecord& record, const std::string& status);

}  // namespace meniscus
