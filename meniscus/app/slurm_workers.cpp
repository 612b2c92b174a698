#include "meniscus/app/slurm_workers.hpp"

#include <algorithm>
#include <charconv>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "meniscus/core/error.hpp"
#include "meniscus/io/atomic_file.hpp"

namespace meniscus {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// Slurm allows 1000 tasks in an array unless set up otherwise (MaxArraySize 1001).
constexpr std::size_t kMostTasks = 1000;
/// Slurm is asked no more often than this, as all users share its controller.
constexpr auto kPause = 5s;
/// A controller that does not answer for so long is gone.
constexpr auto kPatience = 10min;
/// A task that is over has left its status; over a network that may be seen late.
constexpr int kMissedUntilLost = 3;

int next_number(const fs::path& folder) {
  int last = 0;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().stem().string();
    int number = 0;
    if (entry.path().extension() == ".sh" &&
        std::from_chars(name.data(), name.data() + name.size(), number).ec == std::errc())
      last = std::max(last, number);
  }
  return last + 1;
}

}  // namespace

SlurmWorkers::SlurmWorkers(const fs::path& output, int ranks)
    : output_(fs::weakly_canonical(output)),
      folder_(output_ / "slurm"),
      ranks_(ranks),
      program_(fs::read_symlink("/proc/self/exe").string()),
      last_answer_(Clock::now()),
      last_question_(Clock::now()) {
  for (const QueuedTask& task : queued_tasks()) {
    if (task.is_over() || task.script.parent_path() != folder_ || !fs::exists(task.script))
      continue;
    const std::vector<std::string> names = names_in_script(io::read_file(task.script));
    if (task.index < names.size())
      earlier_[names[task.index]] = {.script = task.script, .index = task.index};
  }
}

fs::path SlurmWorkers::status_file(const std::string& name) const {
  return output_ / "runs" / (name + ".status");
}

ArrayTask SlurmWorkers::array_task(const StudyTask& task) const {
  ArrayTask result{task.name, {}, fs::absolute(task.log), status_file(task.name)};
  if (ranks_ > 1) result.command = {"mpirun", "-n", fmt::format("{}", ranks_)};
  result.command.push_back(program_);
  result.command.insert(result.command.end(), task.arguments.begin(), task.arguments.end());
  return result;
}

bool SlurmWorkers::has_taken_up(const std::string& name) {
  const auto found = earlier_.find(name);
  if (found == earlier_.end()) return false;
  jobs_[name] = found->second;
  earlier_.erase(found);
  return true;
}

void SlurmWorkers::start(std::span<const StudyTask> tasks) {
  for (std::size_t begin = 0; begin < tasks.size(); begin += kMostTasks)
    submit(tasks.subspan(begin, std::min(kMostTasks, tasks.size() - begin)));
}

void SlurmWorkers::submit(std::span<const StudyTask> tasks) {
  fs::create_directories(folder_);
  std::vector<ArrayTask> array;
  for (const StudyTask& task : tasks) {
    array.push_back(array_task(task));
    fs::remove(array.back().status);
  }
  const fs::path script = folder_ / fmt::format("{:04}.sh", next_number(folder_));
  io::write_file(script, array_script(array));
  submit_array(script, tasks.size(), ranks_);
  for (std::size_t k = 0; k < tasks.size(); ++k)
    jobs_[tasks[k].name] = {.script = script, .index = k};
}

void SlurmWorkers::ask_queue() {
  const Clock::time_point now = Clock::now();
  if (now - last_question_ < kPause) return;
  last_question_ = now;
  std::vector<QueuedTask> queue;
  try {
    queue = queued_tasks();
  } catch (const RunFailure&) {
    if (now - last_answer_ > kPatience) throw;
    return;  // a controller may be restarted
  }
  last_answer_ = now;
  for (auto& [name, job] : jobs_) {
    const auto found = std::ranges::find_if(queue, [&](const QueuedTask& task) {
      return task.script == job.script && task.index == job.index;
    });
    const bool is_at_work = found != queue.end() && !found->is_over();
    job.times_missed = is_at_work ? 0 : job.times_missed + 1;
    if (found != queue.end()) job.state = fmt::format("{}: {}", found->job, found->state);
  }
}

std::vector<EndedTask> SlurmWorkers::ended() {
  ask_queue();
  std::vector<EndedTask> ended;
  for (const auto& [name, job] : jobs_) {
    int status = 0;
    const fs::path file = status_file(name);
    const std::string text = fs::exists(file) ? io::read_file(file) : "";
    if (std::from_chars(text.data(), text.data() + text.size(), status).ec == std::errc())
      ended.push_back({.name = name, .status = status});
    else if (job.times_missed >= kMissedUntilLost)
      ended.push_back(
          {.name = name,
           .failure = fmt::format("Slurm ended its job {}; the next call goes on with it",
                                  job.state.empty() ? "unseen" : job.state)});
  }
  for (const EndedTask& task : ended) jobs_.erase(task.name);
  return ended;
}

std::string SlurmWorkers::parting_words() const {
  if (jobs_.empty() && earlier_.empty()) return {};
  return fmt::format("{} jobs go on in Slurm, of the scripts in {}", jobs_.size() + earlier_.size(),
                     folder_.string());
}

}  // namespace meniscus
