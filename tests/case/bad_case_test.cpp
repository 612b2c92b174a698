// Every mistake in a case file gives one line with place, key, value and what is allowed.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/case/case_files.hpp"

namespace meniscus {
namespace {

using test::kShear;
using test::message_of;

struct BadCase {
  std::string title;
  std::string text;
  std::string message;  ///< complete
  std::vector<std::string> overrides = {};
};

std::string shear_with(const std::string& more) { return std::string(kShear) + more; }
std::string flow(const std::string& lines) { return "[flow]\n" + lines + "[[drop]]\nradius = 1\n"; }

const std::vector<BadCase> kSyntax{
    {"empty file", "",
     "case.toml: flow.kind is missing: it must be one of \"simple-shear\", \"uniaxial-extension\", "
     "\"planar-extension\", \"quiescent\", unless flow.gradient is given"},
    {"no drop", "[flow]\nkind = \"quiescent\"\n", "case.toml: needs at least one [[drop]]"},
    {"misspelt key", shear_with("viscocity-ratio = 2.0\n"),
     "case.toml:6: drop.viscocity-ratio: unknown key; did you mean \"viscosity-ratio\"?"},
    {"misspelt table", shear_with("[solvr]\nrtol = 1e-6\n"),
     "case.toml:6: solvr: unknown key; did you mean \"solver\"?"},
    {"key in the wrong table", shear_with("edge-floor = 0.1\n"),
     "case.toml:6: drop.edge-floor: unknown key; did you mean \"interface.edge-floor\"?"},
    {"the beginning of a key", shear_with("viscosity = 2.0\n"),
     "case.toml:6: drop.viscosity: unknown key; did you mean \"viscosity-ratio\"?"},
    {"key like no other", shear_with("[time]\nxyzzy = 1\n"),
     "case.toml:7: time.xyzzy: unknown key"},
    {"underscore for hyphen", shear_with("[time]\nmax_step = 1\n"),
     "case.toml:7: time.max_step: unknown key; did you mean \"max-step\"?"},
    {"a table for an array of tables", "[flow]\nkind = \"quiescent\"\n[drop]\nradius = 1\n",
     "case.toml:3: drop must be an array of tables: [[drop]]"},
    {"an array of tables for a table", shear_with("[[time]]\nend = 1\n"),
     "case.toml:6: time must be a table: [time]"},
    {"a number for a table", "flow = 3\n", "case.toml:1: flow must be a table: [flow]"},
};

const std::vector<BadCase> kValues{
    {"text for a number", shear_with("viscosity-ratio = \"two\"\n"),
     "case.toml:6: drop.viscosity-ratio = \"two\" must be a number"},
    {"real for a whole number", shear_with("nodes = 110.5\n"),
     "case.toml:6: drop.nodes = 110.5 must be a whole number"},
    {"number for a flag", shear_with("[output]\nvolume = 1\n"),
     "case.toml:7: output.volume = 1 must be true or false"},
    {"two numbers for three", shear_with("center = [0, 0]\n"),
     "case.toml:6: drop.center = [0, 0] must be three numbers [x, y, z]"},
    {"number for a word", shear_with("[time]\nscheme = 2\n"),
     "case.toml:7: time.scheme = 2 must be one of \"rk2\", \"euler\", \"semi-implicit\", \"rkc\", "
     "\"implicit\""},
    {"no tolerance", shear_with("[time]\ntolerance = 0.0\n"),
     "case.toml:7: time.tolerance = 0.0 must be between 0 and 1, 0 excluded"},
    {"negative tolerance", shear_with("[time]\ntolerance = -0.1\n"),
     "case.toml:7: time.tolerance = -0.1 must be between 0 and 1, 0 excluded"},
    {"a tolerance of more than an edge", shear_with("[time]\ntolerance = 1.5\n"),
     "case.toml:7: time.tolerance = 1.5 must be between 0 and 1, 0 excluded"},
    {"tolerance of the paper's steps", shear_with("[time]\ncontrol = \"paper\"\ntolerance = 0.1\n"),
     "case.toml:8: time.tolerance has no effect here: it applies with control = \"error\""},
    {"tolerance of steps with a factor", shear_with("[time]\nstep-factor = 2\ntolerance = 0.1\n"),
     "case.toml:8: time.tolerance has no effect here: it applies with control = \"error\""},
    {"faces of flat elements",
     shear_with("[solver]\nelements = \"P1-P1\"\n[interface]\nmotion-normal = \"faces\"\n"),
     "case.toml:9: interface.motion-normal = \"faces\" needs solver.elements = \"P2-P1\""},
    {"factor of controlled steps", shear_with("[time]\ncontrol = \"error\"\nstep-factor = 2\n"),
     "case.toml:8: time.step-factor has no effect here: it applies with control = \"paper\""},
    {"error control of Euler's steps",
     shear_with("[time]\nscheme = \"euler\"\ncontrol = \"error\"\n"),
     "case.toml:8: time.control = \"error\" needs another scheme than \"euler\", which "
     "estimates no error"},
    {"number for a text", "title = 7\n" + std::string(kShear),
     "case.toml:1: title = 7 must be a text in quotes"},
    {"misspelt word", flow("kind = \"simple-sheer\"\n"),
     "case.toml:2: flow.kind = \"simple-sheer\" must be one of \"simple-shear\", "
     "\"uniaxial-extension\", \"planar-extension\", \"quiescent\"; did you mean \"simple-shear\"?"},
    {"elements there are none of", shear_with("[solver]\nelements = \"P2-P2\"\n"),
     "case.toml:7: solver.elements = \"P2-P2\" must be one of \"P1-P1\", \"P2-P1\"; did you mean "
     "\"P2-P1\"?"},
    {"an unknown law of viscosity", shear_with("viscosity-law = \"carreau\"\n"),
     "case.toml:6: drop.viscosity-law = \"carreau\" must be one of \"newtonian\", "
     "\"carreau-yasuda\", \"power-law\""},
    {"a power law without index", shear_with("viscosity-law = \"power-law\"\n"),
     "case.toml:4: drop.power-index is missing"},
    {"a law of the matrix without time",
     shear_with("[matrix]\nviscosity-law = \"carreau-yasuda\"\n"),
     "case.toml:6: matrix.time-constant is missing"},
    {"an index of no law", shear_with("power-index = 0.5\n"),
     "case.toml:6: drop.power-index has no effect here: it applies with viscosity-law = "
     "\"carreau-yasuda\" or \"power-law\""},
    {"a ceiling of Carreau's",
     shear_with("viscosity-law = \"carreau-yasuda\"\npower-index = 0.5\ntime-constant = 1.0\n"
                "viscosity-ceiling = 10.0\n"),
     "case.toml:9: drop.viscosity-ceiling has no effect here: it applies with viscosity-law = "
     "\"power-law\""},
    {"an index of nothing", shear_with("viscosity-law = \"power-law\"\npower-index = 0.0\n"),
     "case.toml:7: drop.power-index = 0.0 must be between 0 and 3, 0 excluded"},
    {"boundary integrals of a thinning drop",
     shear_with("viscosity-law = \"power-law\"\npower-index = 0.5\n[domain]\nshape = "
                "\"unbounded\"\n[solver]\nmethod = \"boundary-integral\"\n"),
     "case.toml:6: drop.viscosity-law = \"power-law\" needs solver.method = \"finite-element\": "
     "boundary integrals describe Newtonian liquids alone"},
    {"a surfactant without elasticity", shear_with("[drop.surfactant]\npeclet = 10\n"),
     "case.toml:6: drop.surfactant.elasticity is missing"},
    {"a surfactant that raises tension", shear_with("[drop.surfactant]\nelasticity = -0.1\n"),
     "case.toml:7: drop.surfactant.elasticity = -0.1 must be at least 0"},
    {"a coverage at the packing limit",
     shear_with("[drop.surfactant]\nequation-of-state = \"langmuir\"\nelasticity = 0.2\ncoverage = "
                "1.0\n"),
     "case.toml:9: drop.surfactant.coverage = 1.0 must be between 0 and 1, both excluded"},
    {"a coverage that is not a number",
     shear_with("[drop.surfactant]\nequation-of-state = \"langmuir\"\nelasticity = 0.2\ncoverage = "
                "nan\n"),
     "case.toml:9: drop.surfactant.coverage = nan must be finite and between 0 and 1, both "
     "excluded"},
    {"a coverage that leaves no tension",
     shear_with("[drop.surfactant]\nequation-of-state = \"langmuir\"\nelasticity = 2.0\ncoverage = "
                "0.5\n"),
     "case.toml:8: drop.surfactant.elasticity = 2.0 leaves no tension at the initial "
     "concentration; with this coverage it must be below 1.4427"},
    {"a coverage of the linear law",
     shear_with("[drop.surfactant]\nelasticity = 0.2\ncoverage = 0.5\n"),
     "case.toml:8: drop.surfactant.coverage has no effect here: it applies with "
     "equation-of-state = \"langmuir\""},
    {"a surface Péclet number of zero",
     shear_with("[drop.surfactant]\nelasticity = 0.2\npeclet = 0\n"),
     "case.toml:8: drop.surfactant.peclet = 0.0 must be > 0 or inf"},
    {"a form that knows no gradient of tension",
     shear_with("surfactant = {elasticity = 0.2}\n[interface]\nsurface-tension = \"balanced\"\n"),
     "case.toml:8: interface.surface-tension = \"balanced\" must be \"weak\" where a drop has a "
     "surfactant: the other forms know no gradient of tension"},
    {"boundary integrals in a box", shear_with("[solver]\nmethod = \"boundary-integral\"\n"),
     "case.toml:7: solver.method = \"boundary-integral\" needs domain.shape = \"unbounded\""},
    {"unbounded domain", shear_with("[domain]\nshape = \"unbounded\"\n"),
     "case.toml:7: domain.shape = \"unbounded\" needs solver.method = \"boundary-integral\""},
    {"patch of an unbounded domain",
     shear_with("[domain]\nshape = \"unbounded\"\n[[domain.patch]]\nname = \"x-\"\n"
                "[solver]\nmethod = \"boundary-integral\"\n"),
     "case.toml:8: [[domain.patch]] has no effect here: an unbounded domain has no patches"},
    {"size of an unbounded domain",
     shear_with("[domain]\nshape = \"unbounded\"\nradius = 10\n"
                "[solver]\nmethod = \"boundary-integral\"\n"),
     "case.toml:8: domain.radius has no effect here: it applies with shape = \"sphere\" or "
     "\"cylinder\""},
    {"capillary form of boundary integrals",
     shear_with("[domain]\nshape = \"unbounded\"\n[interface]\nsurface-tension = \"nodal\"\n"
                "[solver]\nmethod = \"boundary-integral\"\n"),
     "case.toml:9: interface.surface-tension has no effect here: it applies with method = "
     "\"finite-element\""},
    {"threads of finite elements", shear_with("[solver]\nthreads = 2\n"),
     "case.toml:7: solver.threads has no effect here: it applies with method = "
     "\"boundary-integral\""},
    {"coalescence", shear_with("[topology]\ncoalescence = \"sometimes\"\n"),
     "case.toml:7: topology.coalescence = \"sometimes\" must be one of \"on\", \"off\""},
    {"breakup", shear_with("[topology]\nbreakup-radius = -0.01\n"),
     "case.toml:7: topology.breakup-radius = -0.01 must be between 0 and 1000000"},
    {"gap layers", shear_with("[interface]\ngap-layers = 101\n"),
     "case.toml:7: interface.gap-layers = 101 must be between 0 and 100"},
    {"Ca = 0", flow("kind = \"simple-shear\"\ncapillary-number = 0\n"),
     "case.toml:3: flow.capillary-number = 0.0 must be > 0 or inf"},
    {"negative Ca", flow("kind = \"simple-shear\"\ncapillary-number = -inf\n"),
     "case.toml:3: flow.capillary-number = -inf must be > 0 or inf"},
    {"zero viscosity", shear_with("viscosity-ratio = 0.0\n"),
     "case.toml:6: drop.viscosity-ratio = 0.0 must be > 0"},
    {"negative viscosity", shear_with("viscosity-ratio = -1.0\n"),
     "case.toml:6: drop.viscosity-ratio = -1.0 must be > 0"},
    {"NaN", shear_with("viscosity-ratio = nan\n"),
     "case.toml:6: drop.viscosity-ratio = nan must be finite and > 0"},
    {"NaN in a vector", shear_with("center = [0, nan, 0]\n"),
     "case.toml:6: drop.center = [0.0, nan, 0.0] must be finite and between -1000000 "
     "and 1000000"},
    {"infinite time", shear_with("[time]\nend = inf\n"),
     "case.toml:7: time.end = inf must be finite and at least 0"},
    {"too few nodes", shear_with("nodes = 8\n"),
     "case.toml:6: drop.nodes = 8 must be between 42 and 200000"},
    {"too many nodes", shear_with("nodes = 99999999\n"),
     "case.toml:6: drop.nodes = 99999999 must be between 42 and 200000"},
    {"tolerance out of range", shear_with("[solver]\nrtol = 0.0\n"),
     "case.toml:7: solver.rtol = 0.0 must be between 0 and 0.1, 0 excluded"},
    {"zero axis", "[flow]\nkind = \"quiescent\"\n[[drop]]\naxes = [1, 0, 1]\n",
     "case.toml:4: drop.axes = [1.0, 0.0, 1.0] must be between 1e-06 and 1000000"},
    {"absurdly small drop", "[flow]\nkind = \"quiescent\"\n[[drop]]\nradius = 1e-300\n",
     "case.toml:4: drop.radius = 1e-300 must be between 1e-06 and 1000000"},
    {"absurdly long needle", "[flow]\nkind = \"quiescent\"\n[[drop]]\naxes = [1e-3, 1, 1e3]\n",
     "case.toml:4: drop.axes = [0.001, 1.0, 1000.0] must not differ by more than a factor 1000"},
    {"absurdly far drop", shear_with("center = [0, 1e300, 0]\n"),
     "case.toml:6: drop.center = [0.0, 1e+300, 0.0] must be between -1000000 and 1000000"},
    {"absurdly large box", shear_with("[domain]\nhalf-width = 1e300\n"),
     "case.toml:7: domain.half-width = 1e+300 must be between 1e-06 and 1000000"},
    {"absurdly flat box", shear_with("[domain]\nhalf-widths = [9, 9, 1e-9]\n"),
     "case.toml:7: domain.half-widths = [9.0, 9.0, 1e-09] must be between 1e-06 and 1000000"},
    {"boundary beyond memory", shear_with("[domain]\nnodes = 1000000\n"),
     "case.toml:7: domain.nodes = 1000000 must be between 50 and 20000"},
    {"metres taken for R0",
     "[flow]\nkind = \"simple-shear\"\n[[drop]]\nradius = 1\n"
     "[scale]\nlength = 1e-9\nviscosity = 1.0\nsurface-tension = 0.01\nrate = 1.0\n",
     "case.toml:4: drop.radius = 1.0 must be between 1e-06 and 1000000 in units of R0"},
    {"PETSc word without an option", shear_with("[solver]\npetsc-options = \"ksp_view -a 1 2\"\n"),
     "case.toml:7: solver.petsc-options = \"ksp_view -a 1 2\" has the word \"ksp_view\", which "
     "belongs to no option (-name value …)"},
    {"PETSc value without an option", shear_with("[solver]\npetsc-options = \"-a -1 2\"\n"),
     "case.toml:7: solver.petsc-options = \"-a -1 2\" has the word \"2\", which belongs to no "
     "option (-name value …)"},
    {"smallest step above the largest", shear_with("[time]\nmin-step = 2.0\n"),
     "case.toml:7: time.min-step = 2.0 must be at most time.max-step = 1 (unit: 1/G)"},
};

const std::vector<BadCase> kMeaning{
    {"gradient with a trace", flow("gradient = [[1, 0, 0], [0, 1, 0], [0, 0, -1]]\n"),
     "case.toml:2: flow.gradient = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]] has the "
     "trace 1; the trace of a gradient must be 0 (no net inflow)"},
    {"no kind of flow", "title = \"\"\n[flow]\ncapillary-number = 0.3\n[[drop]]\nradius = 1\n",
     "case.toml:2: flow.kind is missing: it must be one of \"simple-shear\", "
     "\"uniaxial-extension\", \"planar-extension\", \"quiescent\", unless flow.gradient is given"},
    {"Ca of a flow at rest", flow("kind = \"quiescent\"\ncapillary-number = 0.3\n"),
     "case.toml:3: flow.capillary-number = 0.3 must be 1 or inf where neither the flow nor a patch "
     "sets a rate: times are in mu_out R0/sigma"},
    {"kind and gradient",
     flow("kind = \"quiescent\"\ngradient = [[0, 1, 0], [0, 0, 0], [0, 0, 0]]\n"),
     "case.toml:3: flow.gradient = [[0.0, 1.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]] conflicts "
     "with kind: give one of the two"},
    {"drop without a shape", "[flow]\nkind = \"quiescent\"\n[[drop]]\nnodes = 110\n",
     "case.toml:3: drop needs one of radius, axes, surface, from-run"},
    {"drop with two shapes", shear_with("axes = [1, 1, 1]\n"),
     "case.toml:6: drop.axes = [1.0, 1.0, 1.0] conflicts with radius: a drop has one shape"},
    {"schedule out of order",
     shear_with("[[flow.schedule]]\ntime = 2\nfactor = 0\n[[flow.schedule]]\ntime = 1\n"
                "factor = 1\n"),
     "case.toml:10: flow.schedule.time = 1.0 must come after the entry before it has begun and its "
     "ramp has ended (2 1/G)"},
    {"schedule inside a ramp",
     shear_with("[[flow.schedule]]\ntime = 2\nfactor = 0\nramp = 1\n[[flow.schedule]]\n"
                "time = 2.5\nfactor = 1\n"),
     "case.toml:11: flow.schedule.time = 2.5 must come after the entry before it has begun and its "
     "ramp has ended (3 1/G)"},
    {"schedule without a flow", shear_with("[[flow.schedule]]\ntime = 2\n"),
     "case.toml:6: flow.schedule needs one of kind, gradient, factor"},
    {"schedule without a time", shear_with("[[flow.schedule]]\nfactor = 0\n"),
     "case.toml:6: flow.schedule.time is missing"},
    {"size of another shape", shear_with("[domain]\nshape = \"sphere\"\nhalf-width = 5.0\n"),
     "case.toml:8: domain.half-width has no effect here: it applies with shape = \"box\", "
     "without half-widths"},
    {"unknown patch", shear_with("[[domain.patch]]\nname = \"top\"\n"),
     "case.toml:7: domain.patch.name = \"top\" is not a patch of the box; its patches are \"x-\", "
     "\"x+\", \"y-\", \"y+\", \"z-\", \"z+\""},
    {"patch without a name", shear_with("[[domain.patch]]\ncondition = \"open\"\n"),
     "case.toml:6: domain.patch.name is missing"},
    {"patch twice",
     shear_with("[[domain.patch]]\nname = \"x-\"\n[[domain.patch]]\nname = \"x-\"\n"),
     "case.toml:9: domain.patch.name = \"x-\" has a condition already, from the [[domain.patch]] "
     "at case.toml:6"},
    {"traction on a wall", shear_with("[[domain.patch]]\nname = \"x-\"\ntraction = [1, 0, 0]\n"),
     "case.toml:8: domain.patch.traction has no effect here: it applies with condition = \"open\""},
    {"tag on a box", shear_with("[[domain.patch]]\nname = \"x-\"\ntag = 1\n"),
     "case.toml:8: domain.patch.tag has no effect here: it applies with domain.surface"},
    {"incomplete scale", shear_with("[scale]\nlength = 1e-3\n"),
     "case.toml:6: scale.viscosity is missing"},
    {"a radius in R0 with a scale",
     "[flow]\nkind = \"simple-shear\"\n[scale]\nlength = 1e-3\nviscosity = 1.0\n"
     "surface-tension = 0.01\nrate = 1.0\n[[drop]]\nradius = 1.0\n",
     "case.toml:9: drop.radius = 1.0 must be at most 100 times scale.length = 0.001: with [scale] "
     "lengths are in metres"},
    {"a length to stop at in R0 with a scale",
     "[flow]\nkind = \"simple-shear\"\n[scale]\nlength = 1e-3\nviscosity = 1.0\n"
     "surface-tension = 0.01\nrate = 1.0\n[[drop]]\nradius = 1e-3\n[time.stop-when]\n"
     "broken-length = 4.0\n",
     "case.toml:11: time.stop-when.broken-length = 4.0 must be at most 1000 times scale.length = "
     "0.001: with [scale] lengths are in metres"},
    {"a domain in R0 with a scale",
     "[flow]\nkind = \"simple-shear\"\n[scale]\nlength = 1e-4\nviscosity = 1.0\n"
     "surface-tension = 0.01\nrate = 1.0\n[domain]\nhalf-width = 10.0\n[[drop]]\nradius = 1e-4\n",
     "case.toml:9: domain.half-width = 10.0 must be at most 1000 times scale.length = 0.0001: with "
     "[scale] lengths are in metres"},
    {"scale and Ca",
     shear_with("[scale]\nlength = 1\nviscosity = 1.0\nsurface-tension = 0.01\nrate = 1.0\n"),
     "case.toml:3: flow.capillary-number has no effect here: it applies without [scale]"},
    {"missing surface file", "[flow]\nkind = \"quiescent\"\n[[drop]]\nsurface = \"none.stl\"\n",
     "case.toml:4: drop.surface = \"none.stl\" does not exist"},
    {"missing run", "[flow]\nkind = \"quiescent\"\n[[drop]]\nfrom-run = \"nowhere\"\n",
     "case.toml:4: drop.from-run = \"nowhere\" does not exist"},
};

const std::vector<BadCase> kOverrides{
    {"no equals sign",
     std::string(kShear),
     "--set time.end: expected key=value, as in --set drop[0].nodes=200",
     {"time.end"}},
    {"no value",
     std::string(kShear),
     "--set time.end=: expected key=value, as in --set drop[0].nodes=200",
     {"time.end="}},
    {"unknown key",
     std::string(kShear),
     "--set time.edn=3: time.edn: unknown key; did you mean \"time.end\"?",
     {"time.edn=3"}},
    {"no index, two drops",
     shear_with("[[drop]]\nradius = 1\ncenter = [0, 0, 3]\n"),
     "--set drop.nodes=200: drop.nodes: there are 2 [[drop]]; say which by an index, as in "
     "drop[0].nodes",
     {"drop.nodes=200"}},
    {"no index, no entry",
     std::string(kShear),
     "--set flow.schedule.time=2: flow.schedule.time: there are 0 [[flow.schedule]]; say which by "
     "an index, as in flow.schedule[0].time",
     {"flow.schedule.time=2"}},
    {"unknown key of one drop",
     std::string(kShear),
     "--set drop.nods=80: drop.nods: unknown key; did you mean \"drop.nodes\"?",
     {"drop.nods=80"}},
    {"unknown key of two drops",
     shear_with("[[drop]]\nradius = 1\ncenter = [0, 0, 3]\n"),
     "--set drop.nods=80: drop.nods: unknown key; did you mean \"drop[0].nodes\"?",
     {"drop.nods=80"}},
    {"unknown key of a numbered drop",
     std::string(kShear),
     "--set drop[0].nods=80: drop[0].nods: unknown key; did you mean \"drop[0].nodes\"?",
     {"drop[0].nods=80"}},
    {"key of another table",
     std::string(kShear),
     "--set solver.nodes=80: solver.nodes: unknown key; did you mean \"drop.nodes\"?",
     {"solver.nodes=80"}},
    {"misspelt table alone",
     std::string(kShear),
     "--set solvr=1: solvr: unknown key; did you mean a key of \"solver\"?",
     {"solvr=1"}},
    {"key like no other", std::string(kShear), "--set xyzzy=1: xyzzy: unknown key", {"xyzzy=1"}},
    {"a table",
     std::string(kShear),
     "--set flow={kind=\"quiescent\"}: flow is a table; set its keys one by one, as in --set "
     "flow.kind=quiescent",
     {"flow={kind=\"quiescent\"}"}},
    {"an array of tables",
     std::string(kShear),
     "--set drop[0]={radius=1}: drop[0] is a table; set its keys one by one, as in --set "
     "flow.kind=quiescent",
     {"drop[0]={radius=1}"}},
    {"a drop without a shape",
     std::string(kShear),
     "--set drop[1].nodes=60: there is no drop[1]; to add it, set one of drop[1].radius, "
     "drop[1].axes, drop[1].surface, drop[1].from-run too",
     {"drop[1].nodes=60"}},
    {"a title like a number",
     std::string(kShear),
     "--set title=7: title = 7 must be a text in quotes",
     {"title=7"}},
    {"index out of range",
     std::string(kShear),
     "--set drop[4].nodes=200: drop[4] does not exist; the next to add is drop[1]",
     {"drop[4].nodes=200"}},
    {"wrong type",
     std::string(kShear),
     "--set drop[0].nodes=many: drop[0].nodes = \"many\" must be a whole number",
     {"drop[0].nodes=many"}},
    {"out of range",
     std::string(kShear),
     "--set flow.capillary-number=0: flow.capillary-number = 0.0 must be > 0 or inf",
     {"flow.capillary-number=0"}},
};

void expect_messages(const std::vector<BadCase>& cases) {
  for (const BadCase& bad : cases) {
    SCOPED_TRACE(bad.title);
    EXPECT_EQ(message_of(bad.text, bad.overrides), bad.message);
  }
}

TEST(BadCase, NamesLineAndKeyOfWhatIsNotInTheSchema) { expect_messages(kSyntax); }
TEST(BadCase, NamesValueAndWhatIsAllowed) { expect_messages(kValues); }
TEST(BadCase, NamesWhatKeysContradictEachOther) { expect_messages(kMeaning); }
TEST(BadCase, NamesTheOptionOfAnOverride) { expect_messages(kOverrides); }

TEST(BadCase, TomlSyntaxErrorsNameTheLine) {
  const std::string unclosed = message_of("[flow]\nkind = \"simple-shear\n[[drop]]\n");
  EXPECT_TRUE(unclosed.starts_with("case.toml:2: not valid TOML: ")) << unclosed;
  const std::string twice = message_of("[flow]\nkind = \"quiescent\"\nkind = \"quiescent\"\n");
  EXPECT_TRUE(twice.starts_with("case.toml:3: not valid TOML: ")) << twice;
  const std::string binary = message_of(std::string("\x00\xff\xfe", 3));
  EXPECT_TRUE(binary.starts_with("case.toml:1: not valid TOML: ")) << binary;
  for (const std::string& message : {unclosed, twice, binary})
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

TEST(BadCase, MissingFileAndFolderAreNamed) {
  const test::TemporaryFolder folder;
  const auto message = [](const std::filesystem::path& file) -> std::string {
    try {
      (void)read_case(file);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "no error";
  };
  const std::filesystem::path none = folder.path() / "none.toml";
  EXPECT_EQ(message(none), none.string() + ": cannot be read: No such file or directory");
  EXPECT_EQ(message(folder.path()), folder.path().string() + ": is a folder, not a case file");
  const std::filesystem::path empty = folder.write("empty.toml", "");
  EXPECT_TRUE(message(empty).starts_with(empty.string() + ": flow.kind is missing"));
}

}  // namespace
}  // namespace meniscus
