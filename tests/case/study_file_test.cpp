#include "meniscus/case/study_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"
#include "tests/io/temporary_folder.hpp"

namespace meniscus {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kCase =
    "[flow]\nkind = \"simple-shear\"\n[[drop]]\nradius = 1\n"
    "[time.stop-when]\nsteady-rate = 1e-3\nbroken = true\n";
const std::string kHead = "[study]\ncase = \"case.toml\"\n";

class StudyFileTest : public testing::Test {
 protected:
  StudyFileTest() { test::put(folder_ / "case.toml", kCase); }

  StudyFile read(const std::string& text) {
    test::put(folder_ / "study.toml", text);
    StudyFile study = read_study_file(folder_ / "study.toml");
    require_valid_cases(study);
    return study;
  }
  /// The refusal, without the folder in front.
  std::string refusal(const std::string& text) {
    const std::string said = test::message_of<InvalidInput>([&] { (void)read(text); });
    const std::size_t name = said.find("study.toml");
    return name == std::string::npos ? said : said.substr(name);
  }

  test::TemporaryFolder folder_;
};

TEST_F(StudyFileTest, AxesAreListsAndRanges) {
  const StudyFile study = read(kHead + R"(set = ["drop.nodes=80"]
[[axis]]
key = "flow.kind"
values = ["simple-shear", "planar-extension"]
[[axis]]
key = "flow.capillary-number"
from = 0.1
to = 0.3
count = 3
[[axis]]
key = "drop.viscosity-ratio"
from = 0.01
to = 10
count = 4
spacing = "log"
)");
  ASSERT_EQ(study.axes.size(), 3U);
  EXPECT_THAT(study.axes[0].values, ElementsAre("\"simple-shear\"", "\"planar-extension\""));
  EXPECT_THAT(study.axes[1].values, ElementsAre("0.1", "0.2", "0.3"));
  EXPECT_THAT(study.axes[2].values, ElementsAre("0.01", "0.1", "1", "10"));
  EXPECT_TRUE(study.axes[2].is_logarithmic);
}

TEST_F(StudyFileTest, PointsAreTheFullProductTheLastAxisFastest) {
  const StudyFile study = read(kHead + R"(set = ["drop.nodes=80"]
[[axis]]
key = "flow.capillary-number"
values = [0.1, 0.2]
[[axis]]
key = "drop.viscosity-ratio"
values = [1, 2, 3]
)");
  const std::vector<StudyPoint> points = points_of(study);
  ASSERT_EQ(points.size(), 6U);
  EXPECT_THAT(points[0], ElementsAre("0.1", "1"));
  EXPECT_THAT(points[1], ElementsAre("0.1", "2"));
  EXPECT_THAT(points[5], ElementsAre("0.2", "3"));
  EXPECT_THAT(overrides_at(study, points[1]),
              ElementsAre("drop.nodes=80", "flow.capillary-number=0.1", "drop.viscosity-ratio=2"));
  const Case c = case_at(study, points[5]);
  EXPECT_EQ(c.Ca, 0.2);
  EXPECT_EQ(c.drops[0].viscosity_ratio, 3.0);
  EXPECT_EQ(c.drops[0].nodes, 80);
}

TEST_F(StudyFileTest, AValueMayBeAVector) {
  const StudyFile study =
      read(kHead + "[[axis]]\nkey = \"drop.center\"\nvalues = [[0, 0, 0], [0, 0.5, 0]]\n");
  EXPECT_EQ(case_at(study, points_of(study)[1]).drops[0].center, Vec3(0, 0.5, 0));
}

TEST_F(StudyFileTest, ABisectionHasDefaults) {
  const StudyFile study =
      read(kHead + "[bisection]\nkey = \"flow.capillary-number\"\nfrom = 0.1\nto = 0.5\n");
  ASSERT_TRUE(study.bisection);
  EXPECT_EQ(study.bisection->from, 0.1);
  EXPECT_EQ(study.bisection->tolerance, 0.005);
  EXPECT_EQ(study.bisection->prolongations, 2);
  EXPECT_EQ(points_of(study).size(), 1U);
  EXPECT_EQ(case_at(study, {}, 0.25).Ca, 0.25);
}

TEST_F(StudyFileTest, NamesTheLineAndTheKeyOfAFault) {
  const std::string axis = kHead + "[[axis]]\nkey = \"flow.capillary-number\"\n";
  EXPECT_THAT(refusal(""), HasSubstr("[study] is missing"));
  EXPECT_THAT(refusal("[study]\n"), HasSubstr(":1: case: is missing"));
  EXPECT_THAT(refusal("[study]\ncase = \"other.toml\"\n[[axis]]\nkey = \"title\"\nvalues = [1]\n"),
              HasSubstr(":2: case = \"other.toml\": there is no file"));
  EXPECT_THAT(refusal("[study]\ncas = \"case.toml\"\n"),
              HasSubstr(":2: cas: not a key here; did you mean \"case\"?"));
  EXPECT_THAT(refusal(kHead), HasSubstr("nothing is varied"));
  EXPECT_THAT(refusal(axis), HasSubstr(":3: an axis needs values"));
  EXPECT_THAT(refusal(axis + "values = []\n"), HasSubstr(":5: values: is empty"));
  EXPECT_THAT(refusal(axis + "values = [1, 2, 1]\n"), HasSubstr("1 is there twice"));
  EXPECT_THAT(refusal(axis + "values = [1]\ncount = 3\n"),
              HasSubstr(":6: count: has no effect beside values"));
  EXPECT_THAT(refusal(axis + "from = 1\nto = 2\n"), HasSubstr("count: is missing"));
  EXPECT_THAT(refusal(axis + "from = 1\nto = 2\ncount = 1\n"), HasSubstr("count = 1: must be"));
  EXPECT_THAT(refusal(axis + "from = -1\nto = 2\ncount = 3\nspacing = \"log\"\n"),
              HasSubstr("must have one sign"));
  EXPECT_THAT(refusal(axis + "from = 1\nto = 2\ncount = 3\nspacing = \"cubic\"\n"),
              HasSubstr("allowed are linear, log"));
  EXPECT_THAT(refusal(axis + "values = [1]\n" + axis.substr(kHead.size()) + "values = [2]\n"),
              HasSubstr(":7: key = \"flow.capillary-number\": has an axis already"));
}

TEST_F(StudyFileTest, AFaultOfTheCaseNamesTheAxis) {
  EXPECT_THAT(
      refusal(kHead + "[[axis]]\nkey = \"flow.capilary-number\"\nvalues = [0.1]\n"),
      HasSubstr("study.toml:4: flow.capilary-number=0.1: flow.capilary-number: unknown key; "
                "did you mean \"flow.capillary-number\"?"));
  EXPECT_THAT(refusal(kHead + "[[axis]]\nkey = \"drop.nodes\"\nvalues = [80, -1]\n"),
              HasSubstr("study.toml:4: drop.nodes=-1"));
  EXPECT_THAT(refusal("[study]\ncase = \"case.toml\"\nset = [\"drop.node=80\"]\n"
                      "[[axis]]\nkey = \"drop.nodes\"\nvalues = [80]\n"),
              HasSubstr("study.toml: set: drop.node=80: "));
}

TEST_F(StudyFileTest, ABisectionNeedsTwoEndsAndRulesToJudgeBy) {
  const std::string head = kHead + "[bisection]\nkey = \"flow.capillary-number\"\n";
  EXPECT_THAT(refusal(head + "from = 0.1\nto = 0.1\n"), HasSubstr("from and to are both 0.1"));
  EXPECT_THAT(refusal(head + "from = 0.1\n"), HasSubstr("to: is missing"));
  EXPECT_THAT(refusal(head + "from = 0.1\nto = 0.2\ntolerance = 0\n"),
              HasSubstr("tolerance = 0: must be between"));
  EXPECT_THAT(refusal(head + "from = 0\nto = 0.2\nspacing = \"log\"\n"),
              HasSubstr("must have one sign"));
  test::put(folder_ / "case.toml", "[flow]\nkind = \"simple-shear\"\n[[drop]]\nradius = 1\n");
  EXPECT_THAT(refusal(head + "from = 0.1\nto = 0.2\n"),
              HasSubstr(":4: a bisection needs time.stop-when.steady-rate"));
}

}  // namespace
}  // namespace meniscus
