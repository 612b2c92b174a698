#include "meniscus/app/command_line.hpp"

#include <gtest/gtest.h>

#include "tests/io/temporary_folder.hpp"

namespace meniscus {
namespace {

/// How the program ended, and what it printed.
struct Ending {
  int status = 0;
  std::string out, err;
};

Ending ending_of(std::vector<std::string> words) {
  words.insert(words.begin(), "meniscus");
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  Ending ending;
  ending.status = run_command_line(static_cast<int>(pointers.size()), pointers.data());
  ending.out = testing::internal::GetCapturedStdout();
  ending.err = testing::internal::GetCapturedStderr();
  return ending;
}

/// One line that begins with the program's name, and holds `part`.
void expect_refusal(const std::vector<std::string>& words, const std::string& part) {
  const Ending ending = ending_of(words);
  EXPECT_EQ(ending.status, 2) << part;
  EXPECT_EQ(ending.err.rfind("meniscus: ", 0), 0U) << ending.err;
  EXPECT_EQ(ending.err.find('\n'), ending.err.size() - 1) << ending.err;
  EXPECT_NE(ending.err.find(part), std::string::npos) << ending.err;
  EXPECT_EQ(ending.out, "");
}

TEST(CommandLine, RefusesWhatItDoesNotKnowInOneLine) {
  expect_refusal({}, "subcommand is required");
  expect_refusal({"simulate"}, "see meniscus --help");
  expect_refusal({"run", "case.toml", "--fast"}, "--fast");
  expect_refusal({"run", "case.toml", "--port", "70000", "--watch"}, "70000");
  expect_refusal({"run", "case.toml", "--port", "80"}, "--watch");
  expect_refusal({"remesh", "a.stl", "--nodes", "100", "--edge-length", "0.1"}, "--nodes");
  expect_refusal({"resume", "folder", "--from", "a.h5"}, "--output");
  expect_refusal({"compare", "one"}, "directories");
  expect_refusal({"study", "study.toml", "--jobs", "0"}, "--jobs");
}

TEST(CommandLine, RefusesFilesThatAreNotThere) {
  const test::TemporaryFolder folder;
  const std::string missing = (folder / "missing").string();
  expect_refusal({"run", missing + ".toml"}, missing);
  expect_refusal({"resume", missing}, missing + " is not the folder of a run");
  expect_refusal({"resume", folder.path().string()}, "holds no checkpoint");
  expect_refusal({"report", missing}, missing);
  expect_refusal({"check", missing}, "it holds no check.toml");
  expect_refusal({"study", missing + ".toml"}, missing);
  expect_refusal({"check", "--all", "--cases", missing}, "no folder here holds a check.toml");
}

TEST(CommandLine, ExplainsKeysAndNamesTheNearestOne) {
  const Ending known = ending_of({"explain", "time.end"});
  EXPECT_EQ(known.status, 0);
  EXPECT_NE(known.out.find("time.end"), std::string::npos);
  EXPECT_NE(known.out.find("default: 10"), std::string::npos) << known.out;
  expect_refusal({"explain", "time.ent"}, "did you mean \"time.end\"?");
  EXPECT_EQ(ending_of({"--version"}).status, 0);
}

}  // namespace
}  // namespace meniscus
