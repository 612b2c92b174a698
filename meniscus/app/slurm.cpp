#include "meniscus/app/slurm.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <sstream>

#include <fmt/format.h>
#include <sys/wait.h>

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

/// Exit status of a shell that does not find a command.
constexpr int kNotFound = 127;
/// Begins the line of a script that names a task.
constexpr std::string_view kNameMark = "# task ";

struct Answer {
  int status = 0;
  std::string text;  ///< standard output and standard error
};

Answer ask(const std::string& command) {
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) throw RunFailure(fmt::format("{}: no process could be started", command));
  Answer answer;
  std::array<char, 4096> bytes{};
  for (std::size_t count = 0; (count = std::fread(bytes.data(), 1, bytes.size(), pipe)) > 0;)
    answer.text.append(bytes.data(), count);
  const int status = pclose(pipe);
  answer.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return answer;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

std::string command_line(std::span<const std::string> words) {
  std::vector<std::string> quoted;
  for (const std::string& word : words) quoted.push_back(shell_word(word));
  return fmt::format("{}", fmt::join(quoted, " "));
}

}  // namespace

std::string shell_word(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::string array_script(std::span<const ArrayTask> tasks) {
  std::string text =
      "#!/bin/sh\n"
      "# A job array of a study, by meniscus. A task leaves its exit status in a file.\n"
      "finish() { status=$1; shift; echo \"$1\" > \"$status.new\" && mv \"$status.new\" "
      "\"$status\"; }\n"
      "case $SLURM_ARRAY_TASK_ID in\n";
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    const ArrayTask& task = tasks[k];
    text += fmt::format("{}{}\n{}) {} > {} 2>&1; finish {} $? ;;\n", kNameMark, task.name, k,
                        command_line(task.command), shell_word(task.log.string()),
                        shell_word(task.status.string()));
  }
  return text + "esac\n";
}

std::vector<std::string> names_in_script(const std::string& script) {
  std::vector<std::string> names;
  std::istringstream lines(script);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(kNameMark)) names.push_back(line.substr(kNameMark.size()));
  return names;
}

void submit_array(const std::filesystem::path& script, std::size_t count, int ranks) {
  std::filesystem::path said = script;
  said.replace_extension();
  const std::array<std::string, 7> words{"sbatch",
                                         "--parsable",
                                         "--job-name=meniscus-study",
                                         fmt::format("--array=0-{}", count - 1),
                                         fmt::format("--ntasks={}", ranks),
                                         fmt::format("--output={}-%a.out", said.string()),
                                         script.string()};
  const Answer answer = ask(command_line(words));
  if (answer.status != 0)
    throw RunFailure(fmt::format("sbatch refused the jobs: {}", first_line(answer.text)));
}

bool QueuedTask::is_over() const {
  constexpr std::array kOver{"COMPLETED", "CANCELLED", "FAILED",   "TIMEOUT",      "NODE_FAIL",
                             "PREEMPTED", "BOOT_FAIL", "DEADLINE", "OUT_OF_MEMORY"};
  return std::ranges::find(kOver, state) != kOver.end();
}

std::vector<QueuedTask> parse_queue(const std::string& text) {
  std::vector<QueuedTask> tasks;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string state, job, index, script;
    words >> state >> job >> index >> std::ws;
    std::getline(words, script);
    std::size_t k = 0;
    const auto [end, error] = std::from_chars(index.data(), index.data() + index.size(), k);
    if (error != std::errc() || end != index.data() + index.size()) continue;  // of no array
    tasks.push_back({fmt::format("{}_{}", job, k), state, script, k});
  }
  return tasks;
}

std::vector<QueuedTask> queued_tasks() {
  const Answer answer = ask("squeue --me --array --noheader --states=all --format='%T %F %K %o'");
  if (answer.status == kNotFound)
    reject_input(
        "--slurm: there is no Slurm here (squeue is not found); --jobs N runs on this "
        "machine");
  if (answer.status != 0)
    throw RunFailure(fmt::format("--slurm: Slurm does not answer: {}", first_line(answer.text)));
  return parse_queue(answer.text);
}

}  // namespace meniscus
