#include "meniscus/topology/apply_topology.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <tuple>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/box_tree.hpp"
#include "meniscus/mesh/sphere_radius.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/isotropic_remesh.hpp"
#include "meniscus/surface/repair/mend.hpp"
#include "meniscus/surface/sizing.hpp"
#include "meniscus/topology/bridge_gap.hpp"
#include "meniscus/topology/constants.hpp"
#include "meniscus/topology/cut_neck.hpp"
#include "meniscus/topology/successors.hpp"

namespace meniscus {
namespace {

/// Distance from a place dealt with, in neck radii or gaps, within which nothing else is due in the
/// same call. It is beyond the band that was cut and the hole that was opened.
constexpr double kWaiting = 4.0;
/// Far beyond what one step can bring about: ends a scene of events that make each other.
constexpr int kMaxEvents = 1000;

/// The places that a call has dealt with.
class DonePlaces {
 public:
  void add(const Vec3& place, double size) { places_.emplace_back(place, kWaiting * size); }
  [[nodiscard]] bool contain(const Vec3& x) const {
    return std::ranges::any_of(
        places_, [&](const auto& place) { return (x - place.first).norm() < place.second; });
  }

 private:
  std::vector<std::pair<Vec3, double>> places_;
};

/// One neck of one interface.
struct DueNeck {
  std::size_t interface = 0;
  Side side = Side::inside;
  Neck neck;
};

/// Finds the necks of a scene, those of an interface that has not changed only once: an id stands
/// for one mesh during a call.
class NeckSearch {
 public:
  NeckSearch(const TopologyOptions& options, const SurfaceMotion& motion)
      : inside_(options.breakup_radius),
        outside_(options.coalescence ? 0.5 * options.coalescence_gap : 0.0),
        motion_(motion) {}

  /// The thinnest neck that is due.
  std::optional<DueNeck> thinnest(const Scene& scene, const DonePlaces& done) {
    std::optional<DueNeck> best;
    for (std::size_t i = 0; i < scene.interfaces.size(); ++i)
      for (const auto& [side, neck] : necks_of(scene.interfaces[i])) {
        if (done.contain(neck.center)) continue;
        if (!best || rank(neck) < rank(best->neck)) best = DueNeck{i, side, neck};
      }
    return best;
  }

 private:
  using SidedNecks = std::vector<std::pair<Side, Neck>>;

  static std::tuple<double, double, double, double> rank(const Neck& neck) {
    return {neck.radius, neck.center.x(), neck.center.y(), neck.center.z()};
  }
  const SidedNecks& necks_of(const Interface& interface) {
    const auto [found, is_new] = known_.try_emplace(interface.drop);
    if (!is_new || (inside_ == 0.0 && outside_ == 0.0)) return found->second;
    const SurfaceTree tree(interface.mesh);
    for (const auto& [side, radius] : {std::pair(Side::inside, inside_), {Side::outside, outside_}})
      if (radius > 0.0)
        for (Neck& neck : find_necks(interface.mesh, tree, side, radius, motion_))
          found->second.emplace_back(side, std::move(neck));
    return found->second;
  }

  double inside_, outside_;
  const SurfaceMotion& motion_;
  std::map<int, SidedNecks> known_;
};

/// Whether a cut would take off less than a ball as wide as the neck: the end of a point, no drop.
bool clips_an_end(const Surgery& surgery, double radius) {
  const double ball = 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3);
  return std::ranges::any_of(surgery.pieces, [&](const SurfaceMesh& piece) {
    return std::abs(enclosed_volume(piece)) < ball;
  });
}

double most_added_area(const Scene& scene, std::span<const std::size_t> parents) {
  MENISCUS_ASSERT(!parents.empty());
  double volume = 0.0;
  for (const std::size_t i : parents)
    volume = std::max(volume, enclosed_volume(scene.interfaces[i].mesh));
  MENISCUS_ASSERT(volume > 0.0, "parents of volume {}", volume);
  const double radius = sphere_radius(volume);
  return kMostAddedByEvent * 4.0 * std::numbers::pi * radius * radius;
}

/// Replaces interfaces, unless that adds too much area: then the scene stays, with the reason.
std::optional<Fault> replace_with_little_area(Scene& scene, InterfaceReplacement replacement,
                                              TopologyEvent& event) {
  const double most_added = most_added_area(scene, replacement.parents);
  Scene after = scene;
  if (auto fault = replace_interfaces(after, std::move(replacement), event)) return fault;
  if (event.area_after - event.area_before > most_added)
    return Fault{FaultKind::added_area, "it would add area", event.position};
  scene = std::move(after);
  return {};
}

std::optional<Fault> cut(Scene& scene, const DueNeck& due, Surgery surgery, TopologyEvent& event) {
  event.position = due.neck.center;
  if (due.side == Side::inside) {
    event.kind = EventKind::breakup;
    event.neck_radius = due.neck.radius;
  } else {
    event.kind = EventKind::coalescence;
    event.gap = 2.0 * due.neck.radius;
  }
  if (surgery.fault) return std::move(surgery.fault);
  return replace_with_little_area(
      scene, {{due.interface}, std::move(surgery.pieces), std::move(surgery.refined)}, event);
}

void cut_necks(Scene& scene, const TopologyOptions& options, const SurfaceMotion& motion,
               DonePlaces& done, TopologyReport& report) {
  NeckSearch search(options, motion);
  for (int i = 0; i < kMaxEvents; ++i) {
    const std::optional<DueNeck> due = search.thinnest(scene, done);
    if (!due) return;
    // The two caps are no film to be opened, nor is what lies between the caps in a closed hole.
    done.add(due->neck.center, std::max(due->neck.radius, options.coalescence_gap));
    Surgery surgery = cut_neck(scene.interfaces[due->interface].mesh, due->neck);
    if (clips_an_end(surgery, due->neck.radius)) continue;
    TopologyEvent event;
    if (const auto fault = cut(scene, *due, std::move(surgery), event)) {
      report.warnings.push_back(fmt::format(
          "the neck of radius {:.4g} of drop {} at {} was not cut: {}", due->neck.radius,
          scene.interfaces[due->interface].drop, text_of(due->neck.center), fault->text));
    } else {
      report.events.push_back(std::move(event));
    }
  }
}

/// Why two drops may not merge; none when they may.
std::optional<std::string> unlikeness(const Scene& scene, const Gap& gap) {
  if (gap.a == gap.b) return {};
  const Interface &a = scene.interfaces[gap.a], &b = scene.interfaces[gap.b];
  const bool is_nested = a.outside != b.outside;
  const Liquid &first = scene.liquids[is_nested && a.inside == b.outside ? a.outside : a.inside],
               &second = scene.liquids[is_nested && b.inside == a.outside ? b.outside : b.inside];
  if (first.viscosity != second.viscosity)
    return fmt::format("viscosity ratios {:g} and {:g}", first.viscosity, second.viscosity);
  if (first.density != second.density)
    return fmt::format("densities {:g} and {:g}", first.density, second.density);
  if (first.law != second.law) return "different laws of viscosity";
  if (a.tension != b.tension)
    return fmt::format("surface tensions {:g} and {:g}", a.tension, b.tension);
  if (a.surfactant != b.surfactant) return "different surfactants";
  for (std::size_t k = 0; k < first.scalars.size(); ++k)
    if (first.scalars[k].capacity != second.scalars[k].capacity ||
        first.scalars[k].conductivity != second.scalars[k].conductivity ||
        first.scalars[k].source != second.scalars[k].source)
      return fmt::format("they take up {} differently", scene.scalars[k].name);
  if (first.body_force != second.body_force) return "different body forces";
  return {};
}

std::optional<Fault> open_gap(Scene& scene, const Gap& gap, const TopologyOptions& options,
                              TopologyEvent& event) {
  event.kind = EventKind::coalescence;
  event.position = gap.middle();
  event.gap = gap.width;
  Surgery surgery = bridge_gap(scene, gap, {options.coalescence_gap, options.edge_floor});
  if (surgery.fault) return std::move(surgery.fault);
  InterfaceReplacement replacement{{gap.a}, std::move(surgery.pieces), std::move(surgery.refined)};
  if (gap.b != gap.a) replacement.parents.push_back(gap.b);
  return replace_with_little_area(scene, std::move(replacement), event);
}

void open_gaps(Scene& scene, const TopologyOptions& options, const SurfaceMotion& motion,
               DonePlaces& done, TopologyReport& report) {
  GapSearch search(options.coalescence_gap, motion);
  for (int i = 0; i < kMaxEvents; ++i) {
    const std::vector<Gap> gaps = search.gaps(scene);
    const auto due =
        std::ranges::find_if(gaps, [&](const Gap& gap) { return !done.contain(gap.middle()); });
    if (due == gaps.end()) return;
    done.add(due->middle(), options.coalescence_gap);
    const int a = scene.interfaces[due->a].drop, b = scene.interfaces[due->b].drop;
    if (const auto why = unlikeness(scene, *due)) {
      report.refusal =
          Fault{FaultKind::unlike_liquids,
                fmt::format("drops {} and {} have come within {:.4g} of each other at {} and would "
                            "merge, but their liquids are unlike ({})",
                            a, b, due->width, text_of(due->middle()), *why),
                due->middle()};
      return;
    }
    TopologyEvent event;
    if (const auto fault = open_gap(scene, *due, options, event)) {
      report.warnings.push_back(
          fmt::format("the gap of {:.4g} between drops {} and {} at {} was not bridged: {}",
                      due->width, a, b, text_of(due->middle()), fault->text));
    } else {
      report.events.push_back(std::move(event));
    }
  }
}

int next_id(const Scene& scene) {
  int id = 0;
  for (const Interface& interface : scene.interfaces) id = std::max(id, interface.drop + 1);
  return id;
}

/// Gives a small drop even triangles before it is remeshed: the remesher alone does not bring it to
/// its fewest vertices.
void give_vertices(Interface& interface, const RemeshOptions& options, FieldExcess& excess) {
  const double area = surface_area(interface.mesh), volume = enclosed_volume(interface.mesh);
  const double edge = length_of_density(1.5 * static_cast<double>(options.min_vertices) / area);
  std::optional<Replacement> even = sound_replacement(
      interface.mesh, interface.fields, isotropic_remesh(interface.mesh, edge), volume);
  if (!even) return;
  interface.mesh = std::move(even->surface.mesh);
  interface.fields = std::move(even->surface.fields);
  follow(excess, even->excess);
  // The surface is sound even if it cannot be remeshed.
  follow(excess, remesh(interface.mesh, options, interface.fields).field_excess);
}

/// Remeshes the interfaces that have ids from `first_id` on: the seams of surgery give way, and a
/// small drop gets its vertices. What cannot be remeshed stays as it is: it is sound already.
/// Returns by how much fields left their range on the way.
FieldExcess finish_new_interfaces(Scene& scene, int first_id, const TopologyOptions& topology) {
  constexpr int kRemeshings = 2;  // a density far from the wanted one takes more than one
  const Scene before = scene;
  FieldExcess excess;
  for (Interface& interface : scene.interfaces) {
    if (interface.drop < first_id) continue;
    const RemeshOptions options = sound_remeshing(interface.C0, topology.edge_floor);
    for (int i = 0; i < kRemeshings; ++i) {
      const RemeshReport report = remesh_or_mend(interface.mesh, options, interface.fields).remesh;
      follow(excess, report.field_excess);
      if (!report.ok()) break;
    }
    if (interface.mesh.num_vertices() < options.min_vertices)
      give_vertices(interface, options, excess);
  }
  if (!find_conflict(scene)) return excess;
  scene = before;
  return {};
}

}  // namespace

TopologyReport apply_topology(Scene& scene, const TopologyOptions& options,
                              const SurfaceMotion& motion) {
  TopologyReport report;
  if (options.is_off()) return report;
  const Scene before = scene;
  const int first_id = next_id(scene);
  DonePlaces done;
  cut_necks(scene, options, motion, done, report);
  if (options.coalescence && options.coalescence_gap > 0.0)
    open_gaps(scene, options, motion, done, report);
  if (report.refusal) {
    scene = before;
    report.events.clear();
  }
  if (!report.events.empty())
    report.finishing_excess = finish_new_interfaces(scene, first_id, options);
  return report;
}

std::optional<Fault> find_touching_drops(const Scene& scene) {
  std::vector<Box> bounds;
  bounds.reserve(scene.interfaces.size());
  for (const Interface& interface : scene.interfaces)
    bounds.push_back(bounding_box(interface.mesh));
  const BoxTree boxes(bounds);
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i)
    for (const std::size_t j : boxes.earlier_within(i, 0.0)) {
      const Interface &a = scene.interfaces[j], &b = scene.interfaces[i];
      if (auto meeting = find_intersection(a.mesh, b.mesh))
        return with_context(fmt::format("drops {} and {} touch", a.drop, b.drop),
                            *std::move(meeting));
    }
  return {};
}

std::optional<Fault> find_folded_drop(const Scene& scene) {
  for (const Interface& interface : scene.interfaces)
    if (auto meeting = find_self_intersection(interface.mesh))
      return with_context(fmt::format("drop {} touches itself", interface.drop),
                          *std::move(meeting));
  return {};
}

}  // namespace meniscus
