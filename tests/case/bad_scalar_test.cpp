// Every mistake about a bulk scalar gives one line with place, key, value and what is allowed.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/case/case_files.hpp"

namespace meniscus {
namespace {

using test::message_of;

struct BadScalar {
  std::string title;
  std::string text;
  std::string message;  ///< complete
  std::vector<std::string> overrides = {};
};

/// Lines 1 to 4, then a [[scalar]] on line 5 with what follows from line 6 on.
std::string scalar(const std::string& lines) {
  return "[flow]\nkind = \"quiescent\"\n[[drop]]\nradius = 1\n[[scalar]]\n" + lines;
}
/// A scalar on lines 5 to 7; what follows begins on line 8.
std::string heat(const std::string& lines = "") {
  return scalar("name = \"heat\"\npeclet = 10\n" + lines);
}
std::string steady(const std::string& lines = "") {
  return scalar("name = \"heat\"\npeclet = 0\n" + lines);
}

const std::vector<BadScalar> kScalars{
    {"no name", scalar("peclet = 1\n"), "case.toml:5: scalar.name is missing"},
    {"no Péclet number", scalar("name = \"heat\"\n"), "case.toml:5: scalar.peclet is missing"},
    {"an empty name", scalar("name = \"\"\npeclet = 1\n"),
     "case.toml:6: scalar.name = \"\" must be a letter, then letters, digits and _"},
    {"a name that begins with a digit", scalar("name = \"2nd\"\npeclet = 1\n"),
     "case.toml:6: scalar.name = \"2nd\" must be a letter, then letters, digits and _"},
    {"a name with a blank", scalar("name = \"the heat\"\npeclet = 1\n"),
     "case.toml:6: scalar.name = \"the heat\" must be a letter, then letters, digits and _"},
    {"a name of frames", scalar("name = \"velocity\"\npeclet = 1\n"),
     "case.toml:6: scalar.name = \"velocity\" must be another name: frames and tables use it "
     "already"},
    {"a name of tables", scalar("name = \"L\"\npeclet = 1\n"),
     "case.toml:6: scalar.name = \"L\" must be another name: frames and tables use it already"},
    {"a name twice", heat("[[scalar]]\nname = \"heat\"\npeclet = 1\n"),
     "case.toml:9: scalar.name = \"heat\" must be another name: the [[scalar]] at case.toml:5 has "
     "it"},
    {"a negative Péclet number", scalar("name = \"heat\"\npeclet = -1\n"),
     "case.toml:7: scalar.peclet = -1.0 must be at least 0 or inf"},
    {"an unknown kind", heat("kind = \"salt\"\n"),
     "case.toml:8: scalar.kind = \"salt\" must be one of \"heat\", \"species\""},
    {"a negative concentration", heat("kind = \"species\"\ninitial = -1\n"),
     "case.toml:9: scalar.initial = -1.0 must be at least 0: it is a concentration"},
    {"a spot of negative concentration",
     heat("kind = \"species\"\ninitial = 1\nspot-height = -2\nspot-width = 0.5\n"),
     "case.toml:10: scalar.spot-height = -2.0 must be at least −initial = -1: the sum is a "
     "concentration"},
    {"a negative concentration on a patch",
     heat("kind = \"species\"\n[[scalar.patch]]\nname = \"x-\"\ncondition = \"value\"\nvalue = "
          "-1\n"),
     "case.toml:12: scalar.patch.value = -1.0 must be at least 0: it is a concentration"},
    {"a gradient to negative concentrations",
     heat("kind = \"species\"\ninitial = 1\ninitial-gradient = [0, 0, 0.2]\n"),
     "case.toml:10: scalar.initial-gradient = [0.0, 0.0, 0.2] makes a concentration of -1 at "
     "(-10, -10, -10): it must be at least 0"},
    {"a gradient to negative concentrations in a drop",
     heat("kind = \"species\"\n[[scalar.drop]]\ninitial = 1\ninitial-gradient = [0, 0, 2]\n"),
     "case.toml:11: scalar.drop.initial-gradient = [0.0, 0.0, 2.0] makes a concentration of "
     "-0.9725 at (-0.00579921, 0.165787, -0.986253): it must be at least 0"},
    {"a gradient to negative concentrations on a patch",
     heat("kind = \"species\"\n[[scalar.patch]]\nname = \"x-\"\ncondition = \"value\"\nvalue = "
          "1\ngradient = [0, 0.2, 0]\n"),
     "case.toml:13: scalar.patch.gradient = [0.0, 0.2, 0.0] makes a concentration of -1 at "
     "(-10, -10, -10): it must be at least 0"},
    {"a surfactant dissolved in heat",
     heat("[drop.surfactant]\nelasticity = 0.1\nspecies = \"heat\"\n"),
     "case.toml:10: drop.surfactant.species = \"heat\" must be the name of a [[scalar]] with kind "
     "= "
     "\"species\""},
    {"a soluble surfactant without kinetics",
     heat("kind = \"species\"\n[drop.surfactant]\nelasticity = 0.1\nspecies = \"heat\"\n"),
     "case.toml:9: drop.surfactant.biot is missing"},
    {"a frame that moves with the drops", heat("[domain]\nframe = \"drops\"\n"),
     "case.toml:9: domain.frame = \"drops\" must be \"fixed\" with a [[scalar]]: what is carried "
     "would not follow"},
    {"negative heating", heat("brinkman = -1\n"),
     "case.toml:8: scalar.brinkman = -1.0 must be at least 0"},
    {"heating of a species", heat("kind = \"species\"\nbrinkman = 1\n"),
     "case.toml:9: scalar.brinkman has no effect here: it applies with kind = \"heat\""},
    {"a spot without height", heat("spot-width = 1\n"),
     "case.toml:8: scalar.spot-width has no effect here: it applies with peclet > 0 and a "
     "spot-height"},
    {"a spot without width", heat("spot-height = 1\nspot-width = 0\n"),
     "case.toml:9: scalar.spot-width = 0.0 must be > 0"},
    {"a value that is not finite", heat("initial = inf\n"),
     "case.toml:8: scalar.initial = inf must be finite"},
    {"a source of steady conduction", steady("source = 1\n"),
     "case.toml:8: scalar.source = 1.0 must be 0 with peclet = 0, where a source has no effect"},
    {"steady conduction of unknown level", steady(),
     "case.toml:7: scalar.peclet = 0.0 needs a [[scalar.patch]] with condition = \"value\": its "
     "level would be unknown"},
    {"the beginning of steady conduction",
     steady("initial = 1\n[[scalar.patch]]\nname = \"x-\"\ncondition = \"value\"\n"),
     "case.toml:8: scalar.initial has no effect here: it applies with peclet > 0"},
    {"a form that knows no gradient of tension",
     heat("tension-slope = -0.1\n[interface]\nsurface-tension = \"balanced\"\n"),
     "case.toml:10: interface.surface-tension = \"balanced\" must be \"weak\" where a scalar has a "
     "tension-slope: the other forms know no gradient of tension"},
    {"boundary integrals",
     heat("[domain]\nshape = \"unbounded\"\n[solver]\nmethod = \"boundary-integral\"\n"),
     "case.toml:5: [[scalar]] needs method = \"finite-element\""},
};

const std::vector<BadScalar> kDrops{
    {"more tables than drops", heat("[[scalar.drop]]\n[[scalar.drop]]\n"),
     "case.toml:9: scalar.drop: there are 2 tables and 1 [[drop]]; give at most one for each"},
    {"no conductivity", heat("[[scalar.drop]]\nconductivity-ratio = 0\n"),
     "case.toml:9: scalar.drop.conductivity-ratio = 0.0 must be > 0"},
    {"a partition of heat", heat("[[scalar.drop]]\npartition = 2\n"),
     "case.toml:9: scalar.drop.partition has no effect here: it applies with kind = \"species\""},
    {"a conductivity of a species",
     heat("kind = \"species\"\n[[scalar.drop]]\nconductivity-ratio = 2\n"),
     "case.toml:10: scalar.drop.conductivity-ratio has no effect here: it applies with kind = "
     "\"heat\""},
    {"a source of steady conduction", steady("[[scalar.drop]]\nsource = 1\n"),
     "case.toml:9: scalar.drop.source = 1.0 must be 0 with peclet = 0, where a source has no "
     "effect"},
    {"a misspelt key", heat("[[scalar.drop]]\npartiton = 2\n"),
     "case.toml:9: scalar.drop.partiton: unknown key; did you mean \"partition\"?"},
    {"a key of another table", heat("partition = 2\n"),
     "case.toml:8: scalar.partition: unknown key; did you mean \"scalar.drop.partition\"?"},
    {"a table for an array of tables", heat("[scalar.drop]\nsource = 1\n"),
     "case.toml:8: scalar.drop must be an array of tables: [[scalar.drop]]"},
};

const std::vector<BadScalar> kPatches{
    {"no condition", heat("[[scalar.patch]]\nname = \"x-\"\n"),
     "case.toml:8: scalar.patch.condition is missing"},
    {"no name", heat("[[scalar.patch]]\ncondition = \"value\"\n"),
     "case.toml:8: scalar.patch.name is missing"},
    {"an unknown condition", heat("[[scalar.patch]]\nname = \"x-\"\ncondition = \"fluxes\"\n"),
     "case.toml:10: scalar.patch.condition = \"fluxes\" must be one of \"none\", \"value\", "
     "\"flux\"; did you mean \"flux\"?"},
    {"an unknown patch", heat("[[scalar.patch]]\nname = \"top\"\ncondition = \"none\"\n"),
     "case.toml:9: scalar.patch.name = \"top\" is not a patch of the box; its patches are \"x-\", "
     "\"x+\", \"y-\", \"y+\", \"z-\", \"z+\""},
    {"a patch twice",
     heat("[[scalar.patch]]\nname = \"x-\"\ncondition = \"none\"\n"
          "[[scalar.patch]]\nname = \"x-\"\ncondition = \"value\"\n"),
     "case.toml:12: scalar.patch.name = \"x-\" has a condition already, from the [[scalar.patch]] "
     "at case.toml:8"},
    {"a patch within two names",
     heat("[[scalar.patch]]\nname = \"ends\"\ncondition = \"none\"\n"
          "[[scalar.patch]]\nname = \"x-\"\ncondition = \"value\"\n"
          "[domain]\nshape = \"cylinder\"\n"),
     "case.toml:12: scalar.patch.name = \"x-\" has a condition already, from the [[scalar.patch]] "
     "at case.toml:8"},
    {"a flux where the value is given",
     heat("[[scalar.patch]]\nname = \"x-\"\ncondition = \"value\"\nflux = 1\n"),
     "case.toml:11: scalar.patch.flux has no effect here: it applies with condition = \"flux\""},
    {"a value where nothing passes",
     heat("[[scalar.patch]]\nname = \"x-\"\ncondition = \"none\"\nvalue = 1\n"),
     "case.toml:11: scalar.patch.value has no effect here: it applies with condition = \"value\""},
    {"a tag of a box", heat("[[scalar.patch]]\nname = \"x-\"\ncondition = \"none\"\ntag = 1\n"),
     "case.toml:11: scalar.patch.tag has no effect here: it applies with domain.surface"},
};

const std::vector<BadScalar> kOverrides{
    {"no scalar",
     std::string(test::kShear),
     "--set scalar.peclet=5: scalar.peclet: there are 0 [[scalar]]; say which by an index, as in "
     "scalar[0].peclet",
     {"scalar.peclet=5"}},
    {"no table of a drop",
     heat(),
     "--set scalar.drop.source=1: scalar.drop.source: there are 0 [[scalar.drop]]; say which by an "
     "index, as in scalar[0].drop[0].source",
     {"scalar.drop.source=1"}},
    {"an index out of range",
     heat(),
     "--set scalar[0].drop[3].source=1: scalar[0].drop[3] does not exist; the next to add is "
     "scalar[0].drop[0]",
     {"scalar[0].drop[3].source=1"}},
    {"a table without a drop",
     heat("[[scalar.drop]]\n"),
     "--set scalar.drop[1].source=1: scalar.drop: there are 2 tables and 1 [[drop]]; give at most "
     "one for each",
     {"scalar.drop[1].source=1"}},
    {"a misspelt key of a numbered drop",
     heat("[[scalar.drop]]\n"),
     "--set scalar[0].drop[0].partiton=2: scalar[0].drop[0].partiton: unknown key; did you mean "
     "\"scalar[0].drop[0].partition\"?",
     {"scalar[0].drop[0].partiton=2"}},
    {"a misspelt key of the only scalar",
     heat(),
     "--set scalar.drop[0].partiton=2: scalar.drop[0].partiton: unknown key; did you mean "
     "\"scalar.drop[0].partition\"?",
     {"scalar.drop[0].partiton=2"}},
    {"a table within a table",
     heat(),
     "--set scalar.drop[0]={source=1}: scalar.drop[0] is a table; set its keys one by one, as in "
     "--set flow.kind=quiescent",
     {"scalar.drop[0]={source=1}"}},
};

void expect_messages(const std::vector<BadScalar>& cases) {
  for (const BadScalar& bad : cases) {
    SCOPED_TRACE(bad.title);
    EXPECT_EQ(message_of(bad.text, bad.overrides), bad.message);
  }
}

TEST(BadScalar, NamesValueAndWhatIsAllowed) { expect_messages(kScalars); }
TEST(BadScalar, NamesWhatADropCannotHave) { expect_messages(kDrops); }
TEST(BadScalar, NamesWhatAPatchCannotHave) { expect_messages(kPatches); }
TEST(BadScalar, NamesTheOptionOfAnOverride) { expect_messages(kOverrides); }

TEST(BadScalar, ADotTooManyIsNoKey) {
  const std::string message = message_of(heat(), {"scalar.peclet.=5"});
  EXPECT_TRUE(message.starts_with("--set scalar.peclet.=5: scalar.peclet.: unknown key"))
      << message;
}

}  // namespace
}  // namespace meniscus
