#include "meniscus/app/study.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <span>
#include <thread>

#include <fmt/format.h>

#include "meniscus/app/interrupt.hpp"
#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

using Say = std::function<void(const std::string&)>;

/// How often ended processes are looked for.
constexpr std::chrono::milliseconds kPause{20};

/// What is told of each run that has ended.
using Listener = std::function<void(const StudyRun&, const StudyRunResult&)>;

/// The runs at work, each by a task of the workers.
class Jobs {
 public:
  Jobs(const StudyFolders& folders, StudyWorkers& workers, Listener listener)
      : folders_(folders), workers_(workers), listener_(std::move(listener)) {}

  [[nodiscard]] std::size_t count() const { return jobs_.size(); }
  [[nodiscard]] bool hold(const StudyRun& run) const { return jobs_.contains(run.name); }
  /// Brings runs forward. Those that are done, or cannot be, are told at once.
  void start(std::span<const StudyRun> runs);
  /// Takes up what has ended. A run that has more to do goes on, unless `is_last`.
  void collect(bool is_last);

 private:
  struct Job {
    StudyRun run;
    std::vector<std::string> command;  // empty: an earlier call's, not known
  };
  /// The task that brings a run forward, if there is any.
  std::optional<StudyTask> task_for(const StudyRun& run, const std::vector<std::string>& before);
  void start(std::span<const StudyTask> tasks);

  const StudyFolders& folders_;
  StudyWorkers& workers_;
  Listener listener_;
  std::map<std::string, Job> jobs_;
};

std::optional<StudyTask> Jobs::task_for(const StudyRun& run,
                                        const std::vector<std::string>& before) {
  try {
    const auto command = folders_.next_command(run);
    if (!command) {
      listener_(run, folders_.result(run));
    } else if (*command == before) {
      listener_(run, {.failure = "it ended without a result"});
    } else {
      jobs_[run.name] = {run, *command};
      return StudyTask{run.name, *command, folders_.log(run)};
    }
  } catch (const std::exception& fault) {
    listener_(run, {.failure = fault.what()});
  }
  return std::nullopt;
}

void Jobs::start(std::span<const StudyTask> tasks) {
  if (!tasks.empty()) workers_.start(tasks);
}

void Jobs::start(std::span<const StudyRun> runs) {
  std::vector<StudyTask> tasks;
  for (const StudyRun& run : runs) {
    if (workers_.has_taken_up(run.name))
      jobs_[run.name] = {run, {}};
    else if (auto task = task_for(run, {}))
      tasks.push_back(std::move(*task));
  }
  start(tasks);
}

void Jobs::collect(bool is_last) {
  std::vector<StudyTask> further;
  for (const EndedTask& ended : workers_.ended()) {
    const Job job = std::move(jobs_.extract(ended.name).mapped());
    if (is_last) continue;
    if (!ended.failure.empty())
      listener_(job.run, {.failure = ended.failure});
    else if (ended.status != 0)
      listener_(job.run, folders_.failure(job.run, ended.status));
    else if (auto task = task_for(job.run, job.command))
      further.push_back(std::move(*task));
  }
  start(further);
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
    if (const auto value = results_[i].bracket->wanted())
      runs.push_back(folders_.run_at(i, *value));
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

bool Study::run(StudyWorkers& workers, std::size_t most, const Say& say) {
  MENISCUS_ASSERT(most > 0, "no run at a time");
  watch_for_interrupts();
  Jobs running(folders_, workers, [&](const StudyRun& run, const StudyRunResult& result) {
    add(run, result);
    say(line_of(run, result, folders_.study().bisection.has_value()));
  });
  // Runs that are done make others wanted, so that the list is made anew until none is left.
  const auto next = [&] {
    std::vector<StudyRun> runs;
    for (StudyRun& run : wanted())
      if (!running.hold(run) && running.count() + runs.size() < most)
        runs.push_back(std::move(run));
    return runs;
  };
  for (bool is_asked = false;;) {
    for (auto runs = next(); !is_interrupted() && !runs.empty(); runs = next()) running.start(runs);
    if (running.count() == 0) return !is_interrupted();
    if (is_interrupted() && !is_asked) {
      if (!workers.interrupt()) return false;
      is_asked = true;
    }
    std::this_thread::sleep_for(kPause);
    running.collect(is_interrupted());
  }
}

}  // namespace meniscus
