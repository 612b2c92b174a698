#include "meniscus/evolve/evolution.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "meniscus/core/error.hpp"
#include "meniscus/core/log.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/carry_fields.hpp"
#include "meniscus/surface/remesh.hpp"
#include "meniscus/topology/mend.hpp"

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

SurfaceMotion surface_motion(const Scene& scene, const InterfaceMotion& motion) {
  SurfaceMotion result;
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i)
    result.add(scene.interfaces[i].mesh, motion[i]);
  return result;
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

/// Says so whenever the largest excess so far has come to another power of two. What is below the
/// least size is round-off of values of order one.
void announce_growth(const FieldExcess& before, const FieldExcess& now, double t) {
  constexpr double kLeast = 1e-9;
  const double old = std::max(before.above, before.below), size = std::max(now.above, now.below);
  if (size < kLeast || std::ilogb(size) <= std::ilogb(old)) return;
  log::info("t = {:.6g}: to keep its amount a field left the range of its values by {:.3g}", t,
            size);
}

RegionSources liquid_sources(std::span<const TopologyEvent> events) {
  RegionSources sources;
  for (const TopologyEvent& event : events) sources = joined_sources(sources, event.sources);
  return sources;
}

double largest_tension(const Scene& scene) {
  double tension = 0.0;
  for (const Interface& interface : scene.interfaces)
    tension = std::max(tension, interface.tension);
  return tension;
}

}  // namespace

Evolution::Evolution(Scene scene, const EvolutionOptions& options, std::unique_ptr<FlowSolver> flow,
                     std::optional<MovingMesh> mesh)
    : options_(options), solver_(std::move(flow)) {
  state_.scene = std::move(scene);
  state_.mesh = std::move(mesh);
  state_.start_centroid = centroid_of_drops(state_.scene);
  state_.volume_shift.assign(state_.scene.interfaces.size(), 0.0);
}

EvolutionReport Evolution::prepare() {
  remesh_interfaces();
  return follow_interfaces();
}

EvolutionReport Evolution::solve() {
  flow_ = solve_flow({.t = state_.t});
  if (!flow_.ok) return {false, flow_.failure};
  const PhaseTimer timer(times_, "move interfaces");
  motion_ = normal_motion(state_.scene, flow_.velocity, options_.motion_normal);
  return {};
}

EvolutionReport Evolution::advance() {
  const Scene start = state_.scene;
  const std::vector<double> volume_shift = state_.volume_shift;
  const std::vector<TopologyEvent> events = state_.events;
  const std::int64_t connectivity = state_.connectivity;
  const FieldExcess excess = state_.field_excess;
  if (state_.mesh) state_.mesh->begin_step(start);
  state_.iterations = 0;
  EvolutionReport report;
  for (double dt = step_length(); dt >= options_.min_step; dt *= 0.5) {
    report = try_step(dt);
    if (report.ok) {
      if (state_.mesh) widen(state_.field_excess, state_.mesh->field_excess());
      state_.t += dt;
      state_.dt = dt;
      ++state_.step;
      for (const TopologyEvent& event : state_.events) announce(event, state_.t);
      announce_growth(excess, state_.field_excess, state_.t);
      return report;
    }
    state_.scene = start;
    state_.volume_shift = volume_shift;
    state_.events = events;
    state_.connectivity = connectivity;
    state_.field_excess = excess;
    if (state_.mesh) state_.mesh->undo();
    if (report.is_final) return report;
    warnings_.push_back(
        fmt::format("step {} of length {:.3g} failed: {}", state_.step + 1, dt, report.failure));
    log::warning("{}; trying a shorter one", warnings_.back());
    if (const FlowSolution again = solve_flow({.t = state_.t}); !again.ok)
      return {false, again.failure};
  }
  report.failure = fmt::format(
      "no step of length {:.3g} or more can be taken at t = {:.6g}: {}", options_.min_step,
      state_.t,
      report.failure.empty() ? "the interface's edges ask for a shorter one" : report.failure);
  report.ok = false;
  return report;
}

/// Table 1 of hooper2001, the flow at t_k being known: move to the half time, solve there, move the
/// whole step with that velocity, remesh. Explicit Euler leaves the half time out.
EvolutionReport Evolution::try_step(double dt) {
  const Scene start = state_.scene;
  if (options_.scheme == TimeScheme::euler) return finish_step(start, motion_, flow_, dt);

  timed(times_, "move interfaces", [&] { move_interfaces(state_.scene, motion_, 0.5 * dt); });
  if (EvolutionReport moved = move_mesh(start, motion_, flow_, 0.5 * dt); !moved.ok) return moved;
  const FlowSolution middle =
      solve_flow({.t = state_.t + 0.5 * dt, .dt = dt, .stage = Stage::middle});
  if (!middle.ok) return {false, middle.failure};
  const InterfaceMotion motion = timed(times_, "move interfaces", [&] {
    return normal_motion(state_.scene, middle.velocity, options_.motion_normal);
  });
  return finish_step(start, motion, middle, dt);
}

/// Moves the interfaces of `start` the whole step, then makes them and the mesh fit for the next.
EvolutionReport Evolution::finish_step(const Scene& start, const InterfaceMotion& motion,
                                       const FlowSolution& flow, double dt) {
  Scene& scene = state_.scene;
  state_.events.clear();
  if (EvolutionReport moved = move_whole_step(start, motion, dt); !moved.ok) return moved;
  if (is_remesh_due()) {
    const Scene moved = scene;
    carry_fields_of_mesh(start, flow, dt);
    if (EvolutionReport apart = refuse_touching(remesh_interfaces()); !apart.ok) return apart;
    if (EvolutionReport changed = change_topology(moved, motion); !changed.ok) return changed;
    return follow_interfaces(liquid_sources(state_.events));
  }
  restore_volumes();
  if (EvolutionReport apart = refuse_touching(false); !apart.ok) return apart;
  return move_mesh(start, mean_motion(start, scene, dt), flow, dt);
}

EvolutionReport Evolution::move_whole_step(const Scene& start, const InterfaceMotion& motion,
                                           double dt) {
  const PhaseTimer timer(times_, "move interfaces");
  Scene& scene = state_.scene;
  scene = start;
  move_interfaces(scene, motion, dt);
  if (std::string failure = find_wild_motion(start, scene); !failure.empty())
    return {false, std::move(failure)};
  if (options_.follows_drops)
    translate_interfaces(scene, state_.start_centroid - centroid_of_drops(scene));
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i)
    carry_fields(scene.interfaces[i], start.interfaces[i].mesh);
  return {};
}

/// The fields of an interface whose vertices moved.
void Evolution::carry_fields(Interface& interface, const SurfaceMesh& before) {
  if (interface.fields.empty()) return;
  widen(state_.field_excess, move_fields(interface.fields, before, interface.mesh));
}

/// Fields in the bulk ride to the end of the step before the mesh is made anew. Where cells would
/// be inverted on the way they are carried from where the mesh stands.
void Evolution::carry_fields_of_mesh(const Scene& start, const FlowSolution& flow, double dt) {
  if (!state_.mesh || state_.mesh->fields().empty()) return;
  const EvolutionReport moved = move_mesh(start, mean_motion(start, state_.scene, dt), flow, dt);
  if (!moved.ok) log::debug("fields are carried over a longer way: {}", moved.failure);
}

/// The mesh takes the interfaces as they have become.
EvolutionReport Evolution::follow_interfaces(const RegionSources& sources) {
  state_.connectivity = ++last_connectivity_;
  if (!state_.mesh) return {};
  const MeshChange change = state_.mesh->follow(state_.scene, sources);
  return {change.ok, change.failure};
}

EvolutionReport Evolution::move_mesh(const Scene& start, const InterfaceMotion& motion,
                                     const FlowSolution& flow, double dt) {
  if (!state_.mesh) return {};
  const MeshReport moved =
      state_.mesh->move(start, motion, flow.bulk ? flow.bulk->v : Field<TetVertexId, Vec3>(), dt);
  return {moved.ok, moved.failure};
}

double Evolution::step_length() const {
  double shortest = std::numeric_limits<double>::infinity();
  for (const Interface& interface : state_.scene.interfaces)
    shortest = std::min(shortest, shortest_edge(interface.mesh));
  if (options_.step_edges == StepEdges::mesh && state_.mesh)
    shortest = std::min(shortest, shortest_edge(state_.mesh->tetrahedra()));
  const double tension = largest_tension(state_.scene);
  const double capillary = tension > 0.0 ? std::min(1.0, 1.0 / tension) : 1.0;
  return std::min(options_.max_step, options_.step_factor * capillary * shortest);
}

/// Of every interface and the outer boundary; none where no gap is asked about or there is only one
/// of them.
std::vector<SurfaceTree> Evolution::trees_for_gaps() const {
  std::vector<SurfaceTree> trees;
  const std::size_t num_surfaces =
      state_.scene.interfaces.size() + (state_.scene.is_unbounded ? 0 : 1);
  if (options_.gap_layers == 0.0 || num_surfaces < 2) return trees;
  for (const Interface& interface : state_.scene.interfaces) trees.emplace_back(interface.mesh);
  if (!state_.scene.is_unbounded) trees.emplace_back(state_.scene.boundary.mesh);
  return trees;
}

/// Whether all could be.
bool Evolution::remesh_interfaces() {
  const PhaseTimer timer(times_, "remesh surface");
  bool are_remeshed = true;
  std::vector<SurfaceTree> trees = trees_for_gaps();
  for (std::size_t i = 0; i < state_.scene.interfaces.size(); ++i) {
    Interface& interface = state_.scene.interfaces[i];
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
    const MendReport mended =
        options_.topology.is_off()
            ? MendReport{.remesh = remesh(interface.mesh, options, interface.fields)}
            : remesh_or_mend(interface.mesh, options, interface.fields);
    const RemeshReport& report = mended.remesh;
    widen(state_.field_excess, report.field_excess);
    if (mended.is_mended) {
      const std::string what = mended.smoothed_over > 0.0
                                   ? fmt::format("drop {} was smoothed over {:.4g}", interface.drop,
                                                 mended.smoothed_over)
                                   : fmt::format("creases of drop {} were rounded", interface.drop);
      warnings_.push_back(fmt::format("t = {:.6g}: {}, {} holes through it closed, to remesh it",
                                      state_.t, what, mended.closed_holes));
      log::warning("{}", warnings_.back());
    }
    state_.volume_shift[i] = report.volume_shift;
    if (report.ok && options_.surface != SurfaceShape::faceted)
      state_.volume_shift[i] = restore_volume_of(interface);
    if (report.ok && i < trees.size()) trees[i] = SurfaceTree(interface.mesh);
    if (report.ok) continue;
    are_remeshed = false;
    warnings_.push_back(fmt::format("drop {} was not remeshed at t = {:.6g}: {}", interface.drop,
                                    state_.t, report.failure));
    log::warning("{}", warnings_.back());
    state_.volume_shift[i] = restore_volume_of(interface);
  }
  return are_remeshed;
}

/// A step that makes drops touch, or one itself, is refused: with coalescence a shorter one lets
/// them come close first, without it drops stay apart. A surface that could be remeshed is known
/// not to touch itself.
EvolutionReport Evolution::refuse_touching(bool are_remeshed) const {
  const PhaseTimer timer(times_, "topology");
  std::string touching = find_touching_drops(state_.scene);
  if (touching.empty() && !are_remeshed) touching = find_folded_drop(state_.scene);
  if (touching.empty()) return {};
  if (!options_.topology.coalescence)
    touching += "; topology.coalescence = \"off\" keeps them apart";
  return {false, std::move(touching)};
}

/// Cuts and bridges what is due in the interfaces as remeshed; `moved` with `motion` says how they
/// came there.
EvolutionReport Evolution::change_topology(const Scene& moved, const InterfaceMotion& motion) {
  TopologyReport changed = timed(times_, "topology", [&] {
    return apply_topology(state_.scene, options_.topology, surface_motion(moved, motion));
  });
  for (std::string& warning : changed.warnings)
    warnings_.push_back(fmt::format("t = {:.6g}: {}", state_.t, warning));
  if (!changed.refusal.empty()) return {false, std::move(changed.refusal), true};
  if (changed.events.empty()) return {};
  widen(state_.field_excess, changed.finishing_excess);
  for (const TopologyEvent& event : changed.events) widen(state_.field_excess, event.field_excess);
  state_.events = std::move(changed.events);
  state_.volume_shift.assign(state_.scene.interfaces.size(), 0.0);
  return refuse_touching(remesh_interfaces());
}

void Evolution::restore_volumes() {
  const PhaseTimer timer(times_, "move interfaces");
  for (std::size_t i = 0; i < state_.scene.interfaces.size(); ++i)
    state_.volume_shift[i] = restore_volume_of(state_.scene.interfaces[i]);
}

/// The size of the shift [R0].
double Evolution::restore_volume_of(Interface& interface) {
  const SurfaceMesh before = interface.fields.empty() ? SurfaceMesh() : interface.mesh;
  const double shift = restore_volume(interface.mesh, interface.volume, options_.surface);
  carry_fields(interface, before);
  return std::abs(shift);
}

FlowSolution Evolution::solve_flow(const Instant& instant) {
  if (state_.mesh) state_.mesh->place_interfaces(state_.scene);
  FlowSolution solution = solver_->solve(state_.domain(), instant);
  state_.iterations += solution.iterations;
  for (const std::string& warning : solution.warnings)
    warnings_.push_back(fmt::format("t = {:.6g}: {}", instant.t, warning));
  return solution;
}

HistoryRow Evolution::history_row() const {
  const PhaseTimer timer(times_, "diagnostics");
  return meniscus::history_row(state_, flow_, motion_, options_.surface);
}

std::vector<DropRow> Evolution::drop_rows() const {
  const PhaseTimer timer(times_, "diagnostics");
  return meniscus::drop_rows(state_, options_.surface, options_.topology.breakup_radius);
}

double Evolution::seconds_in(const std::string& phase) const {
  return times_[phase] + solver_->times()[phase] +
         (state_.mesh ? state_.mesh->times()[phase] : 0.0);
}

void Evolution::set_interface_fields(std::vector<SurfaceFields> fields) {
  meniscus::set_interface_fields(state_, std::move(fields));
}

void Evolution::set_bulk_fields(VolumeFields fields) {
  if (!state_.mesh) reject_input("fields in the bulk need a volume mesh; this solver has none");
  state_.mesh->set_fields(std::move(fields));
}

void Evolution::save(Archive& archive) const {
  meniscus::save(state_, archive);
  solver_->save(archive, state_.domain());
}

void Evolution::load(const Archive& archive) {
  meniscus::load(state_, archive);
  state_.connectivity = ++last_connectivity_;
  solver_->load(archive, state_.domain());
}

}  // namespace meniscus
