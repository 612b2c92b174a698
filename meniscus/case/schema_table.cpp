// The table of all keys of the case file, from which every text about a key is made.
#include "meniscus/case/schema.hpp"
#include "meniscus/case/schema_parts.hpp"

namespace meniscus::schema {
namespace {

const std::vector<Table> kTables{
    {"", false, "The case as a whole."},
    {"flow", false,
     "The imposed linear flow v = G·x. Units are R0, 1/G and mu_out G, G the rate of shear or "
     "strain; quiescent: time in mu_out R0/sigma, Ca = 1."},
    {"flow.schedule[]", true,
     "A change of the flow: kind, gradient or factor. An entry holds until the next, in order of "
     "time; a ramp ends before."},
    {"matrix", false, "The liquid around the drops; its viscosity is the unit."},
    {"drop[]", true,
     "A drop: one of radius, axes, surface, from-run. Drops may lie in one another."},
    {"drop[].surfactant", false,
     "A surfactant, spread evenly at first. Gamma is over that concentration; tension-ratio and Ca "
     "hold at Gamma = 1."},
    {"domain", false,
     "The outer boundary, centred at the origin. The imposed flow holds on it; z-faces of a box in "
     "simple shear are symmetries. A surface needs a [[domain.patch]] for every tag."},
    {"domain.patch[]", true,
     "The condition on a part of the boundary. Parts of a box: x-, x+, y-, y+, z-, z+; of a "
     "cylinder: side, x-, x+, ends; of a sphere: all; of a surface: tags."},
    {"scalar[]", true,
     "A temperature or dissolved species T, with finite elements: Pe (C dT/dt + C v·grad T - q) = "
     "div(K grad T) + Br 2 mu D:D. C and K are over the matrix's. All keys are dimensionless, with "
     "[scale] too."},
    {"scalar[].drop[]", true,
     "The drops for the scalar, in their order; defaults beyond the last table."},
    {"scalar[].patch[]", true,
     "The condition on the scalar at a [[domain.patch]]; \"none\" without a table. Inflow needs a "
     "value, unless peclet = 0 or convection = false."},
    {"interface", false, "How interfaces are represented, moved and remeshed."},
    {"topology", false, "Breakup and coalescence."},
    {"solver", false, "How the flow is solved."},
    {"time", false,
     "Steps are not clipped to the end or output times. A step that fails or has a wrong energy is "
     "halved."},
    {"time.stop-when", false,
     "A run ends before time.end at the first step that meets one of these, named by `ended` in "
     "`run.json`."},
    {"output", false, "What a run writes, and when."},
    {"scale", false,
     "With this table every key that has a unit is in SI units, surface files too: lengths over "
     "`length`, times over 1/`rate`. Ca = viscosity · rate · length / surface-tension, Re = "
     "density · rate · length² / viscosity. Results and a from-run are dimensionless."},
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
