#include "meniscus/scene/scene.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/box_tree.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_tree.hpp"

namespace meniscus {
namespace {

RegionId region_within(std::size_t interface) { return {static_cast<std::int32_t>(interface) + 1}; }

std::vector<Box> boxes_of(const Scene& scene) {
  std::vector<Box> boxes;
  boxes.reserve(scene.interfaces.size());
  for (const Interface& interface : scene.interfaces) boxes.push_back(bounding_box(interface.mesh));
  return boxes;
}

std::optional<Fault> find_not_finite(const Scene& scene) {
  for (const Interface& interface : scene.interfaces)
    if (interface.mesh.num_faces() == 0 || !is_finite(interface.mesh))
      return Fault{
          FaultKind::not_finite,
          fmt::format("drop {} has no surface, or one that is not finite", interface.drop)};
  return {};
}

std::optional<Fault> find_touching(const Scene& scene, const BoxTree& boxes) {
  const auto& interfaces = scene.interfaces;
  for (std::size_t i = 0; i < interfaces.size(); ++i)
    for (const std::size_t j : boxes.earlier_within(i, 0.0))
      if (auto meeting = find_intersection(interfaces[j].mesh, SurfaceTree(interfaces[i].mesh)))
        return with_context(
            fmt::format("drops {} and {} touch", interfaces[j].drop, interfaces[i].drop),
            *std::move(meeting));
  return {};
}

/// For surfaces that do not meet, one vertex tells on which side of the other a surface lies.
std::optional<Fault> find_outside(const Scene& scene) {
  if (scene.is_unbounded) return {};
  const SurfaceTree boundary(scene.boundary.mesh);
  for (const Interface& interface : scene.interfaces)
    if (auto meeting = find_intersection(interface.mesh, boundary))
      return with_context(fmt::format("drop {} touches the outer boundary", interface.drop),
                          *std::move(meeting));
  for (const Interface& interface : scene.interfaces)
    if (const Vec3& x = interface.mesh.x[VertexId{0}]; !encloses(boundary, x))
      return Fault{
          FaultKind::outside_domain,
          fmt::format("drop {} lies outside the outer boundary, at {}", interface.drop, text_of(x)),
          x};
  return {};
}

/// The innermost interface around each interface: the enclosing one that is itself enclosed most.
std::vector<RegionId> surrounding_regions(const Scene& scene, const BoxTree& boxes) {
  const std::size_t n = scene.interfaces.size();
  std::vector<std::vector<std::size_t>> enclosing(n);
  for (std::size_t j = 0; j < n; ++j) {
    const SurfaceMesh& around = scene.interfaces[j].mesh;
    const SurfaceTree tree(around);
    boxes.visit_within(bounding_box(around), 0.0, [&](std::size_t i) {
      if (i != j && encloses(tree, scene.interfaces[i].mesh.x[VertexId{0}]))
        enclosing[i].push_back(j);
    });
  }
  std::vector<RegionId> result(n, RegionId{0});
  for (std::size_t i = 0; i < n; ++i) {
    const auto innermost = std::ranges::max_element(
        enclosing[i], {}, [&](std::size_t j) { return enclosing[j].size(); });
    if (innermost != enclosing[i].end()) result[i] = region_within(*innermost);
  }
  return result;
}

std::optional<Fault> find_wrong_nesting(const Scene& scene, const BoxTree& boxes) {
  const std::vector<RegionId> surrounding = surrounding_regions(scene, boxes);
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
    const Interface& interface = scene.interfaces[i];
    const Vec3 x = mean_vertex(interface.mesh);
    if (interface.inside != region_within(i))
      return Fault{FaultKind::regions,
                   fmt::format("drop {} at {}: its liquid is region {}, but interface {} encloses "
                               "region {}",
                               interface.drop, text_of(x), interface.inside.value, i, i + 1),
                   x};
    if (interface.outside != surrounding[i])
      return Fault{
          FaultKind::regions,
          fmt::format("drop {} at {} lies in region {}, not in region {} as it says",
                      interface.drop, text_of(x), surrounding[i].value, interface.outside.value),
          x};
  }
  return {};
}

}  // namespace

double imposed_flux(const Scene& scene, double t) {
  const OuterBoundary& boundary = scene.boundary;
  MENISCUS_ASSERT(boundary.patch.size() == boundary.mesh.num_faces(), "{} {}",
                  boundary.patch.size(), boundary.mesh.num_faces());
  double flux = 0.0;
  for (const FaceId f : boundary.mesh.faces.ids()) {
    const auto* imposed =
        std::get_if<ImposedVelocity>(&boundary.patches[boundary.patch[f]].condition);
    if (imposed == nullptr) continue;
    MENISCUS_ASSERT(bool(imposed->velocity), "patch {}", boundary.patch[f].value);
    Vec3 mean = Vec3::Zero();
    for (const VertexId v : boundary.mesh.faces[f])
      mean += imposed->velocity(boundary.mesh.x[v], t) / 3.0;
    flux += mean.dot(face_area_vector(boundary.mesh, f));
  }
  return flux;
}

bool has_open_patch(const Scene& scene) {
  return std::ranges::any_of(scene.boundary.patches, [](const Patch& patch) {
    return std::holds_alternative<ImposedTraction>(patch.condition);
  });
}

bool has_inertia(const Scene& scene) {
  return std::ranges::any_of(scene.liquids,
                             [](const Liquid& liquid) { return liquid.density > 0.0; });
}

void assign_regions(Scene& scene) {
  const std::vector<RegionId> surrounding = surrounding_regions(scene, BoxTree(boxes_of(scene)));
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
    scene.interfaces[i].inside = region_within(i);
    scene.interfaces[i].outside = surrounding[i];
  }
}

std::optional<Fault> find_conflict(const Scene& scene) {
  if (auto fault = find_not_finite(scene)) return fault;
  const BoxTree boxes(boxes_of(scene));
  if (auto fault = find_touching(scene, boxes)) return fault;
  if (auto fault = find_outside(scene)) return fault;
  return find_wrong_nesting(scene, boxes);
}

}  // namespace meniscus
