// Every mistake about inertia and gravity gives one line with place, key, value and what is
// allowed.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/case/case_files.hpp"

namespace meniscus {
namespace {

using test::message_of;

struct BadInertia {
  std::string title;
  std::string text;
  std::string message;  ///< complete
  std::vector<std::string> overrides = {};
};

/// Further lines of [flow] from line 3 on, then a drop; what follows comes after its radius.
std::string flow(const std::string& lines, const std::string& more = "") {
  return "[flow]\nkind = \"simple-shear\"\n" + lines + "[[drop]]\nradius = 1\n" + more;
}
/// Re = 10 on line 3; what follows begins on line 6.
std::string inertia(const std::string& more) { return flow("reynolds-number = 10\n", more); }
/// No inertia; what follows begins on line 5.
std::string stokes(const std::string& more) { return flow("", more); }
/// Gravity on line 3; what follows begins on line 6.
std::string gravity(const std::string& more) { return flow("gravity = [0, 0, -1]\n", more); }
/// Units on five lines; what follows begins on the sixth.
std::string scale(const std::string& more) {
  return "[scale]\nlength = 1\nviscosity = 2\nsurface-tension = 3\nrate = 4\n" + more;
}

const std::vector<BadInertia> kNumbers{
    {"a negative Reynolds number", flow("reynolds-number = -1\n"),
     "case.toml:3: flow.reynolds-number = -1.0 must be at least 0"},
    {"a Reynolds number that is none", flow("reynolds-number = nan\n"),
     "case.toml:3: flow.reynolds-number = nan must be finite and at least 0"},
    {"an infinite Reynolds number", flow("reynolds-number = inf\n"),
     "case.toml:3: flow.reynolds-number = inf must be finite and at least 0"},
    {"a Reynolds number and a scale", inertia(scale("")),
     "case.toml:3: flow.reynolds-number has no effect here: it applies without [scale]"},
    {"a negative density of the matrix", stokes(scale("density = -1000\n")),
     "case.toml:10: scale.density = -1000.0 must be at least 0"},
    {"a negative density ratio", inertia("density-ratio = -1\n"),
     "case.toml:6: drop.density-ratio = -1.0 must be > 0"},
    {"a drop without mass", inertia("density-ratio = 0\n"),
     "case.toml:6: drop.density-ratio = 0.0 must be > 0"},
    {"a density ratio that is none", inertia("density-ratio = nan\n"),
     "case.toml:6: drop.density-ratio = nan must be finite and > 0"},
    {"a density ratio of Stokes flow", stokes("density-ratio = 2\n"),
     "case.toml:5: drop.density-ratio has no effect here: it applies with inertia "
     "(reynolds-number, scale.density) or gravity"},
    {"a negative Reynolds number of the command line",
     stokes(""),
     "--set flow.reynolds-number=-1: flow.reynolds-number = -1.0 must be at least 0",
     {"flow.reynolds-number=-1"}},
};

const std::vector<BadInertia> kMethods{
    {"boundary integrals",
     inertia("[domain]\nshape = \"unbounded\"\n[solver]\nmethod = \"boundary-integral\"\n"),
     "case.toml:9: solver.method = \"boundary-integral\" must be \"finite-element\" where liquids "
     "have inertia: boundary integrals solve Stokes flow"},
    {"a direct solver", inertia("[solver]\nlinear = \"mumps\"\n"),
     "case.toml:7: solver.linear = \"mumps\" must be \"block\" where liquids have inertia"},
    {"a solver that takes linear elements", inertia("[solver]\nlinear = \"paper-gmres\"\n"),
     "case.toml:7: solver.linear = \"paper-gmres\" must be \"block\" where liquids have inertia"},
    {"a form of tension that takes linear elements",
     inertia("[interface]\nsurface-tension = \"nodal\"\n"),
     "case.toml:7: interface.surface-tension = \"nodal\" must be \"weak\" or \"balanced\" where "
     "liquids have inertia"},
    {"a frame that moves with the drops", inertia("[domain]\nframe = \"drops\"\n"),
     "case.toml:7: domain.frame = \"drops\" must be \"fixed\" where liquids have inertia"},
    {"a scheme of Stokes flow", inertia("[time]\nscheme = \"rk2\"\n"),
     "case.toml:7: time.scheme = \"rk2\" must be \"implicit\" where liquids have inertia"},
    {"Euler's scheme", inertia("[time]\nscheme = \"euler\"\n"),
     "case.toml:7: time.scheme = \"euler\" must be \"implicit\" where liquids have inertia"},
    {"a scheme of Stokes flow with a scale",
     stokes("[time]\nscheme = \"rkc\"\n" + scale("density = 1000\n")),
     "case.toml:6: time.scheme = \"rkc\" must be \"implicit\" where liquids have inertia"},
    {"the scheme of inertia in Stokes flow", stokes("[time]\nscheme = \"implicit\"\n"),
     "case.toml:6: time.scheme = \"implicit\" needs flow.reynolds-number or scale.density: Stokes "
     "flow has other schemes"},
    {"inertia from the command line",
     stokes("[solver]\nelements = \"P1-P1\"\nlinear = \"minres\"\n"),
     "case.toml:7: solver.linear = \"minres\" must be \"block\" where liquids have inertia",
     {"flow.reynolds-number=10"}},
};

const std::vector<BadInertia> kGravity{
    {"liquids of one density", gravity(""),
     "case.toml:3: flow.gravity = [0.0, 0.0, -1.0] needs drop.density-ratio: liquids of one "
     "density do not feel gravity"},
    {"liquids of one density, with inertia", flow("gravity = [1, 0, 0]\nreynolds-number = 10\n"),
     "case.toml:3: flow.gravity = [1.0, 0.0, 0.0] needs drop.density-ratio: liquids of one density "
     "do not feel gravity"},
    {"no surface tension",
     flow("capillary-number = inf\ngravity = [0, 0, -1]\n", "density-ratio = 2\n"),
     "case.toml:4: flow.gravity = [0.0, 0.0, -1.0] needs surface tension: its unit is "
     "sigma/(rho_out R0²)"},
    {"a scale without density", gravity("density-ratio = 2\n" + scale("")),
     "case.toml:3: flow.gravity = [0.0, 0.0, -1.0] needs scale.density"},
    {"a scale without surface tension",
     gravity("density-ratio = 2\n" + scale("density = 1000\n")),
     "case.toml:3: flow.gravity = [0.0, 0.0, -1.0] needs surface tension: its unit is "
     "sigma/(rho_out R0²)",
     {"scale.surface-tension=0"}},
    {"gravity that is not a number", flow("gravity = [0, nan, 0]\n", "density-ratio = 2\n"),
     "case.toml:3: flow.gravity = [0.0, nan, 0.0] must be finite"},
    {"one number", flow("gravity = 9.81\n", "density-ratio = 2\n"),
     "case.toml:3: flow.gravity = 9.81 must be three numbers [x, y, z]"},
    {"a density ratio without weight", flow("gravity = [0, 0, 0]\n", "density-ratio = 2\n"),
     "case.toml:6: drop.density-ratio has no effect here: it applies with inertia "
     "(reynolds-number, scale.density) or gravity"},
};

void expect_messages(const std::vector<BadInertia>& cases) {
  for (const BadInertia& bad : cases) {
    SCOPED_TRACE(bad.title);
    EXPECT_EQ(message_of(bad.text, bad.overrides), bad.message);
  }
}

TEST(BadInertia, NamesNumbersAndWhatIsAllowed) { expect_messages(kNumbers); }
TEST(BadInertia, NamesMethodsOfStokesFlow) { expect_messages(kMethods); }
TEST(BadInertia, NamesWhatGravityNeeds) { expect_messages(kGravity); }

}  // namespace
}  // namespace meniscus
