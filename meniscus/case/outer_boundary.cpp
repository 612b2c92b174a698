#include "meniscus/case/outer_boundary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "meniscus/case/scalar_inlets.hpp"
#include "meniscus/case/surface_source.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {
namespace {

using Shape = DomainCase::Shape;
using Condition = PatchCase::Condition;

// Patch names in the order of the face tags of mesh/shapes.hpp.
constexpr std::array<std::string_view, 6> kBoxPatches{"x-", "x+", "y-", "y+", "z-", "z+"};
constexpr std::array<std::string_view, 3> kCylinderPatches{"side", "x-", "x+"};
constexpr std::string_view kBothEnds = "ends", kWholeSphere = "all";
constexpr int kFirstZTag = 4;  // tags of the box from here on: z- and z+
constexpr int kSideTag = 0;    // tag of the cylinder's side

std::vector<std::string_view> names_by_tag(Shape shape) {
  switch (shape) {
    case Shape::box:
      return {kBoxPatches.begin(), kBoxPatches.end()};
    case Shape::cylinder:
      return {kCylinderPatches.begin(), kCylinderPatches.end()};
    case Shape::sphere:
      return {kWholeSphere};
    case Shape::file:
    case Shape::unbounded:
      break;
  }
  return {};
}

TaggedSurface boundary_surface(const Case& c, const WarningListener& warn) {
  const DomainCase& domain = c.domain;
  switch (domain.shape) {
    case Shape::box:
      return box(domain.nodes, domain.half_widths);
    case Shape::cylinder:
      return cylinder(domain.nodes, domain.radius, domain.half_length);
    case Shape::file:
      return read_case_surface(c, "domain.surface", {domain.file, domain.is_repaired}, warn);
    case Shape::sphere:
    case Shape::unbounded:
      break;
  }
  SurfaceMesh mesh = sphere(domain.nodes, domain.radius);
  FaceField<int> tag(mesh.num_faces(), 0);
  return {std::move(mesh), std::move(tag)};
}

/// A parabola on a patch: peak · max(0, 1 − d²/a²).
ImposedVelocity parabolic_velocity(const PatchCase& given, const SurfaceMesh& mesh,
                                   const std::vector<FaceId>& faces) {
  Vec3 moment = Vec3::Zero();
  double area = 0.0;
  for (const FaceId f : faces) {
    const FaceVertices& v = mesh.faces[f];
    const double face_area = face_area_vector(mesh, f).norm();
    moment += face_area / 3.0 * (mesh.x[v[0]] + mesh.x[v[1]] + mesh.x[v[2]]);
    area += face_area;
  }
  const Vec3 center = given.profile_center.value_or(moment / area);
  double reach = 0.0;
  for (const FaceId f : faces)
    for (const VertexId v : mesh.faces[f]) reach = std::max(reach, (mesh.x[v] - center).norm());
  const double radius = given.profile_radius.value_or(reach);
  return {[peak = given.velocity, center, radius](const Vec3& x, double) -> Vec3 {
            return std::max(0.0, 1.0 - (x - center).squaredNorm() / (radius * radius)) * peak;
          },
          false};
}

ImposedVelocity flow_velocity(const ImposedFlow& flow) {
  return {[flow](const Vec3& x, double t) { return flow.velocity(x, t); }, true};
}

/// Whether a patch is flat. On a curved patch n·v = 0 on every face would fix the liquid at its
/// vertices.
bool is_flat(const SurfaceMesh& mesh, const std::vector<FaceId>& faces) {
  const Vec3 n = face_area_vector(mesh, faces.front()).normalized();
  // 1e-6: roundoff of single-precision coordinates in a file.
  return std::ranges::all_of(faces, [&](FaceId f) {
    const Vec3 area = face_area_vector(mesh, f);
    return (area - area.dot(n) * n).norm() < 1e-6 * area.norm() && area.dot(n) > 0.0;
  });
}

BoundaryCondition condition(const Case& c, const PatchCase& given, const SurfaceMesh& mesh,
                            const std::vector<FaceId>& faces) {
  if (given.condition == Condition::symmetry) {
    if (!is_flat(mesh, faces))
      c.settings.reject(given.path + ".condition", "needs a flat patch, which this one is not");
    return NoPenetration{};
  }
  if (given.condition == Condition::open) return ImposedTraction{given.traction};
  if (given.follows_flow) return flow_velocity(c.flow);
  if (given.is_parabolic) return parabolic_velocity(given, mesh, faces);
  return ImposedVelocity{[v = given.velocity](const Vec3&, double) { return v; }, false};
}

BoundaryCondition default_condition(const Case& c, int tag) {
  if (c.domain.is_symmetric_in_z && c.domain.shape == Shape::box && tag >= kFirstZTag)
    return NoPenetration{};
  return flow_velocity(c.flow);
}

/// The smooth wall that the faces of a curved patch approximate, as the projection onto it.
std::function<Vec3(const Vec3&)> smooth_wall(const DomainCase& domain, int tag) {
  if (domain.shape == Shape::sphere)
    return [radius = domain.radius](const Vec3& x) { return Vec3(radius * x.normalized()); };
  if (domain.shape == Shape::cylinder && tag == kSideTag)
    return [radius = domain.radius](const Vec3& x) {
      const double scale = radius / std::hypot(x.y(), x.z());
      return Vec3(x.x(), scale * x.y(), scale * x.z());
    };
  return {};
}

const PatchCase* find_patch(const DomainCase& domain, int tag) {
  const auto found = std::ranges::find_if(domain.patches, [&](const PatchCase& patch) {
    return std::ranges::find(patch.tags, tag) != patch.tags.end();
  });
  return found == domain.patches.end() ? nullptr : &*found;
}

/// The conditions on the scalars at the faces of a tag.
std::vector<ScalarCondition> scalar_conditions(const Case& c, int tag) {
  std::vector<ScalarCondition> conditions;
  for (const ScalarCase& scalar : c.scalars) {
    const auto found = std::ranges::find_if(scalar.patches, [&](const ScalarPatchCase& patch) {
      return std::ranges::find(patch.tags, tag) != patch.tags.end();
    });
    conditions.push_back(found == scalar.patches.end() ? ScalarCondition{} : found->condition);
  }
  return conditions;
}

/// Throws InvalidInput unless the tags of a surface file and the patches match one to one.
void require_matching_tags(const Case& c, const std::set<int>& tags) {
  for (const PatchCase& patch : c.domain.patches)
    if (!tags.contains(patch.tags.front()))
      c.settings.reject(patch.path + ".tag", "is not a tag of the surface; its tags are {}",
                        fmt::join(tags, ", "));
  for (const int tag : tags)
    if (find_patch(c.domain, tag) == nullptr)
      c.settings.reject("domain.surface",
                        "has the tag {}, which no [[domain.patch]] gives a "
                        "condition",
                        tag);
}

std::string patch_name(const DomainCase& domain, int tag) {
  const std::vector<std::string_view> names = names_by_tag(domain.shape);
  MENISCUS_ASSERT(domain.shape == Shape::file || (tag >= 0 && std::size_t(tag) < names.size()),
                  "tag {} of {} patches", tag, names.size());
  if (domain.shape != Shape::file) return std::string(names[static_cast<std::size_t>(tag)]);
  const PatchCase* given = find_patch(domain, tag);
  return given != nullptr && !given->name.empty() ? given->name : fmt::format("tag {}", tag);
}

}  // namespace

std::vector<std::string_view> patch_names(Shape shape) {
  std::vector<std::string_view> names = names_by_tag(shape);
  if (shape == Shape::cylinder) names.push_back(kBothEnds);
  return names;
}

std::vector<int> shape_tags(Shape shape, std::string_view name) {
  if (shape == Shape::cylinder && name == kBothEnds) return {1, 2};
  const std::vector<std::string_view> names = names_by_tag(shape);
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) return {};
  return {static_cast<int>(found - names.begin())};
}

OuterBoundary build_boundary(const Case& c, const WarningListener& warn) {
  TaggedSurface surface = boundary_surface(c, warn);
  const std::set<int> tags(surface.tag.begin(), surface.tag.end());
  if (c.domain.shape == Shape::file) require_matching_tags(c, tags);

  OuterBoundary boundary;
  MENISCUS_ASSERT(surface.tag.size() == surface.mesh.num_faces(), "{} tags of {} faces",
                  surface.tag.size(), surface.mesh.num_faces());
  boundary.patch = FaceField<PatchId>(surface.mesh.num_faces());
  for (const int tag : tags) {
    std::vector<FaceId> faces;
    for (const FaceId f : surface.tag.ids())
      if (surface.tag[f] == tag) faces.push_back(f);
    const PatchCase* given = find_patch(c.domain, tag);
    const PatchId id = boundary.patches.add(
        {patch_name(c.domain, tag),
         given != nullptr ? condition(c, *given, surface.mesh, faces) : default_condition(c, tag),
         smooth_wall(c.domain, tag), scalar_conditions(c, tag)});
    for (const FaceId f : faces) boundary.patch[f] = id;
  }
  boundary.mesh = std::move(surface.mesh);
  require_values_at_inlets(c, boundary);
  return boundary;
}

}  // namespace meniscus
