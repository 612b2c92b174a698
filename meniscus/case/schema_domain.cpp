// The keys of the outer boundary and its patches.
#include "meniscus/case/schema_parts.hpp"
#include "meniscus/case/words.hpp"

namespace meniscus::schema {
namespace {

using namespace std::string_literals;
using enum Type;

// 20 000: the meshes of docs/volume-mesh.md have 20 nodes per vertex of a boundary of 2007
// vertices, growing as their power 3/2. That means one to two million nodes, as the most of a drop
// does.
constexpr Range kBoundaryNodes{.min = 50, .max = 20000};

const std::vector<Key> kDomainKeys{
    {.path = "domain.shape",
     .type = word,
     .words = words::list(words::domain_shapes),
     .value = "box"s,
     .applies = "without surface",
     .sentence = "Outer boundary; a cylinder lies along x. \"unbounded\" goes with method = "
                 "\"boundary-integral\" and only with it."},
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
     .sentence = "The same for x-, y- and z-faces."},
    {.path = "domain.radius",
     .dimension = Dimension::length,
     .range = kLength,
     .value = 10.0,
     .applies = "with shape = \"sphere\" or \"cylinder\"",
     .sentence = "Radius of sphere or cylinder."},
    {.path = "domain.half-length",
     .dimension = Dimension::length,
     .range = kLength,
     .value = 10.0,
     .applies = "with shape = \"cylinder\"",
     .sentence = "Half the cylinder's length."},
    {.path = "domain.surface",
     .type = path,
     .default_note = "none: the boundary is a shape",
     .sentence =
         "A closed surface in one piece, of polygons (stl, ply, obj, off, "
         "vtp). Tags of faces: in vtp the cell array `patch`; in obj the groups (g) by "
         "first face; in ascii stl the solids; both numbered from 0. In other files all are 0."},
    {.path = "domain.repair",
     .type = flag,
     .value = false,
     .applies = "with domain.surface",
     .sentence = "Mends that surface: stitches, fills holes up to a tenth of it, removes crossing "
                 "and doubled faces."},
    {.path = "domain.nodes",
     .type = whole,
     .range = kBoundaryNodes,
     .value = std::int64_t{507},
     .applies = "without surface",
     .sentence = "Approximate number of its vertices."},
    {.path = "domain.grading",
     .type = word,
     .words = words::list(words::gradings),
     .value = "linear"s,
     .applies = kWithElements,
     .sentence = "How element size passes from surface to surface (P2-P1: gaussian unless set)."},
    {.path = "domain.cell-volume",
     .type = number,
     .range = {.min = 0.1, .max = 100.0},
     .default_note = "2.0; 1.5 with P2-P1 elements",
     .applies = kWithElements,
     .sentence = "Tetrahedra are divided above this many regular ones of the wanted edge. Half "
                 "doubles the nodes."},
    {.path = "domain.interior-growth",
     .range = {.min = 0.0, .max = 10.0},
     .value = 0.5,
     .applies = kWithElements,
     .sentence = "Growth of tetrahedra with distance from the surface, inside drops and where no "
                 "farther surface bounds the liquid."},
    {.path = "domain.radius-edge",
     .range = {.min = 1.1, .max = 10.0},
     .value = 1.4,
     .applies = kWithElements,
     .sentence =
         "TetGen's bound on circumradius over shortest edge; lower: rounder and more tetrahedra."},
    {.path = "domain.frame",
     .type = word,
     .words = words::list(words::domain_frames),
     .value = "fixed"s,
     .sentence = "drops: domain and imposed flow move along with the drops' common centroid, which "
                 "stays at its first place."},

    {.path = "domain.patch[].name",
     .type = text,
     .default_note = "required for a shape; a label for a tag",
     .sentence = "The patch of the shape, as above."},
    {.path = "domain.patch[].tag",
     .type = whole,
     .range = {.min = 0, .max = 1e9},
     .default_note = "required for a surface",
     .applies = "with domain.surface",
     .sentence = "The faces' tag, as in domain.surface."},
    {.path = "domain.patch[].condition",
     .type = word,
     .words = words::list(words::conditions),
     .value = "velocity"s,
     .sentence = "velocity: v is given; symmetry (flat patches): neither flow through it nor "
                 "tangential traction; open: traction is given."},
    {.path = "domain.patch[].velocity",
     .type = velocity,
     .dimension = Dimension::velocity,
     .range = kFinite,
     .words = {"flow"},
     .value = "flow"s,
     .applies = "with condition = \"velocity\"",
     .sentence = "\"flow\": v = G·x with its schedule; else constant, [0, 0, 0] for a wall."},
    {.path = "domain.patch[].profile",
     .type = word,
     .words = words::list(words::profiles),
     .value = "uniform"s,
     .applies = "with a velocity of three numbers",
     .sentence = "parabolic: velocity · max(0, 1 - d²/a²), d the distance from profile-center, a "
                 "the profile-radius, as in a round pipe."},
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
     .sentence = "Where the parabola is zero."},
    {.path = "domain.patch[].traction",
     .type = vector,
     .dimension = Dimension::stress,
     .range = kFinite,
     .value = Vec3(Vec3::Zero()),
     .applies = "with condition = \"open\"",
     .sentence = "T·n, n out of the domain; a pressure p is -p n."},
};

}  // namespace

std::span<const Key> domain_keys() { return kDomainKeys; }

}  // namespace meniscus::schema
