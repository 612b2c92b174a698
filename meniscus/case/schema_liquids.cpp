// The keys of the matrix and the drops.
#include "meniscus/case/schema_parts.hpp"
#include "meniscus/case/words.hpp"
#include "meniscus/surface/constants.hpp"

namespace meniscus::schema {
namespace {

using namespace std::string_literals;
using enum Type;

// 200 000: the meshes of docs/volume-mesh.md have up to 10 nodes per vertex of a drop. That means
// one to two million nodes. At an estimated 10 kB per node (tetrahedra, matrix, multigrid) they
// fill a machine of 24 GiB.
constexpr Range kDropNodes{.min = kFewestVertices, .max = 200000};

// Above 3 no liquid is known, and Newton's method has not been tried.
constexpr Range kPowerIndex{.min = 0.0, .max = 3.0, .open_min = true};
constexpr std::string_view kWithLaw = "with viscosity-law = \"carreau-yasuda\" or \"power-law\"";
constexpr std::string_view kWithCarreau = "with viscosity-law = \"carreau-yasuda\"";
constexpr std::string_view kWithPowerLaw = "with viscosity-law = \"power-law\"";
constexpr std::string_view kLawSentence =
    "Viscosity's factor: 1, r + (1 - r)(1 + (t g)^a)^((n - 1)/a), or g^(n - 1) within bounds. g = "
    "sqrt(2 D:D) is the rate of shear.";
constexpr std::string_view kIndexSentence = "n: below 1 the liquid thins, above it thickens.";
constexpr std::string_view kConstantSentence = "t: thinning begins at rates about 1/t.";
constexpr std::string_view kYasudaSentence = "a: how sharply; 2 is Carreau's law.";
constexpr std::string_view kInfiniteSentence = "r: viscosity at infinite rate over that at rest.";
constexpr std::string_view kFloorSentence = "Least factor of the power law.";
constexpr std::string_view kCeilingSentence = "Largest factor: a thinning liquid's at rest.";

constexpr std::string_view kShapeRequired = "required, or another shape";

const std::vector<Key> kLiquidKeys{
    {.path = "matrix.body-force",
     .type = vector,
     .dimension = Dimension::force_density,
     .range = kFinite,
     .value = Vec3(Vec3::Zero()),
     .sentence = "Force per volume on the matrix; only differences between liquids matter."},
    {.path = "matrix.viscosity-law",
     .type = word,
     .words = words::list(words::viscosity_laws),
     .value = "newtonian"s,
     .sentence = kLawSentence},
    {.path = "matrix.power-index",
     .range = kPowerIndex,
     .default_note = "required with such a law",
     .applies = kWithLaw,
     .sentence = kIndexSentence},
    {.path = "matrix.time-constant",
     .dimension = Dimension::time,
     .range = kPositive,
     .default_note = "required with carreau-yasuda",
     .applies = kWithCarreau,
     .sentence = kConstantSentence},
    {.path = "matrix.yasuda-exponent",
     .range = {.min = 0.0, .max = 10.0, .open_min = true},
     .value = 2.0,
     .applies = kWithCarreau,
     .sentence = kYasudaSentence},
    {.path = "matrix.infinite-shear-ratio",
     .range = {.min = 0.0, .max = 1.0},
     .value = 0.0,
     .applies = kWithCarreau,
     .sentence = kInfiniteSentence},
    {.path = "matrix.viscosity-floor",
     .range = {.min = 0.0, .max = 1.0, .open_min = true},
     .value = 1e-3,
     .applies = kWithPowerLaw,
     .sentence = kFloorSentence},
    {.path = "matrix.viscosity-ceiling",
     .range = {.min = 1.0, .max = 1e6},
     .value = 1e3,
     .applies = kWithPowerLaw,
     .sentence = kCeilingSentence},

    {.path = "drop[].center",
     .type = vector,
     .dimension = Dimension::length,
     .range = kPlace,
     .value = Vec3(Vec3::Zero()),
     .sentence = "Centre of a sphere or ellipsoid; shift of a surface."},
    {.path = "drop[].radius",
     .dimension = Dimension::length,
     .range = kLength,
     .default_note = kShapeRequired,
     .sentence = "Radius of a sphere."},
    {.path = "drop[].axes",
     .type = vector,
     .dimension = Dimension::length,
     .range = kLength,
     .default_note = kShapeRequired,
     .sentence = "Half-axes of an ellipsoid along x, y, z; ratio at most 1000."},
    {.path = "drop[].surface",
     .type = path,
     .default_note = kShapeRequired,
     .sentence = "A closed surface in one piece (stl, ply, obj, off, vtp, vtu), relative to the "
                 "case file."},
    {.path = "drop[].repair",
     .type = flag,
     .value = false,
     .applies = "with drop.surface",
     .sentence = "Mends that surface: stitches, fills holes up to a tenth of it, removes crossing "
                 "and doubled faces."},
    {.path = "drop[].from-run",
     .type = path,
     .default_note = kShapeRequired,
     .sentence = "Another run's folder: the shape in its newest checkpoint, with its volume."},
    {.path = "drop[].from-drop",
     .type = whole,
     .range = {.min = 0, .max = 1e9},
     .default_note = "the only drop of that run",
     .applies = "with from-run",
     .sentence = "Its id in drops.csv of that run."},
    {.path = "drop[].viscosity-ratio",
     .range = kPositive,
     .value = 1.0,
     .sentence = "lambda: viscosity over the matrix's; shear-dependent: at rest (carreau-yasuda), "
                 "at the rate G (power-law)."},
    {.path = "drop[].density-ratio",
     .range = kPositive,
     .value = 1.0,
     .applies = "with inertia (reynolds-number, scale.density) or gravity",
     .sentence = "Density over the matrix's."},
    {.path = "drop[].viscosity-law",
     .type = word,
     .words = words::list(words::viscosity_laws),
     .value = "newtonian"s,
     .sentence = kLawSentence},
    {.path = "drop[].power-index",
     .range = kPowerIndex,
     .default_note = "required with such a law",
     .applies = kWithLaw,
     .sentence = kIndexSentence},
    {.path = "drop[].time-constant",
     .dimension = Dimension::time,
     .range = kPositive,
     .default_note = "required with carreau-yasuda",
     .applies = kWithCarreau,
     .sentence = kConstantSentence},
    {.path = "drop[].yasuda-exponent",
     .range = {.min = 0.0, .max = 10.0, .open_min = true},
     .value = 2.0,
     .applies = kWithCarreau,
     .sentence = kYasudaSentence},
    {.path = "drop[].infinite-shear-ratio",
     .range = {.min = 0.0, .max = 1.0},
     .value = 0.0,
     .applies = kWithCarreau,
     .sentence = kInfiniteSentence},
    {.path = "drop[].viscosity-floor",
     .range = {.min = 0.0, .max = 1.0, .open_min = true},
     .value = 1e-3,
     .applies = kWithPowerLaw,
     .sentence = kFloorSentence},
    {.path = "drop[].viscosity-ceiling",
     .range = {.min = 1.0, .max = 1e6},
     .value = 1e3,
     .applies = kWithPowerLaw,
     .sentence = kCeilingSentence},
    {.path = "drop[].tension-ratio",
     .range = kNotNegative,
     .value = 1.0,
     .sentence = "Surface tension over the case's."},
    {.path = "drop[].nodes",
     .type = whole,
     .range = kDropNodes,
     .value = std::int64_t{110},
     .sentence = "N0, vertices as a sphere: C0 = N0/4π; other shapes get C0 ∮κ_rms² dS."},
    {.path = "drop[].body-force",
     .type = vector,
     .dimension = Dimension::force_density,
     .range = kFinite,
     .value = Vec3(Vec3::Zero()),
     .sentence = "Force per volume on the drop: it rises or settles."},

    {.path = "drop[].surfactant.equation-of-state",
     .type = word,
     .words = words::list(words::equations_of_state),
     .value = "linear"s,
     .sentence =
         "Relative tension: 1 - beta (Gamma - 1), or [1 + E ln(1 - X Gamma)]/[1 + E ln(1 - X)]."},
    {.path = "drop[].surfactant.elasticity",
     .range = kNotNegative,
     .default_note = "required",
     .sentence = "beta of the linear law, E of Langmuir's."},
    {.path = "drop[].surfactant.coverage",
     .range = {.min = 0.0, .max = 1.0, .open_min = true, .open_max = true},
     .default_note = "required with langmuir",
     .applies = "with equation-of-state = \"langmuir\"",
     .sentence = "X: initial concentration over close packing."},
    {.path = "drop[].surfactant.peclet",
     .range = {.min = 0.0, .open_min = true, .infinity = true},
     .value = std::numeric_limits<double>::infinity(),
     .sentence = "Pe_s = G R0²/D_s, quiescent: sigma R0/(mu_out D_s); inf: no surface diffusion."},
    {.path = "drop[].surfactant.species",
     .type = text,
     .value = ""s,
     .applies = "with method = \"finite-element\"",
     .sentence = "Its [[scalar]] of kind \"species\" in the liquid outside; empty: insoluble. "
                 "Gamma gains j = Bi [K c (1 - X Gamma) - Gamma], the liquid loses delta j."},
    {.path = "drop[].surfactant.biot",
     .range = kPositive,
     .default_note = "required with species",
     .applies = "with species",
     .sentence = "Bi: rate of desorption over G."},
    {.path = "drop[].surfactant.adsorption",
     .range = kPositive,
     .default_note = "required with species",
     .applies = "with species",
     .sentence = "K: Gamma over c in equilibrium at small Gamma."},
    {.path = "drop[].surfactant.depth",
     .range = kPositive,
     .default_note = "required with species",
     .applies = "with species",
     .sentence = "delta: unit of Gamma over that of c and R0."},
};

}  // namespace

std::span<const Key> liquid_keys() { return kLiquidKeys; }

}  // namespace meniscus::schema
