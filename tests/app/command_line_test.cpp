#include "meniscus/app/command_line.hpp"

#include <fmt/format.h>
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

/// Whether a text holds a word as man(7) has it.
void expect_in_manual(const std::string& manual, const std::string& word) {
  std::string escaped;
  for (const char c : word) {
    if (c == '-') escaped += '\\';
    escaped += c;
  }
  EXPECT_NE(manual.find(escaped), std::string::npos) << word;
}

TEST(CommandLine, ManualAndCompletionHaveEveryCommandAndOptionOfTheHelp) {
  const std::string manual = ending_of({"manual"}).out, completion = ending_of({"completion"}).out;
  const std::string help = ending_of({"--help"}).out;
  EXPECT_EQ(help.find("completion"), std::string::npos);
  EXPECT_EQ(manual.rfind(".TH MENISCUS 1 ", 0), 0U);
  int options = 0;
  for (const char* command :
       {"run", "resume", "mesh", "remesh", "check", "report", "compare", "explain", "examples"}) {
    EXPECT_NE(help.find(command), std::string::npos);
    expect_in_manual(manual, fmt::format(".SS {}\n", command));
    EXPECT_NE(completion.find(fmt::format("    {}) options=", command)), std::string::npos);
    const std::string words = ending_of({command, "--help"}).out;
    for (std::size_t at = 0; (at = words.find(" --", at)) != std::string::npos; ++at) {
      const std::size_t end = words.find_first_of(" ,\n=", at + 1);
      const std::string option = words.substr(at + 1, end - at - 1);
      expect_in_manual(manual, option);
      EXPECT_NE(completion.find(option), std::string::npos) << option;
      ++options;
    }
  }
  EXPECT_GE(options, 40);
  for (const char* name : {"shear-subcritical", "uniaxial-extension", "drop.viscosity-ratio"})
    EXPECT_NE(completion.find(name), std::string::npos) << name;
}

TEST(CommandLine, RefusesFilesThatAreNotThere) {
  const test::TemporaryFolder folder;
  const std::string missing = (folder / "missing").string();
  expect_refusal({"run", missing + ".toml"}, missing);
  expect_refusal({"resume", missing}, missing + " is not the folder of a run");
  expect_refusal({"resume", folder.path().string()}, "holds no checkpoint");
  expect_refusal({"report", missing}, missing);
  expect_refusal({"check", missing}, "it holds no check.toml");
  expect_refusal({"check", "nowhere", "--cases", missing},
                 fmt::format("neither it nor {}/nowhere holds a check.toml", missing));
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
