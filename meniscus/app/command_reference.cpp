#include "meniscus/app/command_reference.hpp"

#include <algorithm>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "meniscus/case/benchmark.hpp"
#include "meniscus/case/examples.hpp"
#include "meniscus/case/schema.hpp"
#include "meniscus/core/version.hpp"

namespace meniscus {
namespace {

/// Text as man(7) takes it: no dash becomes a hyphen, no backslash or point at the margin a
/// request.
std::string roff(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const bool is_at_margin = result.empty() || result.back() == '\n';
    if (is_at_margin && (c == '.' || c == '\'')) result += "\\&";
    if (c == '-') result += '\\';
    result += c;
    if (c == '\\') result += 'e';
  }
  return result;
}

std::string bold(std::string_view text) { return fmt::format("\\fB{}\\fR", roff(text)); }
std::string italic(std::string_view text) { return fmt::format("\\fI{}\\fR", roff(text)); }

std::vector<const CLI::App*> commands(const CLI::App& program) {
  return program.get_subcommands([](const CLI::App* app) { return !app->get_group().empty(); });
}

std::vector<const CLI::Option*> options(const CLI::App& command, bool positional) {
  return command.get_options(
      [&](const CLI::Option* option) { return option->get_positional() == positional; });
}

/// All names with their dashes, short ones first.
std::vector<std::string> names(const CLI::Option& option) {
  std::vector<std::string> result;
  for (const std::string& name : option.get_snames()) result.push_back(fmt::format("-{}", name));
  for (const std::string& name : option.get_lnames()) result.push_back(fmt::format("--{}", name));
  return result;
}

std::string usage(const CLI::App& command) {
  std::string text = bold("meniscus " + command.get_name());
  for (const CLI::Option* option : options(command, true)) {
    const std::string name = italic(option->get_name(true));
    const char* more = option->get_items_expected_max() > 1 ? " ..." : "";
    text += option->get_required() ? fmt::format(" {}{}", name, more)
                                   : fmt::format(" [{}{}]", name, more);
  }
  return fmt::format("{} [{}]", text, italic("OPTIONS"));
}

std::string described(const CLI::Option& option) {
  std::string head;
  if (option.get_positional()) {
    head = italic(option.get_name(true));
  } else {
    for (const std::string& name : names(option)) head += (head.empty() ? "" : ", ") + bold(name);
    if (option.get_items_expected_max() > 0)
      head += fmt::format(" {}", italic(option.get_type_name()));
  }
  std::string text = roff(option.get_description());
  if (!option.get_default_str().empty())
    text += roff(fmt::format(" [{}]", option.get_default_str()));
  return fmt::format(".TP\n{}\n{}\n", head, text);
}

std::string section(const CLI::App& command) {
  std::string text = fmt::format(".SS {}\n{}\n.PP\n{}.\n", command.get_name(), usage(command),
                                 roff(command.get_description()));
  for (const bool positional : {true, false})
    for (const CLI::Option* option : options(command, positional)) text += described(*option);
  if (const std::string footer = command.get_footer(); !footer.empty())
    text += fmt::format(".PP\n{}\n", roff(footer));
  return text;
}

/// The names that a command takes as its first word; none where it takes files.
std::vector<std::string> first_words(const std::string& command) {
  std::vector<std::string> result;
  if (command == "examples")
    for (const ExampleCase& each : examples()) result.emplace_back(each.name);
  if (command == "check")
    for (const BenchmarkFile& each : benchmark_files()) result.emplace_back(each.name);
  if (command == "explain")
    for (const schema::Key& each : schema::keys())
      result.push_back(schema::without_indices(each.path));
  return result;
}

std::vector<std::string> option_words(const CLI::App& command) {
  std::vector<std::string> result;
  for (const CLI::Option* option : options(command, false)) {
    const std::vector<std::string> all = names(*option);
    result.insert(result.end(), all.begin(), all.end());
  }
  return result;
}

}  // namespace

std::string manual_page(const CLI::App& program) {
  std::string text = fmt::format(
      ".TH MENISCUS 1 \"\" \"Meniscus {}\" \"User Commands\"\n.SH NAME\nmeniscus \\- {}\n"
      ".SH SYNOPSIS\n",
      version_string, roff(program.get_description()));
  for (const CLI::App* command : commands(program)) text += usage(*command) + "\n.br\n";
  text += fmt::format("{} {} {} {}\n.SH DESCRIPTION\n", bold("mpirun -n"), italic("N"),
                      bold("meniscus run"), italic("case"));
  text += roff(
      "A case file in TOML says what is simulated; \"meniscus explain\" tells its keys, "
      "\"meniscus examples\" writes one to begin with. A run leaves a folder of tables, "
      "frames for ParaView, checkpoints and a page of plots.\n");
  text += ".SH COMMANDS\n";
  for (const CLI::App* command : commands(program)) text += section(*command);
  text += ".SH EXIT STATUS\n";
  for (const auto& [status, meaning] :
       {std::pair("0", "All went well."),
        {"1", "A run could not go on, and left a checkpoint; or a check is outside its tolerance."},
        {"2", "The input was wrong; nothing was written."}})
    text += fmt::format(".TP\n{}\n{}\n", bold(status), roff(meaning));
  return text + ".SH SEE ALSO\n" + bold("mpirun") + "(1)\n";
}

std::string bash_completion(const CLI::App& program) {
  std::vector<std::string> known;
  std::string cases;
  for (const CLI::App* command : commands(program)) {
    known.push_back(command->get_name());
    cases += fmt::format("    {}) options=\"{}\"; names=\"{}\" ;;\n", command->get_name(),
                         fmt::join(option_words(*command), " "),
                         fmt::join(first_words(command->get_name()), " "));
  }
  return fmt::format(
      R"(# Completion of meniscus for bash; "meniscus completion" writes it.
_meniscus() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} command="" options names word
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
    case $word in {}) command=$word; break ;; esac
  done
  case $command in
    "") options="{}"; names="{}" ;;
{}  esac
  case $current in
    -*) COMPREPLY=($(compgen -W "$options" -- "$current")) ;;
    *) COMPREPLY=($(compgen -W "$names" -- "$current")) ;;
  esac
}}
complete -o default -F _meniscus meniscus
)",
      fmt::join(known, "|"), fmt::join(option_words(program), " "), fmt::join(known, " "), cases);
}

}  // namespace meniscus
