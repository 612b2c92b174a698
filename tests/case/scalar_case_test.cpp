// Bulk scalars of a case file: reading, and the scene made from them.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "meniscus/case/explain.hpp"
#include "meniscus/mesh/shapes.hpp"
#include "tests/case/case_files.hpp"

namespace meniscus {
namespace {

using Kind = ScalarCondition::Kind;

constexpr std::string_view kTwoDrops =
    "[flow]\nkind = \"quiescent\"\n"
    "[[drop]]\nradius = 1\n[drop.surfactant]\nelasticity = 0.2\n"
    "[[drop]]\nradius = 0.5\ncenter = [0, 0, 3]\n";
constexpr std::string_view kHeat = "[[scalar]]\nname = \"heat\"\npeclet = 10\n";
/// A temperature with all it can have, and a species that does not diffuse.
constexpr std::string_view kTwoScalars =
    "[[scalar]]\nname = \"heat\"\npeclet = 0.1\nconvection = false\nbrinkman = 0.3\n"
    "initial = 1.5\ninitial-gradient = [0.1, 0.2, 0.7]\nspot-height = 2\nspot-center = [0, 0, 4]\n"
    "spot-width = 0.6\nsource = 0.01\nreference = 0.9\ntension-slope = -0.11\n"
    "buoyancy = [0, 0, 3]\nviscosity-exponent = 0.07\n"
    "[[scalar.drop]]\n"
    "[[scalar.drop]]\nconductivity-ratio = 3\ndiffusivity-ratio = 1.5\ninitial = -1\n"
    "source = -0.02\n"
    "[[scalar.patch]]\nname = \"x-\"\ncondition = \"value\"\nvalue = 1.1\ngradient = [0, 0.1, 0]\n"
    "[[scalar.patch]]\nname = \"z+\"\ncondition = \"flux\"\nflux = 0.3\n"
    "[[scalar]]\nname = \"salt_2\"\nkind = \"species\"\npeclet = inf\n"
    "[[scalar.drop]]\npartition = 4\ndiffusivity-ratio = 0.5\ninitial = 8\n"
    "[[scalar.patch]]\nname = \"y+\"\ncondition = \"none\"\n";

Case read(std::string_view more, const std::vector<std::string>& overrides = {}) {
  return parse_case(std::string(kTwoDrops) + std::string(more), "case.toml", {}, overrides);
}

void expect_same(const ScalarCase& a, const ScalarCase& b) {
  EXPECT_EQ(a.path, b.path);
  EXPECT_EQ(a.scalar, b.scalar);
  EXPECT_EQ(a.liquids, b.liquids);
  ASSERT_EQ(a.patches.size(), b.patches.size());
  for (std::size_t i = 0; i < a.patches.size(); ++i) {
    EXPECT_EQ(a.patches[i].name, b.patches[i].name);
    EXPECT_EQ(a.patches[i].tags, b.patches[i].tags);
    EXPECT_EQ(a.patches[i].condition, b.patches[i].condition);
  }
}

TEST(ScalarCase, HasTheDocumentedDefaults) {
  EXPECT_TRUE(read("").scalars.empty());
  const Case c = read(kHeat);
  ASSERT_EQ(c.scalars.size(), 1u);
  Scalar expected;
  expected.name = "heat";
  expected.peclet = 10.0;
  EXPECT_EQ(c.scalars[0].scalar, expected);
  EXPECT_FALSE(c.scalars[0].scalar.acts_on_flow());
  EXPECT_EQ(c.scalars[0].liquids, std::vector<ScalarLiquid>(3));
  EXPECT_TRUE(c.scalars[0].patches.empty());
}

TEST(ScalarCase, ReadsEveryKeyOfAScalar) {
  const Case c = read(kTwoScalars);
  ASSERT_EQ(c.scalars.size(), 2u);
  const Scalar& heat = c.scalars[0].scalar;
  EXPECT_FALSE(heat.is_species);
  EXPECT_FALSE(heat.is_convected);
  EXPECT_EQ(heat.peclet, 0.1);
  EXPECT_EQ(heat.brinkman, 0.3);
  EXPECT_EQ(heat.reference, 0.9);
  EXPECT_EQ(heat.tension_slope, -0.11);
  EXPECT_EQ(heat.buoyancy, Vec3(0, 0, 3));
  EXPECT_EQ(heat.viscosity_exponent, 0.07);
  const Scalar& salt = c.scalars[1].scalar;
  EXPECT_EQ(salt.name, "salt_2");
  EXPECT_TRUE(salt.is_species);
  EXPECT_TRUE(salt.is_convected);
  EXPECT_TRUE(std::isinf(salt.peclet));
}

TEST(ScalarCase, ReadsWhatAScalarMeetsInLiquids) {
  const Case c = read(kTwoScalars);
  const std::vector<ScalarLiquid>&heat = c.scalars[0].liquids, &salt = c.scalars[1].liquids;
  ASSERT_EQ(heat.size(), 3u);
  const ScalarProfile profile{1.5, Vec3(0.1, 0.2, 0.7), 2.0, Vec3(0, 0, 4), 0.6};
  EXPECT_EQ(heat[0], (ScalarLiquid{1.0, 1.0, 0.01, profile}));
  EXPECT_EQ(heat[1], ScalarLiquid());
  EXPECT_EQ(heat[2].conductivity, 3.0);
  EXPECT_EQ(heat[2].capacity, 2.0);  // conductivity over diffusivity
  EXPECT_EQ(heat[2].source, -0.02);
  EXPECT_EQ(heat[2].initial.value, -1.0);
  ASSERT_EQ(salt.size(), 3u);
  EXPECT_EQ(salt[1].capacity, 4.0);
  EXPECT_EQ(salt[1].conductivity, 2.0);   // partition times diffusivity
  EXPECT_EQ(salt[1].initial.value, 8.0);  // the concentration
  EXPECT_EQ(salt[2], ScalarLiquid());
}

TEST(ScalarCase, SteadyConductionHasNeitherConvectionNorHistory) {
  const std::string patch = "[[scalar.patch]]\nname = \"x-\"\ncondition = \"value\"\n";
  const Case c = read(std::string(kHeat) + patch, {"scalar.peclet=0"});
  EXPECT_EQ(c.scalars[0].scalar.peclet, 0.0);
  EXPECT_FALSE(c.scalars[0].scalar.is_convected);
  // What the file says of the beginning loses its effect by the override.
  const Case set = read(std::string(kHeat) + "initial = 3\n" + patch, {"scalar.peclet=0"});
  EXPECT_EQ(set.scalars[0].liquids[0].initial, ScalarProfile());
}

TEST(ScalarCase, TomlWithDefaultsReadsBackToTheSameCase) {
  const Case first = read(kTwoScalars);
  const std::string text = case_toml(first);
  const Case second = parse_case(text, "again.toml");
  EXPECT_EQ(case_toml(second), text);
  EXPECT_EQ(case_json(second), case_json(first));
  ASSERT_EQ(second.scalars.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) expect_same(first.scalars[i], second.scalars[i]);
  EXPECT_EQ(first.drops[0].surfactant, second.drops[0].surfactant);
  EXPECT_FALSE(second.drops[1].surfactant);
}

TEST(ScalarCase, TomlHasEveryTableAfterTheOneItBelongsTo) {
  const std::string text = case_toml(read(kTwoScalars));
  std::vector<std::string> headers;
  for (std::size_t at = text.find("\n["); at != std::string::npos; at = text.find("\n[", at + 1)) {
    const std::string header = text.substr(at + 1, text.find('\n', at + 1) - at - 1);
    if (header.find("scalar") != std::string::npos || header.find("drop") != std::string::npos)
      headers.push_back(header);
  }
  EXPECT_EQ(headers, (std::vector<std::string>{"[[drop]]", "[drop.surfactant]", "[[drop]]",
                                               "[[scalar]]", "[[scalar.drop]]", "[[scalar.drop]]",
                                               "[[scalar.patch]]", "[[scalar.patch]]", "[[scalar]]",
                                               "[[scalar.drop]]", "[[scalar.patch]]"}));
}

TEST(ScalarCase, JsonIsNestedAsTheFile) {
  const nlohmann::json json = nlohmann::json::parse(case_json(read(kTwoScalars)));
  ASSERT_EQ(json["scalar"].size(), 2u);
  EXPECT_EQ(json["scalar"][0]["drop"][1]["conductivity-ratio"], 3.0);
  EXPECT_EQ(json["scalar"][0]["patch"][1]["flux"], 0.3);
  EXPECT_EQ(json["scalar"][1]["peclet"], "inf");
  EXPECT_EQ(json["scalar"][1]["drop"][0]["partition"], 4.0);
  EXPECT_EQ(json["drop"][0]["surfactant"]["elasticity"], 0.2);
}

TEST(ScalarCase, OverridesReachNestedTables) {
  const Case c = read(kTwoScalars, {"scalar[1].drop[0].partition=2", "scalar[1].peclet=7",
                                    "scalar[1].drop[1].partition=3"});
  EXPECT_EQ(c.scalars[1].scalar.peclet, 7.0);
  EXPECT_EQ(c.scalars[1].liquids[1].capacity, 2.0);
  EXPECT_EQ(c.scalars[1].liquids[2].capacity, 3.0);
  EXPECT_EQ(c.scalars[0].liquids[2].conductivity, 3.0);
  // A species that only overrides name, with a drop.
  const Case added = read("", {"scalar[0].drop[0].partition=2", "scalar[0].kind=species",
                               "scalar[0].name=salt", "scalar[0].peclet=1"});
  ASSERT_EQ(added.scalars.size(), 1u);
  EXPECT_EQ(added.scalars[0].liquids[1].capacity, 2.0);
}

TEST(ScalarCase, OverridesNeedNoIndexWhereThereIsOneTable) {
  const Case c = read(std::string(kHeat) + "[[scalar.drop]]\nsource = 1\n",
                      {"scalar.peclet=5", "scalar.drop.source=2", "scalar.drop[1].source=3",
                       "scalar[0].initial=4"});
  EXPECT_EQ(c.scalars[0].scalar.peclet, 5.0);
  EXPECT_EQ(c.scalars[0].liquids[1].source, 2.0);
  EXPECT_EQ(c.scalars[0].liquids[2].source, 3.0);
  EXPECT_EQ(c.scalars[0].liquids[0].initial.value, 4.0);
  const Case mixed = read(std::string(kHeat) + "[[scalar.drop]]\n", {"scalar[0].drop.source=2"});
  EXPECT_EQ(mixed.scalars[0].liquids[1].source, 2.0);
}

TEST(ScalarCase, KeysStayDimensionlessWithAScale) {
  const Case c = parse_case(
      "[flow]\nkind = \"quiescent\"\n[[drop]]\nradius = 1e-3\n[domain]\nhalf-width = 0.01\n"
      "[scale]\nlength = 1e-3\nviscosity = 2.0\nsurface-tension = 0.03\n" +
          std::string(kHeat) + "spot-height = 1\nspot-center = [0, 0, 2]\nspot-width = 0.5\n",
      "case.toml");
  EXPECT_EQ(c.scalars[0].liquids[0].initial.center, Vec3(0, 0, 2));
  EXPECT_EQ(c.scalars[0].liquids[0].initial.width, 0.5);
}

TEST(ScalarCase, ExplainNamesNestedTables) {
  EXPECT_EQ(explain("scalar[0].drop[1].partition"), explain("scalar.drop.partition"));
  EXPECT_TRUE(explain("scalar.drop").starts_with("[[scalar.drop]]\n"));
  EXPECT_NE(reference_page().find("## `[[scalar.patch]]`"), std::string::npos);
}

/// The scalars' conditions at the patch of a name.
std::vector<ScalarCondition> conditions_at(const Scene& scene, const std::string& name) {
  for (const Patch& patch : scene.boundary.patches)
    if (patch.name == name) return patch.scalars;
  ADD_FAILURE() << "no patch " << name;
  return {};
}

TEST(ScalarScene, HasScalarsLiquidsAndConditions) {
  const Case c = read(kTwoScalars);
  for (const Scene& scene : {build_scene(c), build_surroundings(c)}) {
    ASSERT_EQ(scene.scalars.size(), 2u);
    ASSERT_EQ(scene.liquids.size(), 3);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(scene.scalars[i], c.scalars[i].scalar);
      for (const RegionId r : scene.liquids.ids())
        EXPECT_EQ(scene.liquids[r].scalars.at(i),
                  c.scalars[i].liquids[static_cast<std::size_t>(r.value)]);
    }
    const ScalarCondition none, value{Kind::value, 1.1, Vec3(0, 0.1, 0), 0.0},
        flux{Kind::flux, 0.0, Vec3(0, 0, 0), 0.3};
    EXPECT_EQ(conditions_at(scene, "x-"), (std::vector{value, none}));
    EXPECT_EQ(conditions_at(scene, "z+"), (std::vector{flux, none}));
    EXPECT_EQ(conditions_at(scene, "y+"), (std::vector{none, none}));
    EXPECT_EQ(conditions_at(scene, "y-"), (std::vector{none, none}));
  }
  EXPECT_TRUE(build_scene(test::shear_case()).liquids[RegionId{1}].scalars.empty());
}

constexpr std::string_view kEnds =
    "[[scalar.patch]]\nname = \"ends\"\ncondition = \"value\"\nvalue = 2\n";

TEST(ScalarScene, ANameForSeveralPatchesSetsThemAll) {
  const Scene scene = build_scene(
      read("[domain]\nshape = \"cylinder\"\n" + std::string(kHeat) + std::string(kEnds)));
  EXPECT_EQ(conditions_at(scene, "x-").at(0).value, 2.0);
  EXPECT_EQ(conditions_at(scene, "x+").at(0).value, 2.0);
  EXPECT_EQ(conditions_at(scene, "side").at(0).kind, Kind::none);
}

TEST(ScalarScene, NeedsAValueWhereLiquidEnters) {
  const std::string base = std::string(test::kShear) + std::string(kHeat);
  const std::string at_x_minus = "[[scalar.patch]]\nname = \"x-\"\n";
  const std::string at_x_plus = "[[scalar.patch]]\nname = \"x+\"\ncondition = \"value\"\n";
  const std::string flux = at_x_minus + "condition = \"flux\"\n";
  const std::string value = at_x_minus + "condition = \"value\"\n";
  const std::string message =
      "case.toml:6: scalar \"heat\": patch \"x-\" needs a value: liquid enters there";
  EXPECT_EQ(test::message_of(base), message);
  EXPECT_EQ(test::message_of(base + flux + at_x_plus), message);
  EXPECT_EQ(test::message_of(base + value + at_x_plus), "no error");
  EXPECT_EQ(test::message_of(base + "convection = false\n"), "no error");
  EXPECT_EQ(test::message_of(base + flux + at_x_plus, {"scalar.peclet=0"}), "no error");
  EXPECT_EQ(test::message_of(base + "[domain]\nshape = \"sphere\"\n"),
            "case.toml:6: scalar \"heat\": patch \"all\" needs a value: liquid enters there");
}

TEST(ScalarScene, NoLiquidEntersAlongACurvedWall) {
  // The flat faces of the cylinder's side cross the flow, the cylinder does not.
  const std::string cylinder = "[domain]\nshape = \"cylinder\"\nhalf-length = 5\n";
  EXPECT_EQ(test::message_of(std::string(test::kShear) + std::string(kHeat) + std::string(kEnds) +
                             cylinder),
            "no error");
}

TEST(ScalarScene, TagsOfASurfaceAreThoseOfItsPatches) {
  const test::TemporaryFolder folder;
  const TaggedSurface die = cylinder(600, 3.0, 5.0);
  folder.write_stl("die.stl", die.mesh, die.tag);
  const std::string text =
      "[flow]\nkind = \"quiescent\"\n[[drop]]\nradius = 1\n[domain]\nsurface = \"die.stl\"\n"
      "[[domain.patch]]\ntag = 0\nname = \"wall\"\nvelocity = [0, 0, 0]\n"
      "[[domain.patch]]\ntag = 1\nname = \"inlet\"\nvelocity = [1, 0, 0]\n"
      "[[domain.patch]]\ntag = 2\nname = \"outlet\"\ncondition = \"open\"\n" +
      std::string(kHeat);  // on lines 19 to 21
  const auto patch = [](int tag) {
    return "[[scalar.patch]]\ntag = " + std::to_string(tag) + "\ncondition = \"value\"\n";
  };
  const auto message = [&](const std::string& more) {
    return test::message_of(text + more, {}, folder.path());
  };
  EXPECT_EQ(message(patch(0)),
            "case.toml:19: scalar \"heat\": patch \"inlet\" needs a value: liquid enters there");
  EXPECT_EQ(message(patch(7)),
            "case.toml:23: scalar.patch.tag = 7 is the tag of no [[domain.patch]]; their tags are "
            "0, 1, 2");
  EXPECT_EQ(message(patch(1) + patch(1)),
            "case.toml:26: scalar.patch.tag = 1 has a condition already, from the [[scalar.patch]] "
            "at case.toml:22");
  const Scene scene = build_scene(parse_case(text + patch(1), "case.toml", folder.path()));
  EXPECT_EQ(conditions_at(scene, "inlet").at(0).kind, Kind::value);
  EXPECT_EQ(conditions_at(scene, "wall").at(0).kind, Kind::none);
}

}  // namespace
}  // namespace meniscus
