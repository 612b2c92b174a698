// The table of all keys of the case file, from which every text about a key is made.
#include "meniscus/case/schema.hpp"
#include "meniscus/case/schema_parts.hpp"

namespace meniscus::schema {
namespace {

const std::vector<Table> kTables{
    {"", false, "The case as a whole."},
    {"flow", false,
     "The imposed linear flow v = G·x. Units are R0, 1/G and mu_out G, with G the rate of shear or "
     "strain. In a quiescent flow the unit of time is mu_out R0/sigma, and Ca is 1."},
    {"flow.schedule[]", true,
     "A change of the flow: stop, start, reverse, ramp. An entry holds until the next, in rising "
     "order of time; a ramp ends before. It needs a kind, a gradient or a factor."},
    {"matrix", false, "The liquid around the drops; its viscosity is the unit."},
    {"drop[]", true,
     "A drop: one of radius, axes, surface, from-run. Drops may lie in one another."},
    {"drop[].surfactant", false,
     "A surfactant on the drop, spread evenly at first. Gamma is over that initial concentration; "
     "tension-ratio and Ca mean the tension at Gamma = 1."},
    {"domain", false,
     "The outer boundary, centred at the origin. The imposed flow holds on it; the z-faces of a "
     "box in simple shear are symmetry-like. With a surface every tag needs a [[domain.patch]]."},
    {"domain.patch[]", true,
     "The condition on a part of the outer boundary: x-, x+, y-, y+, z-, z+ of a box; side, x-, x+ "
     "and ends of a cylinder; all of a sphere; the tags of a surface."},
    {"scalar[]", true,
     "A temperature or dissolved species T, with finite elements: Pe (C dT/dt + C v·grad T - q) = "
     "div(K grad T) + Br 2 mu D:D. C and K are over the matrix's. All keys are dimensionless, with "
     "[scale] too."},
    {"scalar[].drop[]", true,
     "What the scalar meets in the drops, in their order. Drops beyond the last table take the "
     "defaults."},
    {"scalar[].patch[]", true,
     "The condition on the scalar at a patch of [[domain.patch]]; \"none\" without a table. Where "
     "the flow enters, a value is needed, unless peclet = 0 or convection = false."},
    {"interface", false, "How interfaces are represented, moved and remeshed."},
    {"topology", false, "Breakup and coalescence."},
    {"solver", false, "How the flow is solved."},
    {"time", false,
     "Steps are never clipped to the end or to output times. A failed step, or one of wrong "
     "energy, is tried again at half its length."},
    {"time.stop-when", false,
     "When a run ends before time.end: at the first step that meets one of these. `run.json` says "
     "which, as `ended`."},
    {"output", false, "What a run writes, and when."},
    {"scale", false,
     "With this table every key that has a unit is in SI units, coordinates in surface files too. "
     "It is converted once: lengths by `length`, times by 1/`rate`. Ca is viscosity · rate · "
     "length / surface-tension, Re density · rate · length² / viscosity. Results stay "
     "dimensionless, and so is a from-run."},
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
