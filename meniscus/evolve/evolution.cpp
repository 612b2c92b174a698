#include "meniscus/evolve/evolution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "meniscus/core/error.hpp"
#include "meniscus/core/log.hpp"
#include "meniscus/evolve/drop_stress.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/curved_measures.hpp"
#include "meniscus/surface/remesh.hpp"
#include "meniscus/topology/mend.hpp"
#include "meniscus/topology/necks.hpp"
#include "meniscus/volume/quality.hpp"

namespace meniscus {
namespace {

/// Velocity that carries the interfaces of `start` to those of `end` in dt.
InterfaceMotion mean_motion(const Scene& start, const Scene& end, double dt) {
  InterfaceMotion motion;
  for (std::size_t i = 0; i < start.interfaces.size(); ++i) {
    const VertexField<Vec3>&x0 = start.interfaces[i].mesh.x, &x1 = end.interfaces[i].mesh.x;
    VertexField<Vec3>& w = motion.emplace_back(x0.size());
    for (const VertexId v : w.ids()) w[v] = (x1[v] - x0[v]) / dt;
  }
  return motion;
}

/// A flow that is solved keeps volumes to a thousandth or so. One that is not may throw vertices
/// about; remeshing or mending what that leaves would hide it.
std::string find_wild_motion(const Scene& start, const Scene& end) {
  for (std::size_t i = 0; i < end.interfaces.size(); ++i) {
    const Interface& interface = end.interfaces[i];
    if (!is_finite(interface.mesh)) return "an interface vertex left all bounds";
    const double ratio =
        enclosed_volume(interface.mesh) / enclosed_volume(start.interfaces[i].mesh);
    if (!(ratio > 0.5 && ratio < 2.0))
      return fmt::format("the step takes drop {} to {:.3g} times its volume", interface.drop,
                         ratio);
  }
  return {};
}

std::optional<double> smallest_gap(const Scene& scene) {
  double gap = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
    for (std::size_t j = i + 1; j < scene.interfaces.size(); ++j)
      gap = std::min(gap, smallest_gap(scene.interfaces[i].mesh, scene.interfaces[j].mesh));
    if (!scene.is_unbounded)
      gap = std::min(gap, smallest_gap(scene.interfaces[i].mesh, scene.boundary.mesh));
  }
  return std::isfinite(gap) ? std::optional(gap) : std::nullopt;
}

SurfaceMotion surface_motion(const Scene& scene, const InterfaceMotion& motion) {
  SurfaceMotion result;
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i)
    result.add(scene.interfaces[i].mesh, motion[i]);
  return result;
}

/// The radius of the circle of the same area as the section of the thinnest neck, of those thinner
/// than half of the sphere of the same volume; on the smooth surface where faces are curved.
std::optional<double> thinnest_neck(const Interface& interface, SurfaceShape faces) {
  const SurfaceMesh& mesh = interface.mesh;
  const SurfaceTree tree(mesh);
  const double sphere = std::cbrt(0.75 * interface.volume / std::numbers::pi);
  const std::vector<Neck> necks =
      find_necks(mesh, tree, Side::inside, 0.5 * sphere, SurfaceMotion());
  if (necks.empty()) return std::nullopt;
  const Neck& neck = necks.front();
  double area = neck.area;
  if (faces != SurfaceShape::faceted) {
    const SectionResult there =
        section_around(mesh, tree, neck.center, neck.axis, 4.0 * neck.radius);
    if (there.kind == SectionKind::closed)
      area = smooth_area(there.section, mesh, SmoothSurface(mesh, SurfaceTopology(mesh)));
  }
  return std::sqrt(area / std::numbers::pi);
}

std::string text_of(std::span<const int> ids) { return fmt::format("{}", fmt::join(ids, ", ")); }

void announce(const TopologyEvent& event, double t) {
  const auto [kind, size, what] =
      event.kind == EventKind::breakup
          ? std::tuple("breakup", *event.neck_radius, "a neck of radius")
          : std::tuple("coalescence", *event.gap, "a gap of");
  log::info("{} at t = {:.6g}: drop {} -> {}, at {} {:.3g} near ({:.4g}, {:.4g}, {:.4g})", kind, t,
            text_of(event.parents), text_of(event.children), what, size, event.place.x(),
            event.place.y(), event.place.z());
}

double largest_tension(const Scene& scene) {
  double tension = 0.0;
  for (const Interface& interface : scene.interfaces)
    tension = std::max(tension, interface.tension);
  return tension;
}

}  // namespace

Evolution::Evolution(Scene scene, const EvolutionOptions& options, std::unique_ptr<FlowSolver> flow)
    : scene_(std::move(scene)),
      options_(options),
      flow_(std::move(flow)),
      centroid_(centroid_of_drops(scene_)),
      correction_(scene_.interfaces.size(), 0.0) {}

EvolutionReport Evolution::prepare() {
  remesh_interfaces();
  const FlowReport made = flow_->rebuild(scene_);
  return {made.ok, made.failure};
}

EvolutionReport Evolution::solve() {
  const FlowReport solved = solve_flow(t_);
  if (!solved.ok) return {false, solved.failure};
  motion_ = normal_motion(scene_, flow_->velocity(), options_.motion_normal);
  return {};
}

EvolutionReport Evolution::advance() {
  const Scene start = scene_;
  const std::vector<double> correction = correction_;
  const std::vector<TopologyEvent> events = events_;
  flow_->mark(scene_);
  iterations_ = 0;
  EvolutionReport report;
  for (double dt = step_length(); dt >= options_.min_step; dt *= 0.5) {
    report = try_step(dt);
    if (report.ok) {
      t_ += dt;
      dt_ = dt;
      ++step_;
      for (const TopologyEvent& event : events_) announce(event, t_);
      return report;
    }
    scene_ = start;
    correction_ = correction;
    events_ = events;
    if (report.is_final) return report;
    warnings_.push_back(
        fmt::format("step {} of length {:.3g} failed: {}", step_ + 1, dt, report.failure));
    log::warning("{}; trying a shorter one", warnings_.back());
    const InterfaceMotion rest(mean_motion(start, start, 1.0));
    if (const FlowReport back = flow_->move_from_mark(start, rest, 0.0); !back.ok)
      return {false, back.failure};
    if (const FlowReport again = solve_flow(t_); !again.ok) return {false, again.failure};
  }
  report.failure = fmt::format(
      "no step of length {:.3g} or more can be taken at t = {:.6g}: {}", options_.min_step, t_,
      report.failure.empty() ? "the interface's edges ask for a shorter one" : report.failure);
  report.ok = false;
  return report;
}

/// Table 1 of hooper2001, the flow at t_k being known: move to the half time, solve there, move the
/// whole step with that velocity, remesh. Explicit Euler leaves the half time out.
EvolutionReport Evolution::try_step(double dt) {
  const Scene start = scene_;
  if (options_.scheme == TimeScheme::euler) return finish_step(start, motion_, dt);

  move_interfaces(scene_, motion_, 0.5 * dt);
  if (const FlowReport moved = flow_->move_from_mark(start, motion_, 0.5 * dt); !moved.ok)
    return {false, moved.failure};
  if (const FlowReport solved = solve_flow(t_ + 0.5 * dt); !solved.ok)
    return {false, solved.failure};
  const InterfaceMotion middle = normal_motion(scene_, flow_->velocity(), options_.motion_normal);
  return finish_step(start, middle, dt);
}

EvolutionReport Evolution::finish_step(const Scene& start, const InterfaceMotion& motion,
                                       double dt) {
  scene_ = start;
  events_.clear();
  move_interfaces(scene_, motion, dt);
  if (std::string failure = find_wild_motion(start, scene_); !failure.empty())
    return {false, std::move(failure)};
  if (options_.follows_drops) translate_interfaces(scene_, centroid_ - centroid_of_drops(scene_));
  if (is_remesh_due()) {
    const Scene moved = scene_;
    if (EvolutionReport apart = refuse_touching(remesh_interfaces()); !apart.ok) return apart;
    if (EvolutionReport changed = change_topology(moved, motion); !changed.ok) return changed;
    const FlowReport made = flow_->rebuild(scene_);
    return {made.ok, made.failure};
  }
  restore_volumes();
  if (EvolutionReport apart = refuse_touching(false); !apart.ok) return apart;
  const FlowReport moved = flow_->move_from_mark(start, mean_motion(start, scene_, dt), dt);
  return {moved.ok, moved.failure};
}

double Evolution::step_length() const {
  double shortest = std::numeric_limits<double>::infinity();
  for (const Interface& interface : scene_.interfaces)
    shortest = std::min(shortest, shortest_edge(interface.mesh));
  if (options_.step_edges == StepEdges::mesh)
    shortest = std::min(shortest, flow_->shortest_mesh_edge());
  const double tension = largest_tension(scene_);
  const double capillary = tension > 0.0 ? std::min(1.0, 1.0 / tension) : 1.0;
  return std::min(options_.max_step, options_.step_factor * capillary * shortest);
}

/// Of every interface and the outer boundary; none where no gap is asked about or there is only one
/// of them.
std::vector<SurfaceTree> Evolution::trees_for_gaps() const {
  std::vector<SurfaceTree> trees;
  const std::size_t num_surfaces = scene_.interfaces.size() + (scene_.is_unbounded ? 0 : 1);
  if (options_.gap_layers == 0.0 || num_surfaces < 2) return trees;
  for (const Interface& interface : scene_.interfaces) trees.emplace_back(interface.mesh);
  if (!scene_.is_unbounded) trees.emplace_back(scene_.boundary.mesh);
  return trees;
}

/// Whether all could be.
bool Evolution::remesh_interfaces() {
  const PhaseTimer timer(times_, "remesh surface");
  bool are_remeshed = true;
  std::vector<SurfaceTree> trees = trees_for_gaps();
  for (std::size_t i = 0; i < scene_.interfaces.size(); ++i) {
    Interface& interface = scene_.interfaces[i];
    RemeshOptions options;
    options.C0 = interface.C0;
    options.restores_volume = options_.surface == SurfaceShape::faceted;
    if (options.restores_volume) options.volume = interface.volume;
    options.equilibrium = options_.equilibrium;
    options.edge_floor = options_.edge_floor;
    options.gap_layers = options_.gap_layers;
    for (std::size_t j = 0; j < trees.size(); ++j)
      if (j != i) options.neighbours.push_back(&trees[j]);
    options.find_fault = find_self_intersection;
    // Only flows through changes of topology draw creases that nothing will smooth again.
    const MendReport mended = options_.topology.is_off()
                                  ? MendReport{.remesh = remesh(interface.mesh, options)}
                                  : remesh_or_mend(interface.mesh, options);
    const RemeshReport& report = mended.remesh;
    if (mended.is_mended) {
      const std::string what = mended.smoothed_over > 0.0
                                   ? fmt::format("drop {} was smoothed over {:.4g}", interface.drop,
                                                 mended.smoothed_over)
                                   : fmt::format("creases of drop {} were rounded", interface.drop);
      warnings_.push_back(fmt::format("t = {:.6g}: {}, {} holes through it closed, to remesh it",
                                      t_, what, mended.closed_holes));
      log::warning("{}", warnings_.back());
    }
    correction_[i] = report.volume_shift;
    if (report.ok && options_.surface != SurfaceShape::faceted)
      correction_[i] = std::abs(restore_volume(interface.mesh, interface.volume, options_.surface));
    if (report.ok && i < trees.size()) trees[i] = SurfaceTree(interface.mesh);
    if (report.ok) continue;
    are_remeshed = false;
    warnings_.push_back(fmt::format("drop {} was not remeshed at t = {:.6g}: {}", interface.drop,
                                    t_, report.failure));
    log::warning("{}", warnings_.back());
    correction_[i] = std::abs(restore_volume(interface.mesh, interface.volume, options_.surface));
  }
  return are_remeshed;
}

/// A step that makes drops touch, or one itself, is refused: with coalescence a shorter one lets
/// them come close first, without it drops stay apart. A surface that could be remeshed is known
/// not to touch itself.
EvolutionReport Evolution::refuse_touching(bool are_remeshed) const {
  std::string touching = find_touching_drops(scene_);
  if (touching.empty() && !are_remeshed) touching = find_folded_drop(scene_);
  if (touching.empty()) return {};
  if (!options_.topology.coalescence)
    touching += "; topology.coalescence = \"off\" keeps them apart";
  return {false, std::move(touching)};
}

/// Cuts and bridges what is due in the interfaces as remeshed; `moved` with `motion` says how they
/// came there.
EvolutionReport Evolution::change_topology(const Scene& moved, const InterfaceMotion& motion) {
  TopologyReport changed = apply_topology(scene_, options_.topology, surface_motion(moved, motion));
  for (std::string& warning : changed.warnings)
    warnings_.push_back(fmt::format("t = {:.6g}: {}", t_, warning));
  if (!changed.refusal.empty()) return {false, std::move(changed.refusal), true};
  if (changed.events.empty()) return {};
  events_ = std::move(changed.events);
  correction_.assign(scene_.interfaces.size(), 0.0);
  return refuse_touching(remesh_interfaces());
}

void Evolution::restore_volumes() {
  for (std::size_t i = 0; i < scene_.interfaces.size(); ++i)
    correction_[i] = std::abs(
        restore_volume(scene_.interfaces[i].mesh, scene_.interfaces[i].volume, options_.surface));
}

FlowReport Evolution::solve_flow(double t) {
  FlowReport report = flow_->solve(scene_, t);
  iterations_ += report.iterations;
  for (const std::string& warning : report.warnings)
    warnings_.push_back(fmt::format("t = {:.6g}: {}", t, warning));
  return report;
}

HistoryRow Evolution::history_row() const {
  const PhaseTimer timer(times_, "diagnostics");
  HistoryRow row;
  row.step = step_;
  row.t = t_;
  row.dt = dt_;
  row.drops = static_cast<int>(scene_.interfaces.size());
  for (const Interface& interface : scene_.interfaces)
    row.surface_nodes += interface.mesh.num_vertices();
  if (const TetMesh* mesh = flow_->volume_mesh()) {
    row.nodes = mesh->num_vertices();
    row.tetrahedra = mesh->num_cells();
    row.min_dihedral_deg = quality(*mesh).min_dihedral_deg;
  }
  row.min_gap = smallest_gap(scene_);
  row.linear_iterations = iterations_;
  if (const std::optional<Power> power = flow_->power()) {
    row.power_in = power->in;
    row.dissipation = power->dissipation;
  }
  row.surface_rate = surface_energy_rate(scene_, motion_, options_.surface);
  if (is_newtonian(scene_.liquids[RegionId{0}].law))
    row.stress = drop_stress(scene_, flow_->velocity(), options_.surface, flow_->excess_stress());
  return row;
}

std::vector<DropRow> Evolution::drop_rows() const {
  std::vector<DropRow> rows;
  for (std::size_t i = 0; i < scene_.interfaces.size(); ++i) {
    const Interface& interface = scene_.interfaces[i];
    DropRow& row = rows.emplace_back();
    row.drop = interface.drop;
    row.parent = interface.parent;
    row.shape = drop_shape(interface.mesh, scene_.flow.family());
    if (options_.surface != SurfaceShape::faceted) {
      const CurvedMeasures curved = curved_measures(interface.mesh, options_.surface);
      row.shape.volume = curved.volume;
      row.shape.area = curved.area;
      row.shape.D_inertia = inertial_deformation(curved.second_moments, curved.volume);
    }
    row.volume_drift = row.shape.volume / interface.initial_volume - 1.0;
    row.volume_correction = correction_[i];
    if (options_.topology.breakup_radius > 0.0)
      row.neck_radius = thinnest_neck(interface, options_.surface);
  }
  return rows;
}

}  // namespace meniscus
