#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "meniscus/app/commands.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/io/table.hpp"
#include "meniscus/surface/constants.hpp"
#include "tests/io/temporary_folder.hpp"

namespace meniscus {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Three steps of a drop of the fewest vertices, in an unbounded liquid.
constexpr const char* kCase =
    "title = \"Three steps\"\n[flow]\nkind = \"uniaxial-extension\"\n[[drop]]\nradius = 1.0\nnodes "
    "= 42\n"
    "[domain]\nshape = \"unbounded\"\n[solver]\nmethod = \"boundary-integral\"\n"
    "[time]\nend = 0.03\nmax-step = 0.01\n[output]\ncheckpoint-every = 1\n";

/// Runs the case in `folder`; further words are overrides.
fs::path run_in(const test::TemporaryFolder& folder, std::vector<std::string> overrides = {}) {
  test::put(folder / "case.toml", kCase);
  RunArguments arguments;
  arguments.case_file = (folder / "case.toml").string();
  arguments.output = (folder / "run").string();
  arguments.overrides = std::move(overrides);
  arguments.is_quiet = true;
  EXPECT_EQ(run_command(arguments), 0);
  return folder / "run";
}

Json record_of(const fs::path& run) { return Json::parse(test::get(run / "run.json")); }

TEST(RunCommand, RecordsWhatRanAndHowFarVolumesWerePutRight) {
  const test::TemporaryFolder folder;
  const fs::path run = run_in(folder);
  const Json record = record_of(run);
  EXPECT_EQ(record["status"], "done");
  EXPECT_EQ(record["title"], "Three steps");
  EXPECT_EQ(record["case_text"], kCase);
  EXPECT_EQ(record["constants"]["surface"]["most-mended-volume"], kMostMendedVolume);
  EXPECT_EQ(record["constants"]["topology"]["prominence"], 1.1);
  EXPECT_TRUE(record["warnings"].empty()) << record["warnings"];

  const io::Table drops = io::read_table(run / "drops.csv");
  const std::vector<double> steps = drops.column("step"),
                            shifts = drops.column("volume_correction");
  ASSERT_EQ(steps.size(), record["steps"].get<std::size_t>() + 1);
  double sum = 0.0;
  for (std::size_t i = 1; i < steps.size(); ++i) sum += shifts[i];
  EXPECT_GT(sum, 0.0);
  EXPECT_NEAR(record["volume_correction_sum"].get<double>(), sum, 1e-15);
}

// A cube of squares, two of them turned inside out.
TEST(RunCommand, RecordsWhatWasDoneToASurfaceAlsoWhenResumed) {
  const test::TemporaryFolder folder;
  test::put(folder / "cube.off",
            "OFF\n8 6 0\n-1 -1 -1\n1 -1 -1\n1 1 -1\n-1 1 -1\n-1 -1 1\n1 -1 1\n1 1 1\n-1 1 1\n"
            "4 0 3 2 1\n4 7 6 5 4\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n");
  std::string text = kCase;
  const std::string radius = "radius = 1.0";
  test::put(folder / "case.toml",
            text.replace(text.find(radius), radius.size(), "surface = \"cube.off\""));
  RunArguments arguments;
  arguments.case_file = (folder / "case.toml").string();
  arguments.output = (folder / "run").string();
  arguments.is_quiet = true;
  ASSERT_EQ(run_command(arguments), 0);
  const Json warnings = record_of(folder / "run")["warnings"];
  ASSERT_EQ(warnings.size(), 1U) << warnings;
  EXPECT_NE(warnings[0].get<std::string>().find("6 faces of more than three corners cut into "
                                                "triangles; 2 faces turned over"),
            std::string::npos)
      << warnings;
  ResumeArguments further;
  further.directory = (folder / "run").string();
  further.until = 0.04;
  further.is_quiet = true;
  ASSERT_EQ(resume_command(further), 0);
  EXPECT_EQ(record_of(folder / "run")["warnings"], warnings);
}

TEST(RunCommand, DescribesItsFilesAsAResearchCrate) {
  const test::TemporaryFolder folder;
  const fs::path run = run_in(folder);
  test::put(run / "notes.txt", "not of the run");
  const Json crate = Json::parse(test::get(run / "ro-crate-metadata.json"));
  EXPECT_EQ(crate["@context"], "https://w3id.org/ro/crate/1.1/context");
  std::map<std::string, Json> entities;
  for (const Json& entity : crate["@graph"]) entities[entity["@id"]] = entity;
  EXPECT_EQ(entities.at("ro-crate-metadata.json")["about"]["@id"], "./");
  EXPECT_EQ(entities.at("./")["name"], "Three steps");
  EXPECT_EQ(entities.at("./")["datePublished"], record_of(run)["finished"]);
  EXPECT_EQ(entities.at("#run")["startTime"], record_of(run)["started"]);
  EXPECT_EQ(entities.at("#run")["actionStatus"]["@id"], "http://schema.org/CompletedActionStatus");
  EXPECT_EQ(entities.at("#meniscus")["identifier"], record_of(run)["commit"]);
  std::set<std::string> listed;
  for (const Json& part : entities.at("./")["hasPart"]) {
    const std::string id = part["@id"];
    EXPECT_TRUE(fs::exists(run / id)) << id;
    EXPECT_TRUE(entities.contains(id)) << id;
    listed.insert(id.ends_with('/') ? id.substr(0, id.size() - 1) : id);
  }
  std::set<std::string> there;
  for (const auto& entry : fs::directory_iterator(run))
    if (entry.path().filename() != "notes.txt" &&
        entry.path().filename() != "ro-crate-metadata.json")
      there.insert(entry.path().filename().string());
  EXPECT_EQ(listed, there);
}

TEST(RunCommand, ResumeEndsWithTheRowsOfTheWholeRunAndAddsUpTimes) {
  const test::TemporaryFolder whole_folder, folder;
  const fs::path whole = run_in(whole_folder), run = run_in(folder, {"time.end=0.01"});
  const Json before = record_of(run);
  ResumeArguments arguments;
  arguments.directory = run.string();
  arguments.until = 0.03;
  arguments.is_quiet = true;
  EXPECT_EQ(resume_command(arguments), 0);
  for (const char* file : {"history.csv", "drops.csv", "events.csv"})
    EXPECT_EQ(test::get(run / file), test::get(whole / file)) << file;
  const Json after = record_of(run);
  EXPECT_EQ(after["started"], before["started"]);
  EXPECT_EQ(after["case_text"], kCase);
  EXPECT_EQ(after["volume_correction_sum"], record_of(whole)["volume_correction_sum"]);
  EXPECT_GT(after["wall_seconds"].get<double>(), before["wall_seconds"].get<double>());
  EXPECT_GE(after["seconds"]["solve"].get<double>(), before["seconds"]["solve"].get<double>());
}

TEST(RunCommand, ResumeRefusesAnEndThatLiesBeforeTheCheckpoint) {
  const test::TemporaryFolder folder;
  ResumeArguments arguments;
  arguments.directory = run_in(folder).string();
  arguments.until = 0.001;
  arguments.is_quiet = true;
  EXPECT_NE(test::message_of<InvalidInput>([&] {
              (void)resume_command(arguments);
            }).find("lies before the checkpoint's t"),
            std::string::npos);
}

TEST(RunCommand, ResumeTakesItsEndInTheCasesUnitOfTime) {
  const test::TemporaryFolder folder;
  RunArguments begin;
  begin.case_file = (folder / "si.toml").string();
  test::put(begin.case_file, R"(
[scale]
length = 1e-3
viscosity = 0.1
surface-tension = 0.025
[flow]
kind = "quiescent"
[[drop]]
axes = [1.2e-3, 0.95e-3, 0.95e-3]
nodes = 42
[domain]
shape = "unbounded"
[solver]
method = "boundary-integral"
[time]
end = 0.0005
max-step = 0.0001
)");
  begin.output = (folder / "run").string();
  begin.is_quiet = true;
  ASSERT_EQ(run_command(begin), 0);
  // μ_out R0/σ = 4 ms.
  const auto time_in_ms = [&] { return 4.0 * record_of(folder / "run")["t"].get<double>(); };
  EXPECT_GE(time_in_ms(), 0.5 - 1e-9);
  ResumeArguments further;
  further.directory = begin.output;
  further.is_quiet = true;
  further.until = 0.0001;
  const std::string line = test::message_of<InvalidInput>([&] { (void)resume_command(further); });
  EXPECT_NE(line.find("--until = 0.0001 s lies before the checkpoint's t = 0.000"),
            std::string::npos)
      << line;
  further.until = 0.001;
  EXPECT_EQ(resume_command(further), 0);
  EXPECT_GE(time_in_ms(), 1.0 - 1e-9);
  EXPECT_LT(time_in_ms(), 2.0);
}

TEST(RunCommand, AFolderThatHoldsARunIsKeptUnlessItMayBeReplaced) {
  const test::TemporaryFolder folder;
  const fs::path run = run_in(folder);
  const std::string before = test::get(run / "drops.csv");
  RunArguments arguments;
  arguments.case_file = (folder / "case.toml").string();
  arguments.output = run.string();
  arguments.overrides = {"time.end=0.01"};
  arguments.is_quiet = true;
  EXPECT_NE(test::message_of<InvalidInput>([&] {
              (void)run_command(arguments);
            }).find("holds a run already"),
            std::string::npos);
  EXPECT_EQ(test::get(run / "drops.csv"), before);
  arguments.is_overwrite = true;
  EXPECT_EQ(run_command(arguments), 0);
  EXPECT_LT(test::get(run / "drops.csv").size(), before.size());
}

}  // namespace
}  // namespace meniscus
