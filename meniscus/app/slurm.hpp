#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace meniscus {

// Job arrays of Slurm, by its commands sbatch and squeue.

/// A text as one word of a shell's command line.
[[nodiscard]] std::string shell_word(const std::string& text);

/// One task of a job array.
struct ArrayTask {
  std::string name;
  std::vector<std::string> command;
  std::filesystem::path log;     ///< takes what it prints
  std::filesystem::path status;  ///< gets its exit status, in one piece, when it ends
};
/// The batch script of a job array whose task k does tasks[k].
[[nodiscard]] std::string array_script(std::span<const ArrayTask> tasks);
/// The names of the tasks of a script of `array_script`, in order.
[[nodiscard]] std::vector<std::string> names_in_script(const std::string& script);

/// Submits the script as an array of `count` tasks with `ranks` processors each. What Slurm itself
/// says of task k goes to <script without its ending>-<k>.out. Everything else, such as partition
/// and time limit, sbatch takes from its environment (SBATCH_PARTITION, …). Throws RunFailure with
/// sbatch's line when it refuses.
void submit_array(const std::filesystem::path& script, std::size_t count, int ranks);

/// A task of an array as Slurm knows it.
struct QueuedTask {
  std::string job;    ///< "12_3"
  std::string state;  ///< "RUNNING", …
  std::filesystem::path script;
  std::size_t index = 0;
  [[nodiscard]] bool is_over() const;
};
/// The lines of squeue, one for a task: state, array job's id, index and script.
[[nodiscard]] std::vector<QueuedTask> parse_queue(const std::string& text);
/// The user's array tasks that Slurm still knows, those that ended a short while ago included.
/// Throws InvalidInput where there is no Slurm, RunFailure where it does not answer.
[[nodiscard]] std::vector<QueuedTask> queued_tasks();

}  // namespace meniscus
