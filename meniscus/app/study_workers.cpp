#include "meniscus/app/study_workers.hpp"

namespace meniscus {

void LocalWorkers::start(std::span<const StudyTask> tasks) {
  for (const StudyTask& task : tasks)
    jobs_.push_back({task.name, ChildProgram(task.arguments, task.log)});
}

std::vector<EndedTask> LocalWorkers::ended() {
  std::vector<EndedTask> ended;
  for (auto job = jobs_.begin(); job != jobs_.end();) {
    const std::optional<int> status = job->program.status();
    if (status) ended.push_back({.name = job->name, .status = *status});
    job = status ? jobs_.erase(job) : std::next(job);
  }
  return ended;
}

bool LocalWorkers::interrupt() {
  for (const Job& job : jobs_) job.program.interrupt();
  return true;
}

}  // namespace meniscus
