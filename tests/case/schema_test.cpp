#include "meniscus/case/schema.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "meniscus/case/examples.hpp"
#include "meniscus/case/explain.hpp"
#include "meniscus/case/nearest_word.hpp"
#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

using schema::Key;

TEST(Schema, EveryKeyIsWhole) {
  std::set<std::string_view> paths;
  for (const Key& key : schema::keys()) {
    SCOPED_TRACE(key.path);
    EXPECT_TRUE(paths.insert(key.path).second) << "twice in the table";
    EXPECT_NE(schema::find_table(schema::parent_path(key.path)), nullptr);
    EXPECT_FALSE(key.sentence.empty());
    EXPECT_EQ(key.sentence.back(), '.');
    EXPECT_EQ(key.type == schema::Type::word,
              !key.words.empty() && key.type != schema::Type::velocity);
    EXPECT_TRUE(key.value.has_value() != !key.default_note.empty())
        << "either a default or a note on it";
  }
}

TEST(Schema, EveryDefaultIsAllowed) {
  for (const Key& key : schema::keys())
    if (key.value) {
      EXPECT_NO_THROW(schema::check_value(key, *key.value, "default", key.path)) << key.path;
    }
}

TEST(Schema, RangesSayWhatTheyAllow) {
  EXPECT_EQ(schema::range_text({.min = 0.0, .open_min = true, .infinity = true}), "> 0 or inf");
  EXPECT_EQ(schema::range_text({.min = 1.0}), "at least 1");
  EXPECT_EQ(schema::range_text({.min = 0, .max = 1, .open_min = true, .open_max = true}),
            "between 0 and 1, both excluded");
  EXPECT_TRUE(schema::is_within({.min = 0.0}, 0.0));
  EXPECT_FALSE(schema::is_within({.min = 0.0, .open_min = true}, 0.0));
  EXPECT_FALSE(schema::is_within({}, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(schema::is_within({}, std::numeric_limits<double>::infinity()));
  EXPECT_TRUE(schema::is_within({.infinity = true}, std::numeric_limits<double>::infinity()));
}

TEST(Schema, PathsLoseTheirIndices) {
  EXPECT_EQ(schema::generic_path("drop[12].nodes"), "drop[].nodes");
  EXPECT_EQ(schema::without_indices("flow.schedule[2].time"), "flow.schedule.time");
  EXPECT_EQ(schema::parent_path("flow.schedule[].time"), "flow.schedule[]");
  EXPECT_EQ(schema::leaf("title"), "title");
}

TEST(Schema, RealsReadBackToTheSameBits) {
  for (const double value : {0.1, 1.0 / 3.0, 1e300, -5e-324, 2.0}) {
    const std::string text = schema::to_toml(value);
    EXPECT_EQ(std::strtod(text.c_str(), nullptr), value) << text;
  }
  EXPECT_EQ(schema::to_toml(2.0), "2.0");
  EXPECT_EQ(schema::to_toml(std::string("a\"b\\c\nd")), "\"a\\\"b\\\\c\\u000ad\"");
}

TEST(NearestWord, CountsEditsAndKnowsWhenNothingIsNear) {
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("edn", "end"), 1u);  // a swap
  const std::vector<std::string_view> words{"viscosity-ratio", "tension-ratio", "nodes"};
  EXPECT_EQ(nearest_word("viscocity-ratio", words), "viscosity-ratio");
  EXPECT_EQ(nearest_word("node", words), "nodes");
  EXPECT_EQ(nearest_word("xyzzy", words), "");
}

TEST(Explain, CoversEveryKey) {
  for (const Key& key : schema::keys()) {
    const std::string text = explain(key.path);
    EXPECT_NE(text.find(key.sentence), std::string::npos) << key.path;
    EXPECT_NE(text.find("default: "), std::string::npos) << key.path;
    if (key.type == schema::Type::word) {
      for (const std::string_view word : key.words)
        EXPECT_NE(text.find(word), std::string::npos) << key.path << " " << word;
    }
    EXPECT_NE(explain().find(key.sentence), std::string::npos) << key.path;
    EXPECT_NE(reference_page().find(key.sentence), std::string::npos) << key.path;
  }
}

TEST(Explain, TakesIndicesBareNamesAndTables) {
  EXPECT_EQ(explain("drop[3].nodes"), explain("drop.nodes"));
  EXPECT_NE(explain("nodes").find("domain.nodes"), std::string::npos);
  EXPECT_NE(explain("nodes").find("drop.nodes"), std::string::npos);
  EXPECT_NE(explain("time").find("time.step-factor"), std::string::npos);
  EXPECT_EQ(
      explain("drop.viscosity-ratio"),
      "drop.viscosity-ratio\n"
      "  lambda: viscosity over the matrix's; shear-dependent: at rest (carreau-yasuda), at the "
      "rate G (power-law).\n"
      "  value:   a number, > 0\n"
      "  default: 1.0\n");
}

TEST(Explain, UnknownKeysAreSuggested) {
  try {
    (void)explain("drop.node");
    FAIL() << "accepted";
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(), "explain: drop.node: unknown key; did you mean \"drop.nodes\"?");
  }
}

TEST(Explain, WhatResemblesNothingIsSentToTheList) {
  try {
    (void)explain("xyzzy");
    FAIL() << "accepted";
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(), "explain: xyzzy: unknown key; `meniscus explain` lists all keys");
  }
  EXPECT_NE(explain().find("--set 'title=Two drops'"), std::string::npos);
}

TEST(ReferencePage, InDocsIsThatOfTheSchema) {
  const std::filesystem::path page = std::filesystem::path(MENISCUS_DOCS) / "case-file.md";
  if (std::getenv("MENISCUS_UPDATE_DOCS") != nullptr) std::ofstream(page) << reference_page();
  std::ifstream stream(page);
  std::ostringstream text;
  text << stream.rdbuf();
  EXPECT_TRUE(text.str() == reference_page())
      << "docs/case-file.md is not what the schema says; regenerate it with\n"
         "  MENISCUS_UPDATE_DOCS=1 case_tests --gtest_filter='ReferencePage.*'";
}

TEST(Documentation, IndexNamesEveryPage) {
  const std::filesystem::path docs = MENISCUS_DOCS;
  std::ifstream stream(docs / "README.md");
  std::ostringstream index;
  index << stream.rdbuf();
  for (const auto& entry : std::filesystem::directory_iterator(docs)) {
    const std::string page = entry.path().filename().string();
    if (entry.path().extension() != ".md" || page == "README.md") continue;
    EXPECT_NE(index.str().find("(" + page + ")"), std::string::npos) << page;
  }
}

TEST(Examples, AreFoundByNameOrSuggested) {
  EXPECT_GE(examples().size(), 7u);
  EXPECT_NE(example("shear-subcritical").text.find("simple-shear"), std::string_view::npos);
  try {
    (void)example("shear-subcritcal");
    FAIL() << "accepted";
  } catch (const InvalidInput& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("did you mean \"shear-subcritical\"?"), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace meniscus
