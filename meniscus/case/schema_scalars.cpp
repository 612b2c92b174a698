// The keys of bulk scalars.
#include "meniscus/case/schema_parts.hpp"
#include "meniscus/case/words.hpp"

namespace meniscus::schema {
namespace {

using namespace std::string_literals;
using enum Type;

constexpr std::string_view kOfHeat = "with kind = \"heat\"";
constexpr std::string_view kOfSpecies = "with kind = \"species\"";
constexpr std::string_view kWithHistory = "with peclet > 0";
constexpr std::string_view kWithSpot = "with peclet > 0 and a spot-height";
constexpr std::string_view kWithValue = "with condition = \"value\"";
constexpr std::string_view kSpotSentence =
    "Adds spot-height exp(-d²/(2 spot-width²)), d the distance from spot-center.";

const std::vector<Key> kScalarKeys{
    {.path = "scalar[].name",
     .type = text,
     .default_note = "required",
     .sentence =
         "Name in frames and tables: a letter, then letters, digits and _; not one in use."},
    {.path = "scalar[].kind",
     .type = word,
     .words = words::list(words::scalar_kinds),
     .value = "heat"s,
     .sentence = "heat: T is the temperature; species: the matrix's concentration in equilibrium, "
                 "a liquid's over its partition."},
    {.path = "scalar[].peclet",
     .range = {.min = 0.0, .infinity = true},
     .default_note = "required",
     .sentence = "Pe = G R0²/D of the matrix, quiescent: sigma R0/(mu_out D). 0: conducts at once, "
                 "with a value at a patch. inf: never."},
    {.path = "scalar[].convection",
     .type = flag,
     .value = true,
     .applies = kWithHistory,
     .sentence = "Whether the flow carries it."},
    {.path = "scalar[].brinkman",
     .range = kNotNegative,
     .value = 0.0,
     .applies = kOfHeat,
     .sentence = "Heating by dissipation, Br = mu_out (G R0)²/(k_out · unit of T), k_out the "
                 "matrix's conductivity."},
    {.path = "scalar[].initial",
     .value = 0.0,
     .applies = kWithHistory,
     .sentence = "First value in the matrix, at the origin."},
    {.path = "scalar[].initial-gradient",
     .type = vector,
     .value = Vec3(Vec3::Zero()),
     .applies = kWithHistory,
     .sentence = "Gradient of that value, per R0."},
    {.path = "scalar[].spot-height",
     .value = 0.0,
     .applies = kWithHistory,
     .sentence = kSpotSentence},
    {.path = "scalar[].spot-center",
     .type = vector,
     .range = kPlace,
     .value = Vec3(Vec3::Zero()),
     .applies = kWithSpot,
     .sentence = "Centre of the spot from the origin, in R0."},
    {.path = "scalar[].spot-width",
     .range = kPositive,
     .value = 1.0,
     .applies = kWithSpot,
     .sentence = "Width of the spot, in R0."},
    {.path = "scalar[].source",
     .value = 0.0,
     .sentence = "q in the matrix, per volume and time, in G; 0 with peclet = 0."},
    {.path = "scalar[].reference",
     .value = 0.0,
     .sentence = "The value without effect on the flow."},
    {.path = "scalar[].tension-slope",
     .value = 0.0,
     .sentence = "Surface tension times 1 + tension-slope (T - reference)."},
    {.path = "scalar[].buoyancy",
     .type = vector,
     .value = Vec3(Vec3::Zero()),
     .sentence = "Force per volume by T - reference, in mu_out G/R0."},
    {.path = "scalar[].viscosity-exponent",
     .value = 0.0,
     .sentence = "Viscosities times exp(-viscosity-exponent (T - reference))."},

    {.path = "scalar[].drop[].conductivity-ratio",
     .range = kPositive,
     .value = 1.0,
     .applies = kOfHeat,
     .sentence = "Conductivity over the matrix's."},
    {.path = "scalar[].drop[].diffusivity-ratio",
     .range = kPositive,
     .value = 1.0,
     .sentence = "Diffusivity over the matrix's; of heat, conductivity over capacity."},
    {.path = "scalar[].drop[].partition",
     .range = kPositive,
     .value = 1.0,
     .applies = kOfSpecies,
     .sentence = "Concentration over the matrix's, in equilibrium."},
    {.path = "scalar[].drop[].initial",
     .value = 0.0,
     .applies = kWithHistory,
     .sentence = "First value in the drop, at the origin; of a species the concentration."},
    {.path = "scalar[].drop[].initial-gradient",
     .type = vector,
     .value = Vec3(Vec3::Zero()),
     .applies = kWithHistory,
     .sentence = "Gradient of that value, per R0."},
    {.path = "scalar[].drop[].spot-height",
     .value = 0.0,
     .applies = kWithHistory,
     .sentence = kSpotSentence},
    {.path = "scalar[].drop[].spot-center",
     .type = vector,
     .range = kPlace,
     .value = Vec3(Vec3::Zero()),
     .applies = kWithSpot,
     .sentence = "Centre of the spot from the origin, in R0."},
    {.path = "scalar[].drop[].spot-width",
     .range = kPositive,
     .value = 1.0,
     .applies = kWithSpot,
     .sentence = "Width of the spot, in R0."},
    {.path = "scalar[].drop[].source", .value = 0.0, .sentence = "q in the drop, likewise."},

    {.path = "scalar[].patch[].name",
     .type = text,
     .default_note = "required for a shape; a label for a tag",
     .sentence = "The patch, as at [[domain.patch]]."},
    {.path = "scalar[].patch[].tag",
     .type = whole,
     .range = {.min = 0, .max = 1e9},
     .default_note = "required for a surface",
     .applies = "with domain.surface",
     .sentence = "The faces' tag, as in domain.surface."},
    {.path = "scalar[].patch[].condition",
     .type = word,
     .words = words::list(words::scalar_conditions),
     .default_note = "required",
     .sentence =
         "none: no conduction through it; value: T is given; flux: conduction inwards is given."},
    {.path = "scalar[].patch[].value",
     .value = 0.0,
     .applies = kWithValue,
     .sentence = "T on the patch, at the origin."},
    {.path = "scalar[].patch[].gradient",
     .type = vector,
     .value = Vec3(Vec3::Zero()),
     .applies = kWithValue,
     .sentence = "Gradient of that value, per R0."},
    {.path = "scalar[].patch[].flux",
     .value = 0.0,
     .applies = "with condition = \"flux\"",
     .sentence = "K dT/dn, n out of the domain, per R0."},
};

}  // namespace

std::span<const Key> scalar_keys() { return kScalarKeys; }

}  // namespace meniscus::schema
