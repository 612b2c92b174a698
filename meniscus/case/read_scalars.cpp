#include <algorithm>
#include <array>
#include <string>

#include "meniscus/case/case_parts.hpp"
#include "meniscus/case/words.hpp"

namespace meniscus {
namespace {

using Kind = ScalarCondition::Kind;

// What frames and tables, which another room writes, call their own: arrays of frames, columns of
// tables, and the words that several columns begin with.
constexpr std::array kArrays{
    "curvature", "normal_velocity", "velocity", "node_density",     "pressure_jump", "drop",
    "pressure",  "region",          "patch",    "min_dihedral_deg", "TimeValue"};
constexpr std::array kColumns{
    "surfactant", "tension",    "step",    "t",    "dt",     "drops",  "surface",
    "nodes",      "tetrahedra", "min_gap", "min",  "linear", "power",  "dissipation",
    "stress",     "N1",         "N2",      "mesh", "parent", "volume", "area",
    "x",          "y",          "z",       "L",    "B",      "W",      "D",
    "angle",      "extent",     "H",       "neck", "kind"};

bool is_taken(const std::string& name) {
  return std::ranges::find(kArrays, name) != kArrays.end() ||
         std::ranges::find(kColumns, name) != kColumns.end();
}

std::string read_name(Settings& settings, const std::string& table,
                      const std::vector<ScalarCase>& earlier) {
  const std::string path = table + ".name", name = settings.text(path);
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto is_allowed = [&](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || c == '_';
  };
  if (name.empty() || !is_letter(name[0]) || !std::ranges::all_of(name, is_allowed))
    settings.reject(path, "must be a letter, then letters, digits and _");
  if (is_taken(name))
    settings.reject(path, "must be another name: frames and tables use it already");
  for (const ScalarCase& other : earlier)
    if (other.scalar.name == name)
      settings.reject(path, "must be another name: the [[scalar]] at {} has it",
                      settings.source(other.path));
  return name;
}

Scalar read_scalar(Settings& settings, const std::string& table) {
  Scalar scalar;
  scalar.is_species = settings.choice(table + ".kind", words::scalar_kinds);
  scalar.peclet = settings.number(table + ".peclet");
  scalar.is_convected = scalar.peclet > 0.0 && settings.flag(table + ".convection");
  if (!scalar.is_species) scalar.brinkman = settings.number(table + ".brinkman");
  scalar.reference = settings.number(table + ".reference");
  scalar.tension_slope = settings.number(table + ".tension-slope");
  scalar.buoyancy = settings.vector(table + ".buoyancy");
  scalar.viscosity_exponent = settings.number(table + ".viscosity-exponent");
  return scalar;
}

ScalarProfile read_initial(Settings& settings, const std::string& table) {
  ScalarProfile profile;
  profile.value = settings.number(table + ".initial");
  profile.gradient = settings.vector(table + ".initial-gradient");
  profile.spot = settings.number(table + ".spot-height");
  if (profile.spot == 0.0) return profile;
  profile.center = settings.vector(table + ".spot-center");
  profile.width = settings.number(table + ".spot-width");
  return profile;
}

[[noreturn]] void reject_concentration(const Settings& settings, const std::string& path) {
  settings.reject(path, "must be at least 0: it is a concentration");
}

/// Reads what the table of a scalar or of one of its drops says about a liquid of capacity and
/// conductivity 1.
ScalarLiquid read_liquid(Settings& settings, const std::string& table, const Scalar& scalar) {
  ScalarLiquid liquid;
  liquid.source = settings.number(table + ".source");
  if (scalar.peclet > 0.0)
    liquid.initial = read_initial(settings, table);
  else if (liquid.source != 0.0)
    settings.reject(table + ".source", "must be 0 with peclet = 0, where a source has no effect");
  if (scalar.is_species && liquid.initial.value < 0.0)
    reject_concentration(settings, table + ".initial");
  if (scalar.is_species && liquid.initial.gradient.isZero(0.0) &&
      liquid.initial.value + liquid.initial.spot < 0.0)
    settings.reject(table + ".spot-height",
                    "must be at least −initial = {}: the sum is a concentration",
                    -liquid.initial.value);
  return liquid;
}

ScalarLiquid read_drop(Settings& settings, const std::string& table, const Scalar& scalar) {
  ScalarLiquid liquid = read_liquid(settings, table, scalar);
  const double diffusivity = settings.number(table + ".diffusivity-ratio");
  if (scalar.is_species) {
    liquid.capacity = settings.number(table + ".partition");
    liquid.conductivity = liquid.capacity * diffusivity;
  } else {
    liquid.conductivity = settings.number(table + ".conductivity-ratio");
    liquid.capacity = liquid.conductivity / diffusivity;
  }
  return liquid;
}

/// Reads what the scalar meets in the matrix and in each of the case's drops.
std::vector<ScalarLiquid> read_liquids(Settings& settings, const ScalarCase& c,
                                       std::size_t num_drops) {
  const auto count = static_cast<std::size_t>(settings.count(c.path + ".drop"));
  if (count > num_drops)
    reject_input("{}: scalar.drop: there are {} tables and {} [[drop]]; give at most one for each",
                 settings.source(fmt::format("{}.drop[{}]", c.path, num_drops)), count, num_drops);
  std::vector<ScalarLiquid> liquids{read_liquid(settings, c.path, c.scalar)};
  for (std::size_t i = 0; i < count; ++i)
    liquids.push_back(read_drop(settings, fmt::format("{}.drop[{}]", c.path, i), c.scalar));
  liquids.resize(num_drops + 1);
  return liquids;
}

ScalarCondition read_condition(Settings& settings, const std::string& table) {
  ScalarCondition condition;
  condition.kind = settings.choice(table + ".condition", words::scalar_conditions);
  if (condition.kind == Kind::value) {
    condition.value = settings.number(table + ".value");
    condition.gradient = settings.vector(table + ".gradient");
  }
  if (condition.kind == Kind::flux) condition.flux = settings.number(table + ".flux");
  return condition;
}

/// Throws InvalidInput when a tag of a surface file has no [[domain.patch]].
void require_known_tag(const Settings& settings, const DomainCase& domain,
                       const PatchPlace& patch) {
  std::vector<int> tags;
  for (const PatchCase& known : domain.patches) tags.push_back(known.tags.front());
  if (std::ranges::find(tags, patch.tags.front()) == tags.end())
    settings.reject(patch.path + ".tag", "is the tag of no [[domain.patch]]; their tags are {}",
                    fmt::join(tags, ", "));
}

std::vector<ScalarPatchCase> read_patches(Settings& settings, const DomainCase& domain,
                                          const std::string& scalar, bool is_species) {
  std::vector<ScalarPatchCase> patches;
  for (int i = 0; i < settings.count(scalar + ".patch"); ++i) {
    const std::string table = fmt::format("{}.patch[{}]", scalar, i);
    ScalarPatchCase patch{read_patch_place(settings, domain.shape, table)};
    if (domain.shape == DomainCase::Shape::file) require_known_tag(settings, domain, patch);
    for (const ScalarPatchCase& earlier : patches) require_apart(settings, patch, earlier);
    patch.condition = read_condition(settings, table);
    if (is_species && patch.condition.value < 0.0) reject_concentration(settings, table + ".value");
    patches.push_back(std::move(patch));
  }
  return patches;
}

/// Throws InvalidInput where nothing says which of the steady fields, equal but for a constant, is
/// meant.
void require_level(const Settings& settings, const ScalarCase& c) {
  const bool has_value = std::ranges::any_of(
      c.patches, [](const ScalarPatchCase& patch) { return patch.condition.kind == Kind::value; });
  if (c.scalar.peclet == 0.0 && !has_value)
    settings.reject(c.path + ".peclet",
                    "needs a [[scalar.patch]] with condition = \"value\": its level would be "
                    "unknown");
}

}  // namespace

std::vector<ScalarCase> read_scalars(Settings& settings, const DomainCase& domain,
                                     std::size_t num_drops) {
  std::vector<ScalarCase> scalars;
  for (int i = 0; i < settings.count("scalar"); ++i) {
    ScalarCase c{.path = fmt::format("scalar[{}]", i), .scalar = {}, .liquids = {}, .patches = {}};
    const std::string name = read_name(settings, c.path, scalars);
    c.scalar = read_scalar(settings, c.path);
    c.scalar.name = name;
    c.liquids = read_liquids(settings, c, num_drops);
    c.patches = read_patches(settings, domain, c.path, c.scalar.is_species);
    require_level(settings, c);
    scalars.push_back(std::move(c));
  }
  return scalars;
}

void read_adsorption(Settings& settings, const std::vector<ScalarCase>& scalars,
                     std::vector<DropCase>& drops) {
  for (std::size_t i = 0; i < drops.size(); ++i) {
    if (!drops[i].surfactant) continue;
    const std::string table = fmt::format("drop[{}].surfactant", i),
                      name = settings.text(table + ".species");
    if (name.empty()) continue;
    const auto found = std::ranges::find_if(
        scalars, [&](const ScalarCase& each) { return each.scalar.name == name; });
    if (found == scalars.end() || !found->scalar.is_species)
      settings.reject(table + ".species",
                      "must be the name of a [[scalar]] with kind = \"species\"");
    if (found->scalar.peclet == 0.0)
      settings.reject(table + ".species", "must have a peclet above 0: at 0 nothing is dissolved");
    drops[i].surfactant->adsorption = {.species = static_cast<int>(found - scalars.begin()),
                                       .biot = settings.number(table + ".biot"),
                                       .constant = settings.number(table + ".adsorption"),
                                       .depth = settings.number(table + ".depth")};
  }
}

void require_no_scalars(const Settings& settings) {
  if (settings.count("scalar") > 0)
    reject_input("{}: [[scalar]] needs method = \"finite-element\"", settings.source("scalar[0]"));
}

}  // namespace meniscus
