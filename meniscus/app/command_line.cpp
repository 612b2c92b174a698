#include "meniscus/app/command_line.hpp"

#include <cstdio>
#include <functional>

#include <CLI/CLI.hpp>

#include "meniscus/app/commands.hpp"
#include "meniscus/app/interrupt.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/core/log.hpp"
#include "meniscus/core/version.hpp"

namespace meniscus {
namespace {

using Action = std::function<int()>;

void add_run(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<RunArguments>();
  CLI::App* command = app.add_subcommand("run", "Simulate a case");
  command->add_option("case", arguments->case_file, "Case file (TOML)")->required();
  command->add_option("-o,--output", arguments->output,
                      "Folder for the results [the case file's name]");
  command
      ->add_option("--set", arguments->overrides,
                   "Override a key of the case: --set drop[0].nodes=200")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_flag("--overwrite", arguments->is_overwrite, "Replace the run the folder holds");
  command->add_flag("-q,--quiet", arguments->is_quiet, "Print nothing but errors");
  command->callback(
      [&action, arguments] { action = [arguments] { return run_command(*arguments); }; });
}

void add_resume(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<ResumeArguments>();
  CLI::App* command = app.add_subcommand("resume", "Go on with a run from its last checkpoint");
  command->add_option("directory", arguments->directory, "Folder of the run")->required();
  command->add_option("--until", arguments->until, "New end time");
  CLI::Option* from =
      command->add_option("--from", arguments->from, "Go on from this checkpoint file");
  CLI::Option* output =
      command->add_option("-o,--output", arguments->output, "New folder, with --from");
  from->needs(output);
  output->needs(from);
  command->add_flag("-q,--quiet", arguments->is_quiet, "Print nothing but errors");
  command->callback(
      [&action, arguments] { action = [arguments] { return resume_command(*arguments); }; });
}

void add_mesh(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<MeshArguments>();
  CLI::App* command =
      app.add_subcommand("mesh", "Make a case's initial meshes and print their quality");
  command->add_option("case", arguments->case_file, "Case file (TOML)")->required();
  command->add_option("-o,--output", arguments->output, "Volume mesh file (.vtu)");
  command->add_option("--set", arguments->overrides, "Override a key of the case")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->callback(
      [&action, arguments] { action = [arguments] { return mesh_command(*arguments); }; });
}

void add_report(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<ReportArguments>();
  CLI::App* command = app.add_subcommand("report", "Make a run's page of plots again, or stills");
  command->add_option("directory", arguments->directory, "Folder of the run")->required();
  command->add_flag("--svg", arguments->is_svg, "Write interface.svg and history.svg instead");
  command->callback(
      [&action, arguments] { action = [arguments] { return report_command(*arguments); }; });
}

void add_explain(CLI::App& app, Action& action) {
  auto key = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("explain", "What a case-file key means: type, range, default, unit");
  command->add_option("key", *key, "Key such as drop.nodes, or a table such as flow [all]");
  command->callback([&action, key] { action = [key] { return explain_command(*key); }; });
}

void add_examples(CLI::App& app, Action& action) {
  auto name = std::make_shared<std::string>();
  auto is_overwrite = std::make_shared<bool>(false);
  CLI::App* command =
      app.add_subcommand("examples", "List the shipped cases, or write one here to edit");
  command->add_option("name", *name, "Example to write into this folder");
  command->add_flag("--overwrite", *is_overwrite, "Replace a file of that name");
  command->callback([&action, name, is_overwrite] {
    action = [name, is_overwrite] { return examples_command(*name, *is_overwrite); };
  });
}

int print_error(const std::string& text, int status) {
  std::fputs(fmt::format("meniscus: {}\n", text).c_str(), stderr);
  return status;
}

}  // namespace

int run_command_line(int argc, char** argv) {
  CLI::App app("Deforming liquid drops with a sharp, conforming interface", "meniscus");
  app.set_version_flag("--version", fmt::format("meniscus {} ({})", version_string, commit_string));
  app.require_subcommand(1);
  ignore_write_signals();
  Action action;
  for (const auto add : {add_run, add_resume, add_mesh, add_report, add_explain, add_examples})
    add(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    return print_error(fmt::format("{}; see meniscus --help", error.what()), 2);
  }
  try {
    return action();
  } catch (const InvalidInput& error) {
    return print_error(error.what(), 2);
  } catch (const RunFailure& error) {
    return print_error(error.what(), 1);
  } catch (const std::exception& error) {
    return print_error(error.what(), 1);
  }
}

}  // namespace meniscus
