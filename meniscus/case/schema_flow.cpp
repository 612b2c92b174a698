// The keys of the case as a whole and of its imposed flow.
#include "meniscus/case/schema_parts.hpp"
#include "meniscus/case/words.hpp"

namespace meniscus::schema {
namespace {

using namespace std::string_literals;
using enum Type;

const std::vector<Key> kFlowKeys{
    {.path = "title",
     .type = text,
     .value = ""s,
     .sentence = "What the case is, for page and progress."},

    {.path = "flow.kind",
     .type = word,
     .words = words::list(words::flow_kinds),
     .default_note = "required, or gradient",
     .sentence = "v = (y, 0, 0), (x, -y/2, -z/2), (x, -y, 0) or 0. Sets drops' measures and a "
                 "box's conditions."},
    {.path = "flow.gradient",
     .type = matrix,
     .dimension = Dimension::rate,
     .range = kFinite,
     .default_note = "required, or kind",
     .sentence = "Velocity gradient of v = G·x by rows, trace 0."},
    {.path = "flow.capillary-number",
     .range = {.min = 0.0, .open_min = true, .infinity = true},
     .value = 1.0,
     .applies = "without [scale]",
     .sentence = "Ca = mu_out G R0/sigma; inf: no tension. Where nothing sets a rate: 1 or inf."},

    {.path = "flow.reynolds-number",
     .range = kNotNegative,
     .value = 0.0,
     .applies = "without [scale]",
     .sentence = "Re = rho_out G R0²/mu_out, quiescent: Laplace number rho_out sigma R0/mu_out²; "
                 "0: Stokes flow."},
    {.path = "flow.gravity",
     .type = vector,
     .dimension = Dimension::gravity,
     .range = kFinite,
     .value = Vec3(Vec3::Zero()),
     .applies = "with drop.density-ratio",
     .sentence = "Bond number rho_out g R0²/sigma by components; pressures are beyond the matrix's "
                 "hydrostatic one. SI units need scale.density."},

    {.path = "flow.schedule[].time",
     .dimension = Dimension::time,
     .range = kNotNegative,
     .default_note = "required",
     .sentence = "When the entry begins."},
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
     .sentence = "Its velocity gradient, trace 0."},
    {.path = "flow.schedule[].factor",
     .range = kFinite,
     .value = 1.0,
     .sentence = "Multiplies the gradient: 0 stops, -1 reverses."},
    {.path = "flow.schedule[].ramp",
     .dimension = Dimension::time,
     .range = kNotNegative,
     .value = 0.0,
     .sentence = "Time of a linear change from the gradient before; 0: at once."},
};

}  // namespace

std::span<const Key> flow_keys() { return kFlowKeys; }

}  // namespace meniscus::schema
