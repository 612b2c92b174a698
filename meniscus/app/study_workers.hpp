#pragma once

#include <filesystem>
#include <list>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "meniscus/app/child_program.hpp"

namespace meniscus {

/// A command of this program that a study wants carried out.
struct StudyTask {
  std::string name;  ///< of its run
  std::vector<std::string> arguments;
  std::filesystem::path log;  ///< takes what it prints
};

/// A task that has ended.
struct EndedTask {
  std::string name;
  int status = 0;            ///< exit status; 128 and the signal where one ended it
  std::string failure = {};  ///< why there is no status
};

/// What carries out the tasks of a study.
class StudyWorkers {
 public:
  StudyWorkers() = default;
  StudyWorkers(const StudyWorkers&) = delete;
  StudyWorkers& operator=(const StudyWorkers&) = delete;
  virtual ~StudyWorkers() = default;

  /// Whether a task of an earlier call is still at work on this run. It then counts as started.
  [[nodiscard]] virtual bool has_taken_up(const std::string& name) = 0;
  /// Throws RunFailure when the system refuses.
  virtual void start(std::span<const StudyTask> tasks) = 0;
  /// The tasks that have ended since the last call. Does not wait.
  [[nodiscard]] virtual std::vector<EndedTask> ended() = 0;
  /// The user wants to stop. Returns whether tasks end now, so that they are to be waited for.
  [[nodiscard]] virtual bool interrupt() = 0;
  /// What the user should know of the tasks that an interrupted study leaves; may be empty.
  [[nodiscard]] virtual std::string parting_words() const { return {}; }
};

/// Processes beside this one. They end with it.
class LocalWorkers : public StudyWorkers {
 public:
  [[nodiscard]] bool has_taken_up(const std::string&) override { return false; }
  void start(std::span<const StudyTask> tasks) override;
  [[nodiscard]] std::vector<EndedTask> ended() override;
  [[nodiscard]] bool interrupt() override;

 private:
  struct Job {
    std::string name;
    ChildProgram program;
  };
  std::list<Job> jobs_;
};

}  // namespace meniscus
