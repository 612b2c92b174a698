#include "meniscus/topology/successors.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_pieces.hpp"
#include "meniscus/scene/interface_tension.hpp"
#include "meniscus/surface/remesh.hpp"
#include "meniscus/surface/restore_volume.hpp"

namespace meniscus {
namespace {

/// A liquid drop's worth of surface that is about to become an interface.
struct Child {
  Interface interface;
  Liquid liquid;
  bool is_cavity = false;
};

/// A direction along which no two points of a symmetric scene are level.
Vec3 generic_direction() { return {1.0, std::sqrt(2.0) / 2.0, std::sqrt(3.0) / 3.0}; }

/// Whether a parent lies in the liquid of another one.
bool is_within_another(const Scene& scene, std::span<const std::size_t> parents, std::size_t i) {
  return std::ranges::any_of(parents, [&](std::size_t j) {
    return scene.interfaces[j].inside == scene.interfaces[i].outside;
  });
}

/// The volume that all parents enclose of the liquid that the pieces bound: a parent that lies in
/// another one counts as taken from it.
struct LiquidVolume {
  double kept = 0.0;      ///< the volumes that remeshing restores
  double of_faces = 0.0;  ///< of the triangulations: less where the surface kept is curved
};
LiquidVolume liquid_volume(const Scene& scene, std::span<const std::size_t> parents) {
  LiquidVolume volume;
  for (const std::size_t i : parents) {
    const Interface& one = scene.interfaces[i];
    const double sign = is_within_another(scene, parents, i) ? -1.0 : 1.0;
    volume.kept += sign * one.volume;
    volume.of_faces += sign * enclosed_volume(one.mesh);
  }
  return volume;
}

std::size_t largest(const Scene& scene, std::span<const std::size_t> parents) {
  return *std::ranges::max_element(parents, [&](std::size_t i, std::size_t j) {
    const Interface &a = scene.interfaces[i], &b = scene.interfaces[j];
    const bool are_equal = std::abs(a.volume - b.volume) <= 1e-12 * std::max(a.volume, b.volume);
    return are_equal ? a.drop > b.drop : a.volume < b.volume;
  });
}

/// The parent around the liquid of the pieces: the one that no other encloses.
const Interface& outermost(const Scene& scene, std::span<const std::size_t> parents) {
  for (const std::size_t i : parents)
    if (!is_within_another(scene, parents, i)) return scene.interfaces[i];
  return scene.interfaces[parents.front()];
}

/// What the pieces are made of: the parents, unless surgery refined them first.
CarryingSurface origin_of(const Scene& scene, InterfaceReplacement& replacement) {
  if (replacement.refined.mesh.num_faces() > 0) return std::move(replacement.refined);
  std::vector<SurfaceMesh> meshes;
  std::vector<SurfaceFields> fields;
  for (const std::size_t i : replacement.parents) {
    meshes.push_back(scene.interfaces[i].mesh);
    fields.push_back(scene.interfaces[i].fields);
  }
  return {joined_surface(meshes), joined_fields(fields)};
}

/// By how much fields on vertices left the range that they had on the parents.
FieldExcess beyond_parents(const Scene& scene, std::span<const std::size_t> parents,
                           const SurfaceFields& now) {
  FieldExcess excess;
  for (std::size_t k = 0; k < now.on_vertices.size(); ++k) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const std::size_t i : parents)
      for (const double value : scene.interfaces[i].fields.on_vertices[k].values) {
        low = std::min(low, value);
        high = std::max(high, value);
      }
    for (const double value : now.on_vertices[k].values) widen(excess, {value - high, low - value});
  }
  return excess;
}

/// Gives the children what lives on the parents. `cut` has them as they were before their volumes
/// were restored.
FieldExcess give_fields(const Scene& scene, InterfaceReplacement& replacement,
                        std::span<const SurfaceMesh> cut, std::span<Child> children) {
  if (scene.interfaces[replacement.parents.front()].fields.empty()) return {};
  std::vector<SurfaceMesh> restored;
  for (const Child& child : children) restored.push_back(child.interface.mesh);
  const CarryingSurface origin = origin_of(scene, replacement);
  const ReplacedFields replaced =
      replaced_fields(origin.fields, origin.mesh, joined_surface(cut), joined_surface(restored));
  FieldExcess excess = replaced.excess;
  widen(excess, beyond_parents(scene, replacement.parents, replaced.fields));
  std::vector<SurfaceFields> fields = split_fields(replaced.fields, restored);
  for (std::size_t k = 0; k < children.size(); ++k)
    children[k].interface.fields = std::move(fields[k]);
  return excess;
}

std::vector<Child> children_of(const Scene& scene, InterfaceReplacement& replacement) {
  const Interface& outer = outermost(scene, replacement.parents);
  const Interface& heir = scene.interfaces[largest(scene, replacement.parents)];
  double C0 = 0.0;
  for (const std::size_t i : replacement.parents) C0 = std::max(C0, scene.interfaces[i].C0);
  std::vector<Child> children;
  for (SurfaceMesh& piece : replacement.pieces) {
    Child child;
    child.interface.parent = heir.drop;
    child.interface.tension = heir.tension;
    child.interface.surfactant = heir.surfactant;
    child.interface.C0 = C0;
    child.is_cavity = enclosed_volume(piece) < 0.0;
    child.liquid = scene.liquids[child.is_cavity ? outer.outside : outer.inside];
    if (child.is_cavity) turn_inside_out(piece);
    child.interface.volume = enclosed_volume(piece);
    child.interface.mesh = std::move(piece);
    children.push_back(std::move(child));
  }
  // Not in the order of the faces, which numbering decides.
  std::ranges::stable_sort(children, {}, [](const Child& child) {
    return enclosed_centroid(child.interface.mesh).dot(generic_direction());
  });
  return children;
}

/// Signed sum of the children's volumes.
double enclosed_liquid(std::span<const Child> children) {
  double sum = 0.0;
  for (const Child& child : children)
    sum += child.is_cavity ? -child.interface.volume : child.interface.volume;
  return sum;
}

/// Gives what is missing to the children in equal parts, and round-off to the last.
void share_volume(std::vector<Child>& children, double volume) {
  const double missing = volume - enclosed_liquid(children);
  const auto drops = std::ranges::count(children, false, &Child::is_cavity);
  Child* last = nullptr;
  for (Child& child : children) {
    if (child.is_cavity) continue;
    child.interface.volume += missing / static_cast<double>(drops);
    last = &child;
  }
  if (last != nullptr) last->interface.volume += volume - enclosed_liquid(children);
}

/// Gives what the volumes kept exceed those of the triangulations by to the children in proportion.
void add_curved_part(std::vector<Child>& children, const LiquidVolume& volume) {
  const double factor = volume.kept / volume.of_faces;
  Child* last = nullptr;
  for (Child& child : children) {
    child.interface.volume *= factor;
    if (!child.is_cavity) last = &child;
  }
  if (last != nullptr) last->interface.volume += volume.kept - enclosed_liquid(children);
}

/// Without what bulk scalars multiply tensions by, which is known at the parents' vertices alone.
double energy(std::span<const Interface> interfaces) {
  double sum = 0.0;
  for (Interface each : interfaces) {
    each.tension_factor = {};
    sum += tension_energy(each);
  }
  return sum;
}

double area(std::span<const Interface> interfaces) {
  double sum = 0.0;
  for (const Interface& each : interfaces) sum += surface_area(each.mesh);
  return sum;
}

/// The scene with the children in the place of the parents; they are told their drops' ids.
Scene with_children(const Scene& scene, std::span<const std::size_t> parents,
                    std::span<Child> children) {
  Scene result = scene;
  result.interfaces.clear();
  result.liquids.resize(1);
  int next_id = 0;
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
    const Interface& interface = scene.interfaces[i];
    next_id = std::max(next_id, interface.drop + 1);
    if (std::ranges::find(parents, i) != parents.end()) continue;
    result.interfaces.push_back(interface);
    result.liquids.add(scene.liquids[interface.inside]);
  }
  for (Child& child : children) {
    child.interface.drop = next_id++;
    child.interface.initial_volume = child.interface.volume;
    result.interfaces.push_back(child.interface);
    result.liquids.add(child.liquid);
  }
  assign_regions(result);
  return result;
}

/// The regions on either side of the surfaces that an event joins. A parent that lies in another
/// one opens to the liquid around.
struct Sides {
  std::vector<RegionId> within, around;
};
Sides sides_of(const Scene& scene, std::span<const std::size_t> parents) {
  Sides sides{{}, {outermost(scene, parents).outside}};
  for (const std::size_t i : parents)
    (is_within_another(scene, parents, i) ? sides.around : sides.within)
        .push_back(scene.interfaces[i].inside);
  MENISCUS_ASSERT(!sides.within.empty(), "{} parents in each other", parents.size());
  std::ranges::sort(sides.around);
  std::ranges::sort(sides.within);
  return sides;
}

/// Where the liquid of each region of `after` was before the children came.
RegionSources region_sources(const Scene& scene, const Scene& after,
                             std::span<const std::size_t> parents,
                             std::span<const Child> children) {
  const Sides sides = sides_of(scene, parents);
  const auto of_old = [&](RegionId region) {
    MENISCUS_ASSERT(!std::ranges::binary_search(sides.within, region), "region {} is a parent's",
                    region.value);
    return std::ranges::binary_search(sides.around, region) ? sides.around : std::vector{region};
  };
  RegionSources sources(after.liquids.size());
  sources[RegionId{0}] = of_old(RegionId{0});
  std::size_t next = 0;
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i)
    if (std::ranges::find(parents, i) == parents.end())
      sources[after.interfaces[next++].inside] = of_old(scene.interfaces[i].inside);
  for (const Child& child : children)
    sources[after.interfaces[next++].inside] = child.is_cavity ? sides.around : sides.within;
  MENISCUS_ASSERT(next == after.interfaces.size(), "{} of {} interfaces", next,
                  after.interfaces.size());
  return sources;
}

}  // namespace

std::optional<Fault> replace_interfaces(Scene& scene, InterfaceReplacement replacement,
                                        TopologyEvent& event) {
  std::vector<Interface> parents;
  parents.reserve(replacement.parents.size());
  for (const std::size_t i : replacement.parents) parents.push_back(scene.interfaces[i]);
  const LiquidVolume volume = liquid_volume(scene, replacement.parents);
  std::vector<Child> children = children_of(scene, replacement);
  if (children.empty()) return Fault{FaultKind::no_volume, "nothing is left"};
  event.volume_moved = std::abs(volume.of_faces - enclosed_liquid(children));
  share_volume(children, volume.of_faces);
  std::vector<SurfaceMesh> cut;
  for (Child& child : children) {
    if (!(child.interface.volume > 0.0))
      return Fault{FaultKind::no_volume, "a fragment encloses nothing"};
    cut.push_back(child.interface.mesh);
    restore_volume(child.interface.mesh, child.interface.volume);
    if (auto defect = find_defect(child.interface.mesh)) return defect;
  }
  add_curved_part(children, volume);
  const FieldExcess excess = give_fields(scene, replacement, cut, children);
  Scene after = with_children(scene, replacement.parents, children);
  if (auto conflict = find_conflict(after)) return conflict;

  std::vector<Interface> born;
  for (const Interface& parent : parents) event.parents.push_back(parent.drop);
  for (const Child& child : children) {
    event.children.push_back(child.interface.drop);
    born.push_back(child.interface);
  }
  event.field_excess = excess;
  event.sources = region_sources(scene, after, replacement.parents, children);
  event.volume_before = volume.kept;
  event.volume_after = enclosed_liquid(children);
  event.area_before = area(parents);
  event.area_after = area(born);
  event.energy_before = energy(parents);
  event.energy_after = energy(born);
  scene = std::move(after);
  return {};
}

}  // namespace meniscus
