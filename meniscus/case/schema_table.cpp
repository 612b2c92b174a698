// The table of all keys of the case file, from which every text about a key is made.
#include "meniscus/case/schema.hpp"
#include "meniscus/case/words.hpp"
#include "meniscus/surface/constants.hpp"

namespace meniscus::schema {
namespace {

using namespace std::string_literals;
using enum Type;

constexpr Range kPositive{.min = 0.0, .open_min = true};
constexpr Range kNotNegative{.min = 0.0};
constexpr Range kFinite{};
// A drop a million times smaller or larger than R0, or as far away, is a mistake, and beyond
// meshing in double precision.
constexpr Range kLength{.min = 1e-6, .max = 1e6};
constexpr Range kPlace{.min = -1e6, .max = 1e6};
// 200 000 and 20 000: the meshes of docs/volume-mesh.md have up to 10 nodes per vertex of a drop,
// and 20 per vertex of a boundary of 2007 vertices, growing as their power 3/2. Each bound means
// one to two million nodes. At an estimated 10 kB per node (tetrahedra, matrix, multigrid) they
// fill a machine of 24 GiB.
constexpr Range kDropNodes{.min = kFewestVertices, .max = 200000};
constexpr Range kBoundaryNodes{.min = 50, .max = 20000};
constexpr Range kCount{.min = 1, .max = 1e9};
constexpr Range kCountOrNone{.min = 0, .max = 1e9};
constexpr std::string_view kWithElements = "with method = \"finite-element\"";
constexpr std::string_view kWithIntegrals = "with method = \"boundary-integral\"";

// Above 3 no liquid is known, and Newton's method has not been tried.
constexpr Range kPowerIndex{.min = 0.0, .max = 3.0, .open_min = true};
constexpr std::string_view kWithLaw = "with viscosity-law = \"carreau-yasuda\" or \"power-law\"";
constexpr std::string_view kWithCarreau = "with viscosity-law = \"carreau-yasuda\"";
constexpr std::string_view kWithPowerLaw = "with viscosity-law = \"power-law\"";
constexpr std::string_view kLawSentence =
    "How the viscosity depends on the rate of shear g = sqrt(2 D:D): it is the liquid's own "
    "(viscosity-ratio of a drop, 1 of the matrix) times 1, or r + (1 - r) (1 + (t g)^a)^((n - "
    "1)/a), or g^(n - 1) between a floor and a ceiling.";
constexpr std::string_view kIndexSentence =
    "n: below 1 the liquid thins with shear, above 1 it "
    "thickens.";
constexpr std::string_view kConstantSentence = "t: the liquid begins to thin at rates about 1/t.";
constexpr std::string_view kYasudaSentence = "a: how sharply; 2 is Carreau's law.";
constexpr std::string_view kInfiniteSentence = "r: viscosity at infinite rate over that at rest.";
constexpr std::string_view kFloorSentence =
    "The least that the power law may multiply the liquid's viscosity by.";
constexpr std::string_view kCeilingSentence = "The most: what a thinning liquid has at rest.";

constexpr std::string_view kShapeRequired = "required: one of radius, axes, surface, from-run";

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
    {"interface", false, "How interfaces are represented, moved and remeshed."},
    {"topology", false, "Breakup and coalescence."},
    {"solver", false, "How the flow is solved."},
    {"time", false,
     "Time stepping. Steps are never clipped to the end or to output times. A step that fails, or "
     "that changes the interfaces' energy as the flow does not, is tried again at half its "
     "length."},
    {"output", false, "What a run writes, and when."},
    {"scale", false,
     "With this table every key that has a unit is given in SI units, coordinates in surface files "
     "included, and is converted once, when the case is read: lengths by `length` (R0), times by "
     "1/`rate` (1/G), and the capillary number is viscosity · rate · length / surface-tension. All "
     "results stay dimensionless. The run of a from-run is dimensionless already."},
};

const std::vector<Key> kKeys{
    {.path = "title",
     .type = text,
     .value = ""s,
     .sentence = "What the case is, for the report and the progress display. On the command line: "
                 "--set 'title=Two drops'."},

    {.path = "flow.kind",
     .type = word,
     .words = words::list(words::flow_kinds),
     .default_note = "required, or gradient",
     .sentence = "The imposed flow: v = (y, 0, 0), (x, -y/2, -z/2), (x, -y, 0) or 0. It decides, "
                 "whatever a schedule does later, how L, B and W are measured and the default "
                 "conditions on a box."},
    {.path = "flow.gradient",
     .type = matrix,
     .dimension = Dimension::rate,
     .range = kFinite,
     .default_note = "required, or kind",
     .sentence = "The velocity gradient G of a general flow v = G·x, row by row; its trace is 0."},
    {.path = "flow.capillary-number",
     .range = {.min = 0.0, .open_min = true, .infinity = true},
     .value = 1.0,
     .applies = "without [scale]",
     .sentence =
         "Ca = mu_out G R0/sigma; inf: no surface tension. 1 or inf where neither the flow nor "
         "a patch sets a rate: then times are in mu_out R0/sigma."},

    {.path = "flow.schedule[].time",
     .dimension = Dimension::time,
     .range = kNotNegative,
     .default_note = "required",
     .sentence = "When the entry begins to hold."},
    {.path = "flow.schedule[].kind",
     .type = word,
     .words = words::list(words::flow_kinds),
     .default_note = "the flow the case begins with",
     .sentence = "The flow from then on."},
    {.path = "flow.schedule[].gradient",
     .type = matrix,
     .dimension = Dimension::rate,
     .range = kFinite,
     .default_note = "the flow the case begins with",
     .sentence = "Its velocity gradient, instead of a kind; trace 0."},
    {.path = "flow.schedule[].factor",
     .range = kFinite,
     .value = 1.0,
     .sentence = "Multiplies the gradient: 0 stops, -1 reverses the flow."},
    {.path = "flow.schedule[].ramp",
     .dimension = Dimension::time,
     .range = kNotNegative,
     .value = 0.0,
     .sentence = "Time over which the gradient passes linearly from the one before; 0: at once."},

    {.path = "matrix.body-force",
     .type = vector,
     .dimension = Dimension::force_density,
     .range = kFinite,
     .value = Vec3(Vec3::Zero()),
     .sentence = "Uniform force per volume on the liquid around the drops. Only its difference "
                 "from that of a drop moves anything."},
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
     .sentence = "Centre of the sphere or ellipsoid; a surface from a file or a run is shifted by "
                 "it."},
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
     .sentence = "Half-axes of an ellipsoid, along x, y and z; the longest at most 1000 times the "
                 "shortest."},
    {.path = "drop[].surface",
     .type = path,
     .default_note = kShapeRequired,
     .sentence = "A closed triangulated surface in one piece, faces outward (stl, ply, obj, off, "
                 "vtp); from the "
                 "case file's folder if relative."},
    {.path = "drop[].from-run",
     .type = path,
     .default_note = kShapeRequired,
     .sentence = "The folder of another run: the shape in its newest checkpoint."},
    {.path = "drop[].from-drop",
     .type = whole,
     .range = {.min = 0, .max = 1e9},
     .default_note = "the only drop of that run",
     .applies = "with from-run",
     .sentence = "Which drop of the other run, by its id in drops.csv."},
    {.path = "drop[].viscosity-ratio",
     .range = kPositive,
     .value = 1.0,
     .sentence = "lambda: the drop's viscosity over the matrix's; where one depends on the rate of "
                 "shear, that at rest (carreau-yasuda) or at the rate G (power-law)."},
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
     .sentence = "This drop's surface tension over the case's."},
    {.path = "drop[].nodes",
     .type = whole,
     .range = kDropNodes,
     .value = std::int64_t{110},
     .sentence = "N0, the vertices on the drop were it a sphere: sets C0 = N0/4π; any other shape "
                 "gets C0 ∮κ_rms² dS vertices."},
    {.path = "drop[].body-force",
     .type = vector,
     .dimension = Dimension::force_density,
     .range = kFinite,
     .value = Vec3(Vec3::Zero()),
     .sentence = "Uniform force per volume on the liquid of the drop: makes it rise or settle."},

    {.path = "drop[].surfactant.equation-of-state",
     .type = word,
     .words = words::list(words::equations_of_state),
     .value = "linear"s,
     .sentence = "Tension over that at Gamma = 1: 1 - beta (Gamma - 1), or [1 + E ln(1 - X Gamma)]"
                 "/[1 + E ln(1 - X)]."},
    {.path = "drop[].surfactant.elasticity",
     .range = kNotNegative,
     .default_note = "required",
     .sentence = "beta of the linear law, E of Langmuir's."},
    {.path = "drop[].surfactant.coverage",
     .range = {.min = 0.0, .max = 1.0, .open_min = true, .open_max = true},
     .default_note = "required with langmuir",
     .applies = "with equation-of-state = \"langmuir\"",
     .sentence = "X: the initial concentration over that of close packing."},
    {.path = "drop[].surfactant.peclet",
     .range = {.min = 0.0, .open_min = true, .infinity = true},
     .value = std::numeric_limits<double>::infinity(),
     .sentence = "Pe_s = G R0²/D_s, in quiescent cases sigma R0/(mu_out D_s): convection along the "
                 "surface over diffusion; inf: no diffusion."},

    {.path = "domain.shape",
     .type = word,
     .words = words::list(words::domain_shapes),
     .value = "box"s,
     .applies = "without surface",
     .sentence = "Shape of the outer boundary; a cylinder lies along x. \"unbounded\", with "
                 "method = \"boundary-integral\" and only there: no boundary."},
    {.path = "domain.half-width",
     .dimension = Dimension::length,
     .range = kLength,
     .value = 10.0,
     .applies = "with shape = \"box\", without half-widths",
     .sentence = "Distance of the box's faces from the origin."},
    {.path = "domain.half-widths",
     .type = vector,
     .dimension = Dimension::length,
     .range = kLength,
     .default_note = "half-width in every direction",
     .applies = "with shape = \"box\"",
     .sentence = "The same for the x-, y- and z-faces."},
    {.path = "domain.radius",
     .dimension = Dimension::length,
     .range = kLength,
     .value = 10.0,
     .applies = "with shape = \"sphere\" or \"cylinder\"",
     .sentence = "Radius of the sphere or cylinder."},
    {.path = "domain.half-length",
     .dimension = Dimension::length,
     .range = kLength,
     .value = 10.0,
     .applies = "with shape = \"cylinder\"",
     .sentence = "Half the length of the cylinder."},
    {.path = "domain.surface",
     .type = path,
     .default_note = "none: the boundary is a shape",
     .sentence = "A closed triangulated surface in one piece, faces outward, as the outer boundary "
                 "(stl, ply, obj, off, vtp). Its faces have tags: in vtp the whole numbers of the "
                 "cell array `patch`; in obj the groups (g), numbered 0, 1, 2, … in the order in "
                 "which they first get a face, whatever their names; in ascii stl the solids, "
                 "numbered 0, 1, 2, … as they stand in the file; in any other file all are 0."},
    {.path = "domain.nodes",
     .type = whole,
     .range = kBoundaryNodes,
     .value = std::int64_t{507},
     .applies = "without surface",
     .sentence = "About how many vertices the outer boundary has."},
    {.path = "domain.grading",
     .type = word,
     .words = words::list(words::gradings),
     .value = "linear"s,
     .applies = kWithElements,
     .sentence =
         "How element size passes from one surface's resolution to another's (P2-P1 elements "
         "take gaussian unless told otherwise)."},
    {.path = "domain.cell-volume",
     .type = number,
     .range = {.min = 0.1, .max = 100.0},
     .default_note = "2.0; 1.5 with P2-P1 elements",
     .applies = kWithElements,
     .sentence =
         "A tetrahedron is divided while its volume exceeds this many times that of the regular "
         "one of the wanted edge: halving it doubles the nodes between the surfaces."},
    {.path = "domain.interior-growth",
     .range = {.min = 0.0, .max = 10.0},
     .value = 0.5,
     .applies = kWithElements,
     .sentence = "How fast the size of tetrahedra grows with the distance from the surface, inside "
                 "a drop and wherever no farther surface bounds the liquid; 0: not at all."},
    {.path = "domain.radius-edge",
     .range = {.min = 1.1, .max = 10.0},
     .value = 1.4,
     .applies = kWithElements,
     .sentence = "TetGen's bound on a tetrahedron's circumradius over its shortest edge: lower "
                 "bounds give rounder tetrahedra and more of them."},
    {.path = "domain.frame",
     .type = word,
     .words = words::list(words::domain_frames),
     .value = "fixed"s,
     .sentence = "drops: the domain and the imposed flow move along with the drops, whose common "
                 "centroid stays where it was at the start, as experiments hold a drop at a "
                 "stagnation point; an extensional flow carries it away otherwise."},

    {.path = "domain.patch[].name",
     .type = text,
     .default_note = "required for a shape; a label for a tag",
     .sentence = "The patch of the shape, as listed above."},
    {.path = "domain.patch[].tag",
     .type = whole,
     .range = {.min = 0, .max = 1e9},
     .default_note = "required for a surface",
     .applies = "with domain.surface",
     .sentence =
         "The tag of the patch's faces in the surface file: a number, as said at domain.surface."},
    {.path = "domain.patch[].condition",
     .type = word,
     .words = words::list(words::conditions),
     .value = "velocity"s,
     .sentence = "velocity: v is given; symmetry (of a flat patch): no flow through it and no "
                 "tangential traction; "
                 "open: the traction is given."},
    {.path = "domain.patch[].velocity",
     .type = velocity,
     .dimension = Dimension::velocity,
     .range = kFinite,
     .words = {"flow"},
     .value = "flow"s,
     .applies = "with condition = \"velocity\"",
     .sentence =
         "\"flow\": v = G·x of the imposed flow, schedule included; or a constant velocity, "
         "[0, 0, 0] for a wall."},
    {.path = "domain.patch[].profile",
     .type = word,
     .words = words::list(words::profiles),
     .value = "uniform"s,
     .applies = "with a velocity of three numbers",
     .sentence =
         "parabolic: velocity · max(0, 1 - d²/a²), d the distance from profile-center and a "
         "the profile-radius: the fully developed flow in a round pipe, velocity its "
         "peak."},
    {.path = "domain.patch[].profile-center",
     .type = vector,
     .dimension = Dimension::length,
     .range = kPlace,
     .default_note = "the patch's centroid",
     .applies = "with profile = \"parabolic\"",
     .sentence = "Centre of the parabola."},
    {.path = "domain.patch[].profile-radius",
     .dimension = Dimension::length,
     .range = kLength,
     .default_note = "the patch's largest distance from there",
     .applies = "with profile = \"parabolic\"",
     .sentence = "Distance from its centre at which the parabola is zero."},
    {.path = "domain.patch[].traction",
     .type = vector,
     .dimension = Dimension::stress,
     .range = kFinite,
     .value = Vec3(Vec3::Zero()),
     .applies = "with condition = \"open\"",
     .sentence = "T·n on an open patch, n out of the domain; a pressure p is -p n."},

    {.path = "interface.surface-tension",
     .type = word,
     .words = words::list(words::capillary_forms),
     .value = "weak"s,
     .applies = kWithElements,
     .sentence = "Form of the capillary force: weak (integrated by parts, the paper's eq. 15), "
                 "nodal (curvature of a paraboloid fit, eqs 16-17), balanced (no flow for constant "
                 "curvature)."},
    {.path = "interface.motion-normal",
     .type = word,
     .words = words::list(words::motion_normals),
     .value = "area-vector"s,
     .sentence = "Normal along which vertices move: area-vector keeps the volume's rate of change "
                 "at round-off, fit is the paper's paraboloid, smooth that of the fitted surface "
                 "(boundary integrals take it unless told otherwise), faces the same with speeds "
                 "that follow the liquid in the mean over curved faces (P2-P1 elements do)."},
    {.path = "interface.volume-motion",
     .type = word,
     .words = words::list(words::volume_motions),
     .value = "spines"s,
     .applies = kWithElements,
     .sentence = "How the vertices between the surfaces follow: along rays from the drop's centre "
                 "(harmonic where a drop is not star-shaped or there are several), with the "
                 "liquid, or by harmonic extension."},
    {.path = "interface.remesh-every",
     .type = whole,
     .range = kCountOrNone,
     .default_note = "0; 1 with time.control = \"paper\"",
     .sentence =
         "Steps from one remeshing of the interfaces to the next: 3 remeshes at the end of steps "
         "3, 6, 9; in between vertices only move, and volumes are restored. 0 remeshes when edges "
         "or the density of vertices leave their range, and keeps the tetrahedra until then."},
    {.path = "interface.equilibrium",
     .range = {.min = 0.0, .max = 0.99},
     .value = 0.0,
     .sentence = "Remeshing slides the vertices over the surface until each is within this "
                 "fraction of its wanted edge of where springs would have it; 0: 0.006, less above "
                 "1000 nodes; with 0.9 next to none slides."},
    {.path = "interface.edge-floor",
     .dimension = Dimension::length,
     .range = {.min = 0.0, .max = 1e6},
     .default_note = "half of topology.breakup-radius",
     .sentence =
         "No interface edge is asked to be shorter, however curved the interface. A floor above "
         "half the edge length with which a drop has 42 vertices is lowered to that, for "
         "this drop."},
    {.path = "interface.neck-edges",
     .type = whole,
     .range = {.min = 0, .max = 100},
     .default_note = "15 with P2-P1; 0 without",
     .sentence = "Edges asked for around a neck or a thread, however thin, down to the edge floor; "
                 "0: as many as nodes gives."},
    {.path = "interface.gap-layers",
     .type = whole,
     .range = {.min = 0, .max = 100},
     .value = std::int64_t{3},
     .sentence =
         "Layers of tetrahedra asked for where an interface is close to another one, to the outer "
         "boundary or to a sheet of its own, down to the edge floor; 0: gaps are not refined."},

    {.path = "topology.breakup-radius",
     .dimension = Dimension::length,
     .range = kNotNegative,
     .value = 0.01,
     .sentence = "A thinning neck below this radius (its perimeter over 2 pi) is cut; 0: never."},
    {.path = "topology.coalescence",
     .type = word,
     .words = words::list(words::on_off),
     .value = "on"s,
     .sentence = "Whether interfaces that come close merge, and liquid films rupture; off refuses "
                 "any step that would make drops touch."},
    {.path = "topology.coalescence-gap",
     .dimension = Dimension::length,
     .range = kNotNegative,
     .value = 0.01,
     .sentence = "The gap below which interfaces that approach each other merge; 0: never. Twice "
                 "the edge floor or more."},

    {.path = "solver.method",
     .type = word,
     .words = words::list(words::methods),
     .value = "finite-element"s,
     .sentence = "How the Stokes flow is found: by elements that fill the domain, or by integrals "
                 "over the interfaces alone, in an unbounded domain."},
    {.path = "solver.threads",
     .type = whole,
     .range = kCount,
     .value = std::int64_t{1},
     .applies = kWithIntegrals,
     .sentence = "Threads that share the sums; the results do not depend on it."},
    {.path = "solver.elements",
     .type = word,
     .words = words::list(words::elements),
     .default_note =
         "\"P2-P1\"; \"P1-P1\" with surface-tension = \"nodal\" or linear = \"paper-gmres\"",
     .applies = kWithElements,
     .sentence =
         "P2-P1: quadratic velocity, linear pressure, curved at interfaces and round walls; a "
         "drop's volume is then that of the curved surface. P1-P1: linear velocity and pressure, "
         "pressure-stabilised, as in the paper."},
    {.path = "solver.linear",
     .type = word,
     .words = words::list(words::linear_solvers),
     .value = "block"s,
     .applies = kWithElements,
     .sentence = "Linear solver: block-preconditioned FGMRES, the paper's scaled GMRES, "
                 "block-diagonal MINRES, or direct."},
    {.path = "solver.rtol",
     .range = {.min = 0.0, .max = 0.1, .open_min = true},
     .value = 1e-6,
     .sentence = "Relative residual of the linear solve, however far the walls are; 1e-6 leaves "
                 "2.5e-5 in the rate of deformation."},
    {.path = "solver.max-iterations",
     .type = whole,
     .range = kCount,
     .value = std::int64_t{2000},
     .sentence = "Linear iterations after which a solve has failed."},
    {.path = "solver.petsc-options",
     .type = text,
     .value = ""s,
     .applies = kWithElements,
     .sentence = "Further options for PETSc, as on its command line: \"-name value -name …\"."},

    {.path = "time.scheme",
     .type = word,
     .words = words::list(words::time_schemes),
     .default_note = "\"semi-implicit\"; \"rk2\" with control = \"paper\"",
     .sentence = "Midpoint Runge-Kutta (the paper's eq. 22), explicit Euler (eq. 21); the midpoint "
                 "rule with surface tension damped so that long steps are stable; or "
                 "Runge-Kutta-Chebyshev: of second order too, with as many solves of "
                 "the flow, 3 to 24, as make the step stable."},
    {.path = "time.end",
     .dimension = Dimension::time,
     .range = kNotNegative,
     .value = 10.0,
     .sentence = "The run stops at the first step at or past this time."},
    {.path = "time.control",
     .type = word,
     .words = words::list(words::step_controls),
     .default_note = "\"paper\" with step-factor, step-edges or \"euler\", else \"error\"",
     .sentence =
         "What sets the length of steps: the paper's rule, or an estimate of the error with "
         "bounds from stability, from the flow along the interface, from the motion of "
         "vertices and from necks."},
    {.path = "time.tolerance",
     .range = {.min = 0.0, .max = 1.0, .open_min = true},
     .value = kDefaultTolerance,
     .applies = "with control = \"error\"",
     .sentence = "Largest estimated error of a step at any vertex, over the shortest edge there. "
                 "The error at a given time is proportional to it, and far smaller."},
    {.path = "time.step-factor",
     .range = {.min = 0.0, .max = 10.0, .open_min = true},
     .value = 0.5,
     .applies = "with control = \"paper\"",
     .sentence = "dt = step-factor · min(1, Ca) · (shortest edge): the paper's eq. 27."},
    {.path = "time.step-edges",
     .type = word,
     .words = words::list(words::step_edges),
     .value = "interface"s,
     .applies = "with control = \"paper\"",
     .sentence = "Where the shortest edge is looked for; mesh is the paper's."},
    {.path = "time.max-step",
     .dimension = Dimension::time,
     .range = kPositive,
     .default_note = "1; 0.1 with control = \"paper\"",
     .sentence = "No step is longer."},
    {.path = "time.min-step",
     .dimension = Dimension::time,
     .range = kPositive,
     .value = 1e-6,
     .sentence = "A step that fails at this size ends the run; at most max-step."},

    {.path = "output.interval",
     .dimension = Dimension::time,
     .range = kPositive,
     .value = 0.2,
     .sentence = "Time between two surfaces written for viewing (at the first step past each "
                 "multiple)."},
    {.path = "output.volume",
     .type = flag,
     .value = true,
     .sentence = "Whether volume meshes with velocity and pressure are written too, where there "
                 "are any."},
    {.path = "output.volume-interval",
     .dimension = Dimension::time,
     .range = kPositive,
     .default_note = "output.interval",
     .applies = "with volume = true, where there are volume meshes",
     .sentence = "Time between two volume meshes."},
    {.path = "output.checkpoint-every",
     .type = whole,
     .range = kCount,
     .value = std::int64_t{10},
     .sentence = "Steps from one checkpoint to the next; the last two are kept."},

    {.path = "scale.length",
     .range = kPositive,
     .default_note = "required with [scale]",
     .sentence = "R0 in metres."},
    {.path = "scale.viscosity",
     .range = kPositive,
     .default_note = "required with [scale]",
     .sentence = "mu_out in pascal seconds."},
    {.path = "scale.surface-tension",
     .range = kNotNegative,
     .default_note = "required with [scale]",
     .sentence = "sigma in newtons per metre; 0: none."},
    {.path = "scale.rate",
     .range = kPositive,
     .default_note = "required with [scale]; surface-tension/(viscosity · length) in a quiescent "
                     "flow",
     .sentence = "G per second, the rate of shear or strain; a kind of flow has this rate."},
};

}  // namespace

std::span<const Table> tables() { return kTables; }
std::span<const Key> keys() { return kKeys; }

}  // namespace meniscus::schema
