#include "meniscus/app/command_line.hpp"

#include <cstdio>
#include <functional>
#include <new>

#include <CLI/CLI.hpp>

#include "meniscus/app/command_reference.hpp"
#include "meniscus/app/commands.hpp"
#include "meniscus/app/interrupt.hpp"
#include "meniscus/app/study_command.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/core/log.hpp"
#include "meniscus/core/version.hpp"

namespace meniscus {
namespace {

using Action = std::function<int()>;

void add_watch(CLI::App& command, WatchArguments& watch) {
  CLI::Option* flag =
      command.add_flag("--watch", watch.is_on, "Serve the page of the run while it goes on");
  command.add_option("--port", watch.port, "Port of the page; 0: any that is free")
      ->capture_default_str()
      ->check(CLI::Range(0, 65535))
      ->needs(flag);
  command
      .add_option("--listen", watch.address, "Address of the page; others can be seen by others")
      ->capture_default_str()
      ->needs(flag);
}

void add_run(CLI::App& app, Action& action, const SetUp& set_up) {
  auto arguments = std::make_shared<RunArguments>();
  arguments->set_up = set_up;
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
  add_watch(*command, arguments->watch);
  command->callback(
      [&action, arguments] { action = [arguments] { return run_command(*arguments); }; });
}

void add_resume(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<ResumeArguments>();
  CLI::App* command = app.add_subcommand("resume", "Go on with a run from its last checkpoint");
  command->add_option("directory", arguments->directory, "Folder of the run")->required();
  command->add_option("--until", arguments->until, "New end, in the case's unit of time");
  CLI::Option* from =
      command->add_option("--from", arguments->from, "Go on from this checkpoint file");
  CLI::Option* output =
      command->add_option("-o,--output", arguments->output, "New folder, with --from");
  from->needs(output);
  output->needs(from);
  command
      ->add_option(
          "--set", arguments->overrides,
          "With --from, go on with another value of a key: --set topology.breakup-radius=0.005")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->needs(from);
  command->add_flag("-q,--quiet", arguments->is_quiet, "Print nothing but errors");
  add_watch(*command, arguments->watch);
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

void add_remesh(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<RemeshArguments>();
  CLI::App* command = app.add_subcommand(
      "remesh", "Triangulate a closed surface anew; say how good it was, is, and how near to it");
  command->add_option("surface", arguments->surface, "Surface (.stl, .ply, .obj, .off, .vtp, .vtu)")
      ->required();
  command->add_option("-o,--output", arguments->output,
                      "File for the result, of any of these kinds but .vtu [SURFACE-remeshed.EXT]");
  CLI::Option* nodes = command->add_option(
      "--nodes", arguments->nodes,
      "By number of vertices, of all pieces together, dense where curved [as there are]");
  CLI::Option* edge =
      command->add_option("--edge-length", arguments->edge_length, "By mean edge, even everywhere");
  CLI::Option* chord =
      command->add_option("--chordal-error", arguments->chordal_error,
                          "By the largest distance of a face from the smooth surface");
  nodes->excludes(edge)->excludes(chord);
  edge->excludes(chord);
  command->add_option("--edge-floor", arguments->edge_floor, "No edge is asked to be shorter [0]");
  command->add_option("--gradation", arguments->gradation,
                      "Largest growth of the edge length per length [0.5]");
  command->add_flag("--repair", arguments->is_repair,
                    "Mend the surface first: stitch, fill small holes, remove crossing faces");
  command->add_flag("--json", arguments->is_json, "Print the table as JSON");
  command->add_flag("--overwrite", arguments->is_overwrite, "Replace a file of that name");
  command->footer(
      "Faces of any number of corners are cut into triangles, and turned so that the surface is\n"
      "not inside out. With --repair doubled faces and those without area or across others are\n"
      "removed, open edges stitched and holes up to a tenth of the surface filled.\n"
      "Lengths are in the unit of the file. Each piece keeps its volume. Edges and corners of a\n"
      "solid are rounded over about half of the mean edge: the surface is taken to be smooth.");
  command->callback(
      [&action, arguments] { action = [arguments] { return remesh_command(*arguments); }; });
}

void add_report(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<ReportArguments>();
  CLI::App* command = app.add_subcommand("report", "Make a run's page of plots again, or stills");
  command->add_option("directory", arguments->directory, "Folder of the run")->required();
  command->add_flag("--svg", arguments->is_svg,
                    "Write interface, deformation, mesh and history as .svg instead");
  command->add_flag("--png", arguments->is_png, "Write them as .png");
  command->add_flag("--movie", arguments->is_movie, "Write interface.mp4 (needs ffmpeg)");
  command->add_option("--times", arguments->times, "Times of the stills: --times 0,2,10 [spread]")
      ->delimiter(',');
  command->callback(
      [&action, arguments] { action = [arguments] { return report_command(*arguments); }; });
}

void add_compare(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<CompareArguments>();
  CLI::App* command = app.add_subcommand("compare", "Two or more runs in one page");
  command->add_option("directories", arguments->directories, "Folders of the runs")
      ->required()
      ->expected(2, 8);
  command->add_option("-o,--output", arguments->output, "The page to write")->capture_default_str();
  command->callback(
      [&action, arguments] { action = [arguments] { return compare_command(*arguments); }; });
}

void add_check(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App* command =
      app.add_subcommand("check", "Rerun validation cases and compare them with their references");
  CLI::Option* directories =
      command->add_option("directory", arguments->directories,
                          "Folder of a case (case.toml and check.toml), or its name in --cases, "
                          "or, with --against, the name of a benchmark");
  command->add_flag("--all", arguments->is_all, "Every case below --cases")->excludes(directories);
  command->add_option("--cases", arguments->cases,
                      "Folder of the cases [cases, else those installed]");
  command->add_option("-o,--output", arguments->output,
                      "Folder for the runs and check.html [out/check]; with --against, a .csv for "
                      "the differences [none]");
  CLI::Option* against = command->add_option(
      "--against", arguments->against,
      "Run nothing: compare this table (.csv), of any program, with a benchmark");
  command->add_option("--columns", arguments->columns, "With --against, only these: --columns L,B")
      ->delimiter(',')
      ->needs(against);
  command->add_flag("--benchmarks", arguments->is_list, "List the benchmarks")
      ->excludes(directories)
      ->excludes(against);
  command->add_flag("--short", arguments->is_short, "Only the runs that take seconds");
  command->add_flag("--once", arguments->is_once, "Also the runs that take hours")
      ->excludes("--short");
  command->add_option("--run", arguments->runs, "Only the run of this name; may be repeated")
      ->type_name("NAME")
      ->allow_extra_args(false);
  CLI::Option* recorded = command->add_flag("--recorded", arguments->is_recorded,
                                            "Run nothing: compare the results kept with the cases");
  command->add_flag("--record", arguments->is_record, "Keep the results with the cases")
      ->excludes(recorded);
  command->add_flag("-q,--quiet", arguments->is_quiet, "Print nothing but the table and errors");
  command->footer(
      "A finished run of the same program and case is not made again, an unfinished one is taken\n"
      "up. Exit status 1 when a quantity is outside its tolerance.");
  for (const char* of_cases : {"--all", "--short", "--once", "--run", "--recorded", "--record"})
    against->excludes(command->get_option(of_cases));
  command->callback(
      [&action, arguments] { action = [arguments] { return check_command(*arguments); }; });
}

void add_study(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<StudyArguments>();
  CLI::App* command = app.add_subcommand(
      "study", "Run a case over values of its keys, or search for a critical value");
  command->add_option("study", arguments->study_file, "Study file (TOML)")->required();
  command->add_option("-o,--output", arguments->output,
                      "Folder for the results [the study file's name]");
  command->add_option("-j,--jobs", arguments->jobs, "Runs at a time [1; with --slurm: all]")
      ->check(CLI::Range(1, 1024));
  CLI::Option* slurm = command->add_flag("--slurm", arguments->is_slurm,
                                         "Hand the runs to Slurm, as job arrays, and wait");
  command->add_option("--ranks", arguments->ranks, "Processors of each run, by mpirun")
      ->capture_default_str()
      ->check(CLI::Range(1, 1024))
      ->needs(slurm);
  command->add_flag("--overwrite", arguments->is_overwrite,
                    "Replace runs of another case or version in that folder");
  command->add_flag("-q,--quiet", arguments->is_quiet, "Print nothing but errors");
  command->footer(
      "A finished run of the same program and case is not made again, an unfinished one is taken\n"
      "up. Exit status 1 when a run failed or the study was interrupted.");
  command->callback(
      [&action, arguments] { action = [arguments] { return study_command(*arguments); }; });
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

/// Commands without group are in no help: they write what packages hold.
void add_reference(CLI::App& app, Action& action) {
  const auto add = [&](const char* name, const char* description, auto text) {
    app.add_subcommand(name, description)->group("")->callback([&app, &action, text] {
      action = [&app, text] {
        fmt::print("{}", text(app));
        return 0;
      };
    });
  };
  add("manual", "Write the manual page, for man(1)", manual_page);
  add("completion", "Write the completion for bash", bash_completion);
}

int print_error(const std::string& text, int status) {
  std::fputs(fmt::format("meniscus: {}\n", text).c_str(), stderr);
  return status;
}

}  // namespace

int run_command_line(int argc, char** argv, const SetUp& set_up) {
  CLI::App app("Deforming liquid drops with a sharp, conforming interface", "meniscus");
  app.set_version_flag("--version", fmt::format("meniscus {} ({})", version_string, commit_string));
  app.require_subcommand(1);
  ignore_write_signals();
  Action action;
  add_run(app, action, set_up);
  for (const auto add : {add_resume, add_mesh, add_remesh, add_check, add_study, add_report,
                         add_compare, add_explain, add_examples, add_reference})
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
  } catch (const std::bad_alloc&) {  // memory that other programs take cannot be foreseen
    return print_error("not enough memory: fewer nodes or a coarser mesh take less", 1);
  } catch (const std::exception& error) {
    return print_error(error.what(), 1);
  }
}

}  // namespace meniscus
