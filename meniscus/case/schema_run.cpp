// The keys of how a case is run: interfaces, solver, time, output, and of its units.
#include "meniscus/case/schema_parts.hpp"
#include "meniscus/case/words.hpp"

namespace meniscus::schema {
namespace {

using namespace std::string_literals;
using enum Type;

constexpr Range kCount{.min = 1, .max = 1e9};
constexpr Range kCountOrNone{.min = 0, .max = 1e9};
constexpr std::string_view kWithIntegrals = "with method = \"boundary-integral\"";

const std::vector<Key> kRunKeys{
    {.path = "interface.surface-tension",
     .type = word,
     .words = words::list(words::capillary_forms),
     .value = "weak"s,
     .applies = kWithElements,
     .sentence = "Capillary force: weak (by parts, the paper's eq. 15), nodal (curvature of a "
                 "paraboloid, eqs 16-17), balanced (no flow for constant curvature)."},
    {.path = "interface.motion-normal",
     .type = word,
     .words = words::list(words::motion_normals),
     .value = "area-vector"s,
     .sentence = "Normal of the vertices' motion: area-vector (volume's rate at round-off), fit "
                 "(the paper's paraboloid), smooth (fitted surface; boundary integrals), faces "
                 "(speeds in the mean over curved faces; P2-P1)."},
    {.path = "interface.volume-motion",
     .type = word,
     .words = words::list(words::volume_motions),
     .value = "spines"s,
     .applies = kWithElements,
     .sentence = "How inner vertices follow: along rays from the drop's centre (harmonic if not "
                 "star-shaped or several drops), with the liquid, or by harmonic extension."},
    {.path = "interface.remesh-every",
     .type = whole,
     .range = kCountOrNone,
     .default_note = "0; 1 with time.control = \"paper\"",
     .sentence = "Steps between remeshings of the interfaces. 0: where edges or the density of "
                 "vertices leave their range; tetrahedra are kept until then."},
    {.path = "interface.equilibrium",
     .range = {.min = 0.0, .max = 0.99},
     .value = 0.0,
     .sentence = "Remeshing slides vertices until within this fraction of an edge from where "
                 "springs rest; 0: 0.006, less above 1000 nodes."},
    {.path = "interface.edge-floor",
     .dimension = Dimension::length,
     .range = {.min = 0.0, .max = 1e6},
     .default_note = "half of topology.breakup-radius",
     .sentence =
         "Shortest edge asked for; at most half of that with which a drop has 42 vertices."},
    {.path = "interface.neck-edges",
     .type = whole,
     .range = {.min = 0, .max = 100},
     .default_note = "15 with P2-P1; 0 without",
     .sentence = "Edges around a neck or thread, down to the edge floor; 0: as nodes gives."},
    {.path = "interface.gap-layers",
     .type = whole,
     .range = {.min = 0, .max = 100},
     .value = std::int64_t{3},
     .sentence =
         "Layers of tetrahedra in narrow gaps, down to the edge floor; 0: gaps are not refined."},

    {.path = "topology.breakup-radius",
     .dimension = Dimension::length,
     .range = kNotNegative,
     .value = 0.01,
     .sentence = "A thinning neck below this radius (perimeter over 2 pi) is cut; 0: never."},
    {.path = "topology.coalescence",
     .type = word,
     .words = words::list(words::on_off),
     .value = "on"s,
     .sentence = "Whether close interfaces merge and films rupture; off refuses steps that make "
                 "drops touch."},
    {.path = "topology.coalescence-gap",
     .dimension = Dimension::length,
     .range = kNotNegative,
     .value = 0.01,
     .sentence =
         "Gap below which approaching interfaces merge; 0: never. At least twice the edge floor."},

    {.path = "solver.method",
     .type = word,
     .words = words::list(words::methods),
     .value = "finite-element"s,
     .sentence =
         "Elements that fill the domain, or integrals over the interfaces of an unbounded one."},
    {.path = "solver.threads",
     .type = whole,
     .range = kCount,
     .value = std::int64_t{1},
     .applies = kWithIntegrals,
     .sentence = "Threads that share the sums, with the same results."},
    {.path = "solver.elements",
     .type = word,
     .words = words::list(words::elements),
     .default_note =
         "\"P2-P1\"; \"P1-P1\" with surface-tension = \"nodal\" or linear = \"paper-gmres\"",
     .applies = kWithElements,
     .sentence = "P2-P1: quadratic velocity, linear pressure, curved at interfaces and round "
                 "walls. P1-P1: both linear, pressure-stabilised, as in the paper."},
    {.path = "solver.linear",
     .type = word,
     .words = words::list(words::linear_solvers),
     .value = "block"s,
     .applies = kWithElements,
     .sentence = "Block-preconditioned FGMRES, the paper's scaled GMRES, block-diagonal MINRES, or "
                 "direct."},
    {.path = "solver.rtol",
     .range = {.min = 0.0, .max = 0.1, .open_min = true},
     .value = 1e-6,
     .sentence =
         "Relative residual of the linear solve; 1e-6 leaves 2.5e-5 in the rate of deformation."},
    {.path = "solver.max-iterations",
     .type = whole,
     .range = kCount,
     .value = std::int64_t{2000},
     .sentence = "Linear iterations after which a solve has failed."},
    {.path = "solver.petsc-options",
     .type = text,
     .value = ""s,
     .applies = kWithElements,
     .sentence = "Further options: \"-name value -name …\"."},

    {.path = "time.scheme",
     .type = word,
     .words = words::list(words::time_schemes),
     .default_note = "\"semi-implicit\"; \"rk2\" with control = \"paper\"; \"implicit\" with "
                     "inertia",
     .sentence = "Midpoint rule (the paper's eq. 22), explicit Euler (eq. 21), midpoint rule with "
                 "damped tension, Runge-Kutta-Chebyshev with 3 to 24 solves, or that of inertia."},
    {.path = "time.end",
     .dimension = Dimension::time,
     .range = kNotNegative,
     .value = 10.0,
     .sentence = "The run stops at the first step there or beyond."},
    {.path = "time.control",
     .type = word,
     .words = words::list(words::step_controls),
     .default_note = "\"paper\" with step-factor, step-edges or \"euler\", else \"error\"",
     .sentence = "What sets steps: the paper's rule, or an estimate of the error with bounds from "
                 "stability, motion and necks."},
    {.path = "time.tolerance",
     .range = {.min = 0.0, .max = 1.0, .open_min = true},
     .value = kDefaultTolerance,
     .applies = "with control = \"error\"",
     .sentence = "Largest estimated error of a step at a vertex, over the shortest edge there."},
    {.path = "time.step-factor",
     .range = {.min = 0.0, .max = 10.0, .open_min = true},
     .value = 0.5,
     .applies = "with control = \"paper\"",
     .sentence = "dt = step-factor · min(1, Ca) · (shortest edge), the paper's eq. 27."},
    {.path = "time.step-edges",
     .type = word,
     .words = words::list(words::step_edges),
     .value = "interface"s,
     .applies = "with control = \"paper\"",
     .sentence = "Where the shortest edge is looked for; mesh is the paper's."},
    {.path = "time.max-step",
     .dimension = Dimension::time,
     .range = kPositive,
     .default_note = "1; 0.1 with control = \"paper\"; 0.07 La^(1/2) in quiescent cases with "
                     "inertia, if longer",
     .sentence = "Longest step."},
    {.path = "time.min-step",
     .dimension = Dimension::time,
     .range = kPositive,
     .value = 1e-6,
     .sentence = "A step that fails at this length ends the run; at most max-step."},

    {.path = "time.stop-when.steady-rate",
     .dimension = Dimension::velocity,
     .range = kPositive,
     .default_note = "none",
     .sentence = "The run ends once the half-length L of every drop changes by less than this per "
                 "1/G, and by no more than in the 1/G before."},
    {.path = "time.stop-when.broken",
     .type = flag,
     .value = false,
     .sentence = "Whether the run ends after the step in which a drop breaks up or drops merge."},
    {.path = "time.stop-when.broken-length",
     .dimension = Dimension::length,
     .range = kLength,
     .default_note = "none",
     .sentence = "The run ends, as broken, once a drop's half-length L is beyond this and grows at "
                 "a rising rate."},
    {.path = "time.stop-when.length",
     .dimension = Dimension::length,
     .range = kLength,
     .default_note = "none",
     .sentence = "The run ends once a drop's half-length L is beyond this."},
    {.path = "time.stop-when.patch-gap",
     .dimension = Dimension::length,
     .range = {.min = 0.0, .max = 1e6},
     .default_note = "the mean edge of the drop there",
     .applies = "where a patch is open",
     .sentence = "The run ends once a drop is nearer than this to an open patch, or would be after "
                 "the next step; 0: never."},

    {.path = "output.interval",
     .dimension = Dimension::time,
     .range = kPositive,
     .value = 0.2,
     .sentence = "Time between surfaces for viewing."},
    {.path = "output.volume",
     .type = flag,
     .value = true,
     .sentence = "Whether volume meshes with velocity and pressure are written."},
    {.path = "output.volume-interval",
     .dimension = Dimension::time,
     .range = kPositive,
     .default_note = "output.interval",
     .applies = "with volume = true, where there are volume meshes",
     .sentence = "Time between volume meshes."},
    {.path = "output.checkpoint-every",
     .type = whole,
     .range = kCount,
     .value = std::int64_t{10},
     .sentence = "Steps between checkpoints; the last two are kept."},

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
    {.path = "scale.density",
     .range = kNotNegative,
     .value = 0.0,
     .sentence = "rho_out in kilograms per cubic metre; 0: no inertia."},
    {.path = "scale.rate",
     .range = kPositive,
     .default_note = "required with [scale]; surface-tension/(viscosity · length) in a quiescent "
                     "flow",
     .sentence = "G per second: the rate of a flow given by kind."},
};

}  // namespace

std::span<const Key> run_keys() { return kRunKeys; }

}  // namespace meniscus::schema
