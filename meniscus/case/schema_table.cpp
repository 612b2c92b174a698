// The table of all keys of the case file, from which every text about a key is made.
#include "meniscus/case/schema.hpp"
#include "meniscus/case/schema_parts.hpp"

namespace meniscus::schema {
namespace {

const std::vector<Table> kTables{
    {"", false, "The case as a whole."},
    {"flow", false,
     "The imposed linear flow v = G·x. Lengths are in the drop's radius R0, times in 1/G with G "
     "the "
     "rate of shear or strain, stresses in mu_out G. In a quiescent flow the unit of time is "
     "mu_out R0/sigma, which makes the capillary number 1."},
    {"flow.schedule[]", true,
     "A change of the flow at a time: stop, start, reverse, ramp. An entry holds from its time on, "
     "until the next. Entries stand in rising order of time, and a ramp ends before the next entry "
     "begins. An entry needs a kind, a gradient or a factor."},
    {"matrix", false, "The liquid around the drops; its viscosity is the unit."},
    {"drop[]", true,
     "A drop. Its shape is one of radius, axes, surface, from-run. Drops may lie in one another; "
     "the liquid between is the outer drop's."},
    {"drop[].surfactant", false,
     "An insoluble surfactant on the drop, spread evenly at first. Concentrations Gamma are over "
     "that initial one, and tension-ratio and the capillary number mean the tension at Gamma = 1."},
    {"domain", false,
     "The outer boundary, centred at the origin; its triangulation never changes. By default the "
     "imposed flow v = G·x holds on all of it, except that the z-faces of a box in a simple shear "
     "are symmetry-like. With a surface from a file every tag needs a [[domain.patch]]."},
    {"domain.patch[]", true,
     "The condition on a part of the outer boundary. Patches of a box are named x-, x+, y-, y+, "
     "z-, "
     "z+; of a cylinder side, x-, x+, and ends for both; of a sphere all. Those of a surface from "
     "a "
     "file are its tags, which are numbers."},
    {"scalar[]", true,
     "A quantity T that the liquids conduct and carry along: a temperature, or a dissolved "
     "species. "
     "Pe (C dT/dt + C v·grad T - q) = div(K grad T) + Br 2 mu D:D, with the capacity C and the "
     "conductivity K over the matrix's. Its keys are dimensionless, with [scale] too: lengths are "
     "in "
     "R0, times in 1/G. It needs method = \"finite-element\"."},
    {"scalar[].drop[]", true,
     "What the scalar meets in a drop: the first table is about the first [[drop]], and so on. "
     "Drops "
     "beyond the last table take the defaults."},
    {"scalar[].patch[]", true,
     "The condition on the scalar at a part of the outer boundary, called as in [[domain.patch]]. "
     "A "
     "patch without a table has condition = \"none\". One through which the imposed velocity "
     "enters "
     "needs a value, unless peclet = 0 or convection = false."},
    {"interface", false, "How interfaces are represented, moved and remeshed."},
    {"topology", false, "Breakup and coalescence."},
    {"solver", false, "How the flow is solved."},
    {"time", false,
     "Time stepping. Steps are never clipped to the end or to output times. A step that fails, or "
     "that changes the interfaces' energy as the flow does not, is tried again at half its "
     "length."},
    {"time.stop-when", false,
     "When a run ends before time.end: at the first step that meets one of these. `run.json` says "
     "which, as `ended`."},
    {"output", false, "What a run writes, and when."},
    {"scale", false,
     "With this table every key that has a unit is given in SI units, coordinates in surface files "
     "included, and is converted once, when the case is read: lengths by `length` (R0), times by "
     "1/`rate` (1/G), the capillary number is viscosity · rate · length / surface-tension, the "
     "Reynolds number density · rate · length² / viscosity. All results stay dimensionless. The "
     "run of a from-run is dimensionless already."},
};

std::vector<Key> all_keys() {
  std::vector<Key> keys;
  for (const auto part : {flow_keys(), liquid_keys(), domain_keys(), scalar_keys(), run_keys()})
    keys.insert(keys.end(), part.begin(), part.end());
  return keys;
}

}  // namespace

std::span<const Table> tables() { return kTables; }
std::span<const Key> keys() {
  static const std::vector<Key> all = all_keys();
  return all;
}

}  // namespace meniscus::schema
