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
     .sentence = "A cylinder lies along x. \"unbounded\" and method = \"boundary-integral\" need "
                 "each other."},
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
     .sentence = "Surface file as at drop.surface. Tags of faces: cell array `patch` of vtp; "
                 "groups (g) of obj by first face, solids of ascii stl, from 0; else 0."},
    {.path = "domain.repair",
     .type = flag,
     .value = false,
     .applies = "with domain.surface",
     .sentence = "Mends that surface, as at drop.repair."},
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
     .sentence = "How element size passes from surface to surface (P2-P1: gaussian by default)."},
    {.path = "domain.cell-volume",
     .type = number,
     .range = {.min = 0.1, .max = 100.0},
     .default_note = "2.0; 1.5 with P2-P1 elements",
     .applies = kWithElements,
     .sentence =
         "Largest tetrahedron, in regular ones of the wanted edge. Half doubles the nodes."},
    {.path = "domain.interior-growth",
     .range = {.min = 0.0, .max = 10.0},
     .value = 0.5,
     .applies = kWithElements,
     .sentence =
         "Growth of edges away from the surface, in drops and liquid without a farther one."},
    {.path = "domain.radius-edge",
     .range = {.min = 1.1, .max = 10.0},
     .value = 1.4,
     .applies = kWithElements,
     .sentence = "Bound on circumradius over shortest edge; lower: rounder and more tetrahedra."},
    {.path = "domain.frame",
     .type = word,
     .words = words::list(words::domain_frames),
     .value = "fixed"s,
     .sentence = "drops: domain and imposed flow move along with the drops' common centroid."},

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
     .sentence = "velocity: v is given; symmetry (flat patches): no flow through, no tangential "
                 "traction; open: traction is given."},
    {.path = "domain.patch[].velocity",
     .type = velocity,
     .dimension = Dimension::velocity,
     .range = kFinite,
     .words = {"flow"},
     .value = "flow"s,
     .applies = "with condition = \"velocity\"",
     .sentence = "\"flow\": v = G·x with its schedule. Else constant; a wall: [0, 0, 0]."},
    {.path = "domain.patch[].profile",
     .type = word,
     .words = words::list(words::profiles),
     .value = "uniform"s,
     .applies = "with a velocity of three numbers",
     .sentence = "parabolic, as in a pipe: velocity · max(0, 1 - d²/a²). d is the distance from "
                 "profile-center, a profile-radius."},
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
