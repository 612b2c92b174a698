#include "meniscus/app/study_command.hpp"

#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>

#include <fmt/format.h>

#include "meniscus/app/folder_lock.hpp"
#include "meniscus/app/shipped_docs.hpp"
#include "meniscus/app/slurm_workers.hpp"
#include "meniscus/app/study.hpp"
#include "meniscus/case/study_file.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/io/atomic_file.hpp"

namespace meniscus {
namespace {

namespace fs = std::filesystem;

constexpr const char *kTable = "study.csv", *kPage = "study.html";

fs::path output_of(const StudyArguments& arguments) {
  return arguments.output.empty() ? fs::path(arguments.study_file).stem()
                                  : fs::path(arguments.output);
}

/// Throws InvalidInput where there is no such file, with the place of the shipped one.
void require_study_file(const fs::path& file) {
  if (fs::exists(file)) return;
  const fs::path shipped = shipped_docs() / file;
  reject_input("{}: no such file{}", file.string(),
               fs::exists(shipped) ? "; there is " + shipped.string() : "");
}

std::unique_ptr<StudyWorkers> make_workers(const StudyArguments& arguments,
                                           const fs::path& output) {
  if (arguments.is_slurm) return std::make_unique<SlurmWorkers>(output, arguments.ranks);
  return std::make_unique<LocalWorkers>();
}

std::string stopping_words(const StudyWorkers& workers) {
  const std::string parting = workers.parting_words();
  return fmt::format("stopped; the same command goes on{}{}", parting.empty() ? "" : "; ", parting);
}

void write_results(const Study& study) {
  io::write_file(study.folders().output() / kTable, study_table(study));
}

}  // namespace

int study_command(const StudyArguments& arguments) {
  require_study_file(arguments.study_file);
  if (arguments.jobs && *arguments.jobs < 1)
    reject_input("--jobs {}: must be 1 or more", *arguments.jobs);
  const StudyFile file = read_study_file(arguments.study_file);
  require_valid_cases(file);
  Study study(StudyFolders(file, output_of(arguments), arguments.is_overwrite));
  const fs::path output = study.folders().output();
  const std::unique_ptr<StudyWorkers> workers = make_workers(arguments, output);
  std::error_code error;
  fs::create_directories(output / "runs", error);
  if (error) reject_input("output folder {} cannot be made: {}", output.string(), error.message());
  const FolderLock lock(output);
  const auto say = [&](const std::string& line) {
    write_results(study);
    if (arguments.is_quiet) return;
    fmt::print("{}\n", line);
    std::fflush(stdout);
  };
  const std::size_t all = std::numeric_limits<std::size_t>::max();
  const std::size_t most = arguments.jobs       ? static_cast<std::size_t>(*arguments.jobs)
                           : arguments.is_slurm ? all
                                                : 1;
  const bool is_done = study.run(*workers, most, say);
  write_results(study);
  report::write_study_page(study_page(study), output / kPage);
  const int failed = study.num_failed();
  if (is_done)
    for (const std::string& line : study_outcomes(study)) say(line);
  if (!is_done)
    say(stopping_words(*workers));
  else
    say(fmt::format("done{}; see {}", failed > 0 ? fmt::format(", {} runs failed", failed) : "",
                    (output / kPage).string()));
  return is_done && failed == 0 ? 0 : 1;
}

}  // namespace meniscus
