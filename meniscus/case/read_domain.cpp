#include <algorithm>
#include <string>

#include "meniscus/case/case_parts.hpp"
#include "meniscus/case/outer_boundary.hpp"
#include "meniscus/case/words.hpp"

namespace meniscus {
namespace {

using Shape = DomainCase::Shape;
using Condition = PatchCase::Condition;

/// [R0] With [scale]: ten times the farthest walls that have a use.
constexpr double kLargestDomain = 1000.0;

double read_length(Settings& settings, const std::string& path) {
  const double length = settings.number(path);
  settings.require_metres(path, length, kLargestDomain);
  return length;
}

void read_size(Settings& settings, DomainCase& domain) {
  switch (domain.shape) {
    case Shape::file:
      domain.file = settings.file("domain.surface");
      domain.is_repaired = settings.flag("domain.repair");
      return;
    case Shape::box:
      domain.half_widths = settings.is_given("domain.half-widths")
                               ? settings.vector("domain.half-widths")
                               : Vec3::Constant(read_length(settings, "domain.half-width")).eval();
      break;
    case Shape::cylinder:
      domain.half_length = read_length(settings, "domain.half-length");
      [[fallthrough]];
    case Shape::sphere:
      domain.radius = read_length(settings, "domain.radius");
      break;
    case Shape::unbounded:
      return;
  }
  domain.nodes = settings.whole("domain.nodes");
}

void read_velocity(Settings& settings, PatchCase& patch) {
  const std::string path = patch.path + ".velocity";
  patch.follows_flow = settings.word_or_vector(path).has_value();
  if (patch.follows_flow) return;
  patch.velocity = settings.vector(path);
  patch.is_parabolic = settings.choice(patch.path + ".profile", words::profiles);
  if (!patch.is_parabolic) return;
  const std::string center = patch.path + ".profile-center",
                    radius = patch.path + ".profile-radius";
  if (settings.is_given(center)) patch.profile_center = settings.vector(center);
  if (settings.is_given(radius)) patch.profile_radius = settings.number(radius);
}

PatchCase read_patch(Settings& settings, const DomainCase& domain, const std::string& table) {
  PatchCase patch{read_patch_place(settings, domain.shape, table)};
  for (const PatchCase& earlier : domain.patches) require_apart(settings, patch, earlier);
  patch.condition = settings.choice(table + ".condition", words::conditions);
  if (patch.condition == Condition::velocity) read_velocity(settings, patch);
  if (patch.condition == Condition::open) patch.traction = settings.vector(table + ".traction");
  return patch;
}

/// Whether v = G·x has no component along z and does not vary along it, at all times. Then the
/// z-faces of a box may be planes of symmetry.
bool is_in_xy_plane(const ImposedFlow& flow) {
  const auto is_planar = [](const Mat3& g) { return g.row(2).isZero(0.0) && g.col(2).isZero(0.0); };
  return is_planar(flow.initial_gradient()) &&
         std::ranges::all_of(flow.schedule(), [&](const ImposedFlow::Entry& entry) {
           return is_planar(entry.gradient);
         });
}

}  // namespace

PatchPlace read_patch_place(Settings& settings, Shape shape, const std::string& table) {
  PatchPlace patch{.path = table, .name = "", .tags = {}};
  const std::string name = table + ".name";
  if (shape == Shape::file) {
    patch.tags = {settings.whole(table + ".tag")};
    if (settings.is_given(name)) patch.name = settings.text(name);
    return patch;
  }
  patch.name = settings.text(name);
  patch.tags = shape_tags(shape, patch.name);
  if (patch.tags.empty())
    settings.reject(name, "is not a patch of the {}; its patches are {}",
                    settings.text("domain.shape"), schema::quoted_list(patch_names(shape)));
  return patch;
}

void require_apart(const Settings& settings, const PatchPlace& patch, const PatchPlace& earlier) {
  if (std::ranges::find_first_of(earlier.tags, patch.tags) == earlier.tags.end()) return;
  const bool has_tag = settings.is_given("domain.surface");
  settings.reject(patch.path + (has_tag ? ".tag" : ".name"),
                  "has a condition already, from the [[{}]] at {}",
                  schema::without_indices(patch.path), settings.source(earlier.path));
}

DomainCase read_domain(Settings& settings, const ImposedFlow& flow) {
  DomainCase domain;
  if (settings.is_given("domain.surface"))
    domain.shape = Shape::file;
  else
    domain.shape = settings.choice("domain.shape", words::domain_shapes);
  read_size(settings, domain);
  const bool is_shear =
      settings.is_given("flow.kind") &&
      settings.choice("flow.kind", words::flow_kinds).gradient == ImposedFlow::simple_shear;
  domain.is_symmetric_in_z = is_shear && is_in_xy_plane(flow);
  if (domain.shape == Shape::unbounded && settings.count("domain.patch") > 0)
    reject_input("{}: [[domain.patch]] has no effect here: an unbounded domain has no patches",
                 settings.source("domain.patch[0]"));
  for (int i = 0; i < settings.count("domain.patch"); ++i)
    domain.patches.push_back(read_patch(settings, domain, fmt::format("domain.patch[{}]", i)));
  return domain;
}

}  // namespace meniscus
