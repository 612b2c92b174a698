#pragma once

#include <chrono>
#include <map>

#include "meniscus/app/slurm.hpp"
#include "meniscus/app/study_workers.hpp"

namespace meniscus {

/// Job arrays of Slurm, which outlive this process. Their scripts lie in <output>/slurm, by which
/// a later call finds in the queue what an earlier one submitted, at whatever moment that ended.
class SlurmWorkers : public StudyWorkers {
 public:
  /// Asks Slurm for the tasks of earlier calls. Throws InvalidInput where there is no Slurm,
  /// RunFailure where it does not answer. Does not write.
  SlurmWorkers(const std::filesystem::path& output, int ranks);

  [[nodiscard]] bool has_taken_up(const std::string& name) override;
  void start(std::span<const StudyTask> tasks) override;
  [[nodiscard]] std::vector<EndedTask> ended() override;
  [[nodiscard]] bool interrupt() override { return false; }
  [[nodiscard]] std::string parting_words() const override;

 private:
  struct Job {
    std::filesystem::path script;
    std::size_t index = 0;
    int times_missed = 0;  ///< how often in a row Slurm took it for over or did not know it
    std::string state = {};
  };
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] ArrayTask array_task(const StudyTask& task) const;
  [[nodiscard]] std::filesystem::path status_file(const std::string& name) const;
  void submit(std::span<const StudyTask> tasks);
  void ask_queue();

  std::filesystem::path output_, folder_;
  int ranks_;
  std::string program_;
  std::map<std::string, Job> jobs_;     // by run: those that are watched
  std::map<std::string, Job> earlier_;  // of earlier calls, still at work
  Clock::time_point last_answer_, last_question_;
};

}  // namespace meniscus
