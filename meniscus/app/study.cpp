#include "meniscus/app/study.hpp"

#include <algorithm>
#include <chrono>
#include <list>
#include <thread>

#include <fmt/format.h>

#include "meniscus/app/child_program.hpp"
#include "meniscus/app/interrupt.hpp"
#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

using Say = std::function<void(const std::string&)>;

/// How often ended processes are looked for.
constexpr std::chrono::milliseconds kPause{20};

/// What is told of each run that has ended.
using Listener = std::function<void(const StudyRun&, const StudyRunResult&)>;

/// The runs at work, each in a process of its own.
class Jobs {
 public:
  Jobs(const StudyFolders& folders, Listener listener)
      : folders_(folders), listener_(std::move(listener)) {}

  [[nodiscard]] std::size_t count() const { return jobs_.size(); }
  [[nodiscard]] bool hold(const StudyRun& run) const {
    return std::ranges::any_of(jobs_, [&](const Job& job) { return job.run.name == run.name; });
  }
  /// Brings a run forward. One that is done, or cannot be, is told at once.
  void start(const StudyRun& run) { start(run, {}); }
  /// Takes up what has ended. A run that has more to do goes on, unless `is_last`.
  void collect(bool is_last);
  void interrupt() const {
    for (const Job& job : jobs_) job.program.interrupt();
  }

 private:
  struct Job {
    StudyRun run;
    ChildProgram program;
    std::vector<std::string> command;
  };
  void start(const StudyRun& run, const std::vector<std::string>& before);

  const StudyFolders& folders_;
  Listener listener_;
  std::list<Job> jobs_;
};

void Jobs::start(const StudyRun& run, const std::vector<std::string>& before) {
  try {
    const auto command = folders_.next_command(run);
    if (!command) return listener_(run, folders_.result(run));
    if (*command == before) return listener_(run, {.failure = "it ended without a result"});
    jobs_.push_back({run, ChildProgram(*command, folders_.log(run)), *command});
  } catch (const std::exception& fault) {
    listener_(run, {.failure = fault.what()});
  }
}

void Jobs::collect(bool is_last) {
  std::list<Job> running = std::move(jobs_);
  jobs_.clear();
  for (Job& job : running) {
    const std::optional<int> status = job.program.status();
    if (!status)
      jobs_.push_back(std::move(job));
    else if (is_last)
      continue;
    else if (*status == 0)
      start(job.run, job.command);
    else
      listener_(job.run, folders_.failure(job.run, *status));
  }
}

std::string line_of(const StudyRun& run, const StudyRunResult& result, bool is_of_bisection) {
  if (!result.failure.empty()) return fmt::format("{}: failed: {}", run.name, result.failure);
  const std::string word = is_of_bisection ? word_for(result.verdict()) : result.ended;
  return fmt::format("{}: {} at t = {:.4g}, L = {:.4f}", run.name, word, result.t, result.L);
}

}  // namespace

Study::Study(StudyFolders folders)
    : folders_(std::move(folders)), results_(folders_.points().size()) {
  if (const auto& bisection = folders_.study().bisection)
    for (StudyPointResult& result : results_) result.bracket.emplace(*bisection);
}

std::vector<StudyRun> Study::wanted() const {
  std::vector<StudyRun> runs;
  for (std::size_t i = 0; i < results_.size(); ++i) {
    if (!results_[i].bracket) {
      if (results_[i].runs.empty()) runs.push_back(folders_.run_at(i));
      continue;
    }
    for (const double value : results_[i].bracket->wanted())
      runs.push_back(folders_.run_at(i, value));
  }
  return runs;
}

void Study::add(const StudyRun& run, const StudyRunResult& result) {
  StudyPointResult& point = results_[run.point];
  point.runs[run.value.value_or(0.0)] = result;
  if (point.bracket) point.bracket->add(*run.value, result.verdict());
}

int Study::num_failed() const {
  int count = 0;
  for (const StudyPointResult& point : results_)
    for (const auto& [value, result] : point.runs) count += result.failure.empty() ? 0 : 1;
  return count;
}

bool Study::run(int jobs, const Say& say) {
  MENISCUS_ASSERT(jobs > 0, "{} jobs", jobs);
  watch_for_interrupts();
  Jobs running(folders_, [&](const StudyRun& run, const StudyRunResult& result) {
    add(run, result);
    say(line_of(run, result, folders_.study().bisection.has_value()));
  });
  // Runs that are done make others wanted, so that the list is made anew for each.
  const auto next = [&]() -> std::optional<StudyRun> {
    for (const StudyRun& run : wanted())
      if (!running.hold(run)) return run;
    return std::nullopt;
  };
  for (bool is_asked = false;;) {
    while (!is_interrupted() && running.count() < static_cast<std::size_t>(jobs)) {
      const std::optional<StudyRun> run = next();
      if (!run) break;
      running.start(*run);
    }
    if (running.count() == 0) return !is_interrupted();
    if (is_interrupted() && !is_asked) {
      running.interrupt();
      is_asked = true;
    }
    std::this_thread::sleep_for(kPause);
    running.collect(is_interrupted());
  }
}

}  // namespace meniscus
