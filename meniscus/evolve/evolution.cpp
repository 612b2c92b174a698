#include "meniscus/evolve/evolution.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/core/log.hpp"
#include "meniscus/evolve/energy_check.hpp"
#include "meniscus/evolve/kinematic_condition.hpp"
#include "meniscus/evolve/remesh_interfaces.hpp"
#include "meniscus/evolve/stability.hpp"
#include "meniscus/evolve/step_start.hpp"
#include "meniscus/evolve/time_schemes.hpp"
#include "meniscus/evolve/topology_step.hpp"
#include "meniscus/evolve/volume_restoration.hpp"
#include "meniscus/linear/shared_work.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/scene/interface_tension.hpp"
#include "meniscus/surface/carry_fields.hpp"
#include "meniscus/volume/tetrahedralize.hpp"

namespace meniscus {
namespace {

RegionSources liquid_sources(std::span<const TopologyEvent> events) {
  RegionSources sources;
  for (const TopologyEvent& event : events) sources = joined_sources(sources, event.sources);
  return sources;
}

/// The flow that carries scalars through a whole step.
const FlowSolution& scalar_carrier(const StageFlow& whole) {
  return whole.carrier ? *whole.carrier : whole.flow;
}

/// Whether a linear flow takes what is off its centre further away: exponentially, not as shear.
bool is_repelling(const Mat3& gradient) {
  constexpr double kRoundOff = 1e-6;  // the rate of shear is a double root, 0 to half of the digits
  const Eigen::EigenSolver<Mat3> eigen(gradient, false);
  return eigen.eigenvalues().real().maxCoeff() > kRoundOff;
}

}  // namespace

Evolution::Evolution(Scene scene, const EvolutionOptions& options, std::unique_ptr<FlowSolver> flow,
                     std::optional<MovingMesh> mesh, std::unique_ptr<ScalarSolver> scalars)
    : options_(options),
      solver_(std::move(flow)),
      scalar_solver_(std::move(scalars)),
      carriers_(options.surface) {
  MENISCUS_ASSERT(scene.scalars.empty() || (scalar_solver_ && mesh),
                  "bulk scalars need a solver and a volume mesh");
  state_.scene = std::move(scene);
  state_.mesh = std::move(mesh);
  state_.start_centroid = centroid_of_drops(state_.scene);
  state_.volume_shift.assign(state_.scene.interfaces.size(), 0.0);
  if (options.processes == linear::Processes::all)
    state_.surfaces = std::make_shared<KnownSurfaces>(
        std::bind_front(linear::shared_numbers, linear::Communicator::world()));
}

Report Evolution::prepare() {
  if (has_inertia(state_.scene))
    for (const ImposedFlow::Entry& entry : state_.scene.flow.schedule())
      if (entry.ramp == 0.0) give_notice(FlowJump{entry.time});
  const Scene before = state_.scene;
  remesh_interfaces();
  keep_surfactant(state_.scene, before, carriers_);
  if (Report made = follow_interfaces(before, state_.t); !made.ok()) return made;
  if (state_.scene.scalars.empty()) return {};
  return scalar_solver_->initial(state_.domain(), state_.scalars);
}

Report Evolution::solve() {
  first_ = flow_at({.t = state_.t});
  if (first_.ok() && !state_.flow) state_.flow = first_.flow.nodal;
  return first_;
}

Report Evolution::advance() {
  const StepStart start(state_);
  state_.surfaces->forget_unasked();
  start_scalars_ = state_.scalars;
  start_species_.clear();
  if (has_soluble_surfactant(state_.scene))
    start_species_ = species_beside(state_.scene, state_.mesh->tetrahedra(), state_.scalars);
  state_.iterations = 0;
  shift_judge_ = {};
  Report report;
  for (StepPlan plan = step_plan(state_, options_); plan.dt >= options_.min_step;
       plan = shorter_plan(plan, attempt_, options_)) {
    attempt_ = {};
    report = try_step(start.scene(), plan.dt);
    if (report.ok()) {
      accept_step(plan);
      return report;
    }
    start.restore(state_);
    if (report.fault->kind == FaultKind::unlike_liquids) return report;
    report_refusal(plan.dt, *report.fault);
    if (const FlowSolution again = solve_flow({.t = state_.t}); !again.ok()) return again;
  }
  const Fault last = report.fault.value_or(
      Fault{FaultKind::no_step, "the interface's edges ask for a shorter one"});
  return {Fault{FaultKind::no_step,
                fmt::format("no step of length {:.3g} or more can be taken at t = {:.6g}: {}",
                            options_.min_step, state_.t, last.text),
                last.position}};
}

void Evolution::report_refusal(double dt, const Fault& fault) {
  if (attempt_.is_excessive)
    log::debug("step {} of length {:.3g} is refused: {}", state_.step + 1, dt, fault.text);
  else
    give_notice(RefusedStep{state_.step + 1, dt, fault.text});
}

void Evolution::accept_step(const StepPlan& plan) {
  const double dt = plan.dt;
  MENISCUS_ASSERT(dt >= options_.min_step && dt <= options_.max_step, "a step of length {:g}", dt);
  if (state_.mesh) widen(state_.field_excess, state_.mesh->field_excess());
  state_.t += dt;
  state_.dt = dt;
  state_.record = attempt_;
  state_.record.bound = plan.bound;
  ++state_.step;
  notice_departure();
}

/// Tells once of drops that an extensional flow carries off, as it does from any small distance.
void Evolution::notice_departure() {
  if (state_.scene.interfaces.empty() || !is_repelling(state_.scene.flow.gradient(state_.t)))
    return;
  const double distance = (centroid_of_drops(state_.scene) - state_.start_centroid).norm();
  const auto is_told = [](const Notice& notice) {
    return std::holds_alternative<LeftCenter>(notice.what);
  };
  if (distance > kLeft && std::ranges::none_of(notices_, is_told))
    give_notice(LeftCenter{distance, !has_inertia(state_.scene) && state_.scene.scalars.empty()});
}

/// Table 1 of hooper2001 after the solve at t_k. The stages of the scheme find the mean motion of
/// the step. It is judged, the whole step is moved with it, and remeshed.
Report Evolution::try_step(const Scene& start, double dt) {
  const StageFlow whole = time_scheme_step(start, dt);
  if (!whole.ok()) return whole;
  if (Report good = judge_motion(start, whole, dt); !good.ok()) return good;
  return finish_step(start, whole, dt);
}

StageFlow Evolution::time_scheme_step(const Scene& start, double dt) {
  const Step step{start, state_.t, dt, carriers_, start_species_};
  const StageSolver solve = [&](const StageFlow& stage, double duration, const Instant& instant) {
    return solve_stage(start, stage, duration, instant);
  };
  Damping damping{.duration = kDampedShare * dt, .processes = options_.processes};
  if (options_.surface == SurfaceShape::faceted) damping.duration *= kFacetedStiffness;
  if (options_.surface == SurfaceShape::splined) damping.stiffness_around_thin = kThinDropStiffness;
  const StageDampers damp{[&](StageFlow& stage, const NormalSpeeds& about) {
                            const PhaseTimer timer(times_, "move interfaces");
                            meniscus::damp(stage, state_.scene, about, damping);
                          },
                          [&](const StageFlow& stage, const SurfactantPath& path,
                              const ConcentrationRates& rates, const ConcentrationRates& about) {
                            const PhaseTimer timer(times_, "move interfaces");
                            return damped(stage, path, rates, about, damping);
                          }};
  switch (options_.scheme) {
    case TimeScheme::euler:
      return euler_step(first_, step);
    case TimeScheme::rk2:
      return midpoint_step(first_, step, solve);
    case TimeScheme::semi_implicit:
      return semi_implicit_step(first_, step, solve, damp);
    case TimeScheme::implicit:
      return implicit_step(
          first_, step,
          [&](const StageFlow& stage, double way, const Instant& instant,
              const ImplicitStage& implicit) {
            return solve_stage(start, stage, way, instant, &implicit);
          },
          [&](StageFlow& stage, const NormalSpeeds& about) {
            const PhaseTimer timer(times_, "move interfaces");
            slow_down(stage, state_.scene, about, kImplicitShare * dt);
          });
    case TimeScheme::rkc:
      return chebyshev_step(
          first_, step,
          ChebyshevScheme::for_waves(wave_spectrum(start, first_.motion, first_.flow.velocity, dt),
                                     kMostStages),
          solve);
  }
  return first_;
}

/// Records how accurate an attempt is and how far it moves vertices. A fault if it goes too far.
Report Evolution::judge_motion(const Scene& start, const StageFlow& whole, double dt) {
  if (options_.scheme != TimeScheme::euler) attempt_.error = whole.error;
  attempt_.travel = vertex_travel(start, whole.motion, whole.flow.velocity, dt);
  if (whole.flow.nodal)
    attempt_.courant =
        courant_number(state_.mesh->tetrahedra(), whole.flow.bulk->v, state_.mesh->velocity(), dt);
  std::optional<Fault> excess = find_excess(attempt_, options_);
  attempt_.is_excessive = excess && options_.control == StepControl::error;
  return {std::move(excess)};
}

/// The flow after the interfaces moved for `duration` from where they were at `start`.
StageFlow Evolution::solve_stage(const Scene& start, const StageFlow& stage, double duration,
                                 const Instant& instant, const ImplicitStage* implicit) {
  time_phase(times_, "move interfaces", [&] {
    state_.scene = start;
    move_interfaces(state_.scene, stage.motion, duration);
    move_surfactant(start, stage, duration);
  });
  if (auto fault = find_wild_motion(start, state_.scene)) return {Report{std::move(fault)}};
  if (Report moved = move_mesh(start, stage.motion, stage.flow, duration); !moved.ok())
    return {std::move(moved)};
  if (act_on_flow(state_.scene) || has_soluble_surfactant(state_.scene))
    if (Report moved = move_scalars(start, stage.flow, duration); !moved.ok())
      return {std::move(moved)};
  return flow_at(instant, implicit);
}

/// A fault where a step is too long for the scalars.
Report Evolution::judge_scalars(const ScalarAdvance& moved) {
  if (!moved.ok() || options_.control != StepControl::error) return moved;
  attempt_.error = std::max(attempt_.error.value_or(0.0), moved.error);
  if (moved.error <= options_.tolerance) return {};
  attempt_.is_excessive = true;
  return {
      Fault{FaultKind::inaccurate,
            fmt::format("the error of a scalar is estimated at {:.2g} of its spread, above {:g}",
                        moved.error, options_.tolerance)}};
}

/// Takes the bulk scalars from where the step began to where the mesh stands.
ScalarAdvance Evolution::move_scalars(const Scene& start, const FlowSolution& flow,
                                      double duration) {
  if (start_scalars_.empty()) return {};
  state_.scalars = start_scalars_;
  const FlowDomain from = domain_of(start, state_.mesh->start());
  const ConcentrationRates expected = expected_adsorption(start, start_species_, duration);
  ScalarAdvance moved =
      scalar_solver_->advance({from, state_.domain(), duration, flow, expected}, state_.scalars);
  if (moved.ok())
    take_up(state_.scene, moved.uptake,
            expected_uptake(start, carriers_.of(start), start_species_, duration), duration,
            carriers_);
  return moved;
}

/// A scene on a mesh of the present connectivity.
FlowDomain Evolution::domain_of(const Scene& scene, const TetMesh& mesh) const {
  return {.scene = scene,
          .mesh = &mesh,
          .connectivity = state_.connectivity,
          .surfaces = state_.surfaces.get()};
}

StageFlow Evolution::flow_at(const Instant& instant, const ImplicitStage* implicit) {
  StageFlow stage;
  stage.fault = find_surfactant_fault(state_.scene);
  if (stage.ok() && state_.mesh)
    stage.fault = set_tension_factors(state_.scene, state_.mesh->tetrahedra(), state_.scalars);
  if (!stage.ok()) return stage;
  stage.flow = solve_flow(instant, implicit);
  stage.fault = stage.flow.fault;
  if (!stage.ok()) return stage;
  MENISCUS_ASSERT(stage.flow.velocity.size() == state_.scene.interfaces.size(),
                  "{} velocities of {} interfaces", stage.flow.velocity.size(),
                  state_.scene.interfaces.size());
  const PhaseTimer timer(times_, "move interfaces");
  stage.normals = normals();
  if (options_.motion_normal == MotionNormal::faces)
    for (std::size_t i = 0; i < stage.flow.middles.size(); ++i)
      follow_faces(state_.scene.interfaces[i].mesh, stage.normals[i], stage.flow.middles[i],
                   stage.flow.velocity[i]);
  stage.normal_speed = normal_speeds(stage.normals, stage.flow.velocity);
  if (options_.scheme == TimeScheme::semi_implicit || options_.scheme == TimeScheme::implicit) {
    stage.shape = shape_motion(state_.scene, stage.normals, stage.flow.velocity);
    stage.motion = velocity_of(stage.shape, state_.scene);
  } else {
    stage.motion = normal_motion(stage.normals, stage.normal_speed);
  }
  stage.surface_rate = surface_energy_rate(state_.scene, stage.motion);
  if (!has_surfactant(state_.scene)) return stage;
  stage.surfactant = surfactant_transport(state_.scene, carriers_.of(state_.scene),
                                          stage.flow.velocity, stage.motion);
  stage.amount_rates = amount_rates(stage.surfactant, state_.scene);
  return stage;
}

InterfaceNormals Evolution::normals() {
  if (options_.motion_normal != MotionNormal::faces)
    return interface_normals(state_.scene, options_.motion_normal);
  InterfaceNormals normals;  // the flow has asked for these surfaces already
  for (const auto& faces :
       reconstructed_interfaces(state_.scene, SurfaceShape::splined, *state_.surfaces))
    normals.push_back(faces->smooth()->vertex_normals());
  return normals;
}

/// Moves the interfaces of `start` the whole step, then makes them and the mesh fit for the next.
Report Evolution::finish_step(const Scene& start, const StageFlow& whole, double dt) {
  MENISCUS_ASSERT(whole.motion.size() == start.interfaces.size(), "{} motions of {} interfaces",
                  whole.motion.size(), start.interfaces.size());
  state_.events.clear();
  state_.shift_over_edge = 0.0;
  state_.flow = whole.flow.nodal;
  state_.momentum_lost = state_.energy_lost = 0.0;
  if (Report moved = move_whole_step(start, whole, dt); !moved.ok()) return moved;
  std::optional<TetMesh> exchanged_at;
  if (has_soluble_surfactant(state_.scene)) {
    if (Report moved = exchange_with_liquids(start, whole, dt); !moved.ok()) return moved;
    exchanged_at = state_.mesh->tetrahedra();
  }
  // Before what is carried is remeshed, which must not fail on one process alone.
  if (auto fault = find_surfactant_fault(state_.scene)) return {std::move(fault)};
  const Scene moved = time_phase(times_, "move interfaces", [&] { return state_.scene; });
  const bool is_due = is_remesh_due();
  bool are_remeshed = false;
  if (is_due)
    are_remeshed = remesh_interfaces();
  else
    restore_volumes();
  if (Report apart = refuse_contact(are_remeshed); !apart.ok()) return apart;
  if (is_due || is_remeshed_as_needed())
    if (Report changed = change_topology(moved, whole.motion); !changed.ok()) return changed;
  keep_surfactant(state_.scene, moved, carriers_);
  if (auto fault = find_surfactant_fault(state_.scene)) return {std::move(fault)};
  if (Report kept = judge_volume_shift(dt); !kept.ok()) return kept;
  if (!is_due && state_.events.empty()) {
    Report kept = keep_mesh(start, whole.flow, dt);
    attempt_.is_mesh_kept = kept.ok();
    if (kept.ok() && exchanged_at)
      scalar_solver_->ride(domain_of(moved, *exchanged_at), state_.domain(), state_.scalars);
    if (kept.ok())
      return exchanged_at ? kept : judge_scalars(move_scalars(start, scalar_carrier(whole), dt));
    if (!is_remeshed_as_needed()) return kept;
    log::debug("step {} makes its mesh anew: {}", state_.step + 1, kept.text());
  }
  if (Report carried = carry_fields_of_mesh(start, moved, whole, dt); !carried.ok()) return carried;
  return follow_interfaces(moved, state_.t + dt, liquid_sources(state_.events));
}

/// Takes bulk scalars and surfactants through the step where the interfaces have moved and are not
/// yet remeshed. What one loses the other takes up at the same vertices.
Report Evolution::exchange_with_liquids(const Scene& start, const StageFlow& whole, double dt) {
  if (Report moved = move_mesh(start, mean_motion(start, state_.scene, dt), whole.flow, dt);
      !moved.ok())
    return moved;
  return judge_scalars(move_scalars(start, scalar_carrier(whole), dt));
}

bool Evolution::is_remesh_due() {
  if (!is_remeshed_as_needed()) return (state_.step + 1) % options_.remesh_every == 0;
  const PhaseTimer timer(times_, "remesh surface");
  return !are_interfaces_fit(state_.scene, options_);
}

/// Moves the mesh with interfaces of the same connectivity. A fault if it is to be made anew.
Report Evolution::keep_mesh(const Scene& start, const FlowSolution& flow, double dt) {
  Report moved = move_mesh(start, mean_motion(start, state_.scene, dt), flow, dt);
  if (!moved.ok() || !state_.mesh) return moved;
  state_.mesh->place_interfaces(state_.scene);
  if (is_remeshed_as_needed() && !state_.mesh->is_fit())
    moved.fault = Fault{FaultKind::poor_cell, "a cell of the moved mesh has too small an angle"};
  else if (is_remeshed_as_needed() && !solver_->is_fit(state_.domain()))
    moved.fault =
        Fault{FaultKind::poor_cell, "a cell of the moved mesh flattens edges of interfaces"};
  else if ((state_.step + 1) % kStepsBetweenChecks == 0)
    moved.fault = find_defect(state_.mesh->tetrahedra(), state_.scene);
  return moved;
}

Report Evolution::move_whole_step(const Scene& start, const StageFlow& whole, double dt) {
  const PhaseTimer timer(times_, "move interfaces");
  Scene& scene = state_.scene;
  scene = start;
  move_interfaces(scene, whole.motion, dt);
  if (auto fault = find_wild_motion(start, scene)) return {std::move(fault)};
  if (auto fault = find_energy_fault({start, state_.t, dt, carriers_}, whole, scene))
    return {std::move(fault)};
  if (options_.follows_drops)
    translate_interfaces(scene, state_.start_centroid - centroid_of_drops(scene));
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i)
    carry_fields(state_, i, start.interfaces[i].mesh);
  move_surfactant(start, whole, dt);
  return {};
}

/// Gives the interfaces of the scene, which moved from `start` with the motion of a stage, their
/// concentrations.
void Evolution::move_surfactant(const Scene& start, const StageFlow& stage, double duration) {
  if (!has_surfactant(start)) return;
  const Step step{start, state_.t, duration, carriers_};
  meniscus::move_surfactant(state_.scene, surfactant_path(step, stage.motion, duration),
                            stage.amount_rates);
}

/// Moves fields in the bulk with the mesh to where the step moved the interfaces, before a new mesh
/// replaces it. Where cells would invert on the way, fields are transferred from the mesh as it
/// stands; with bulk scalars or inertia the step is refused.
Report Evolution::carry_fields_of_mesh(const Scene& start, const Scene& moved,
                                       const StageFlow& whole, double dt) {
  if (!state_.mesh || (state_.mesh->fields().empty() && state_.scalars.empty() && !state_.flow))
    return {};
  const Report followed = move_mesh(start, mean_motion(start, moved, dt), whole.flow, dt);
  if (!state_.scalars.empty()) {
    if (!followed.ok() || has_soluble_surfactant(moved)) return followed;
    const FlowDomain from = domain_of(start, state_.mesh->start()),
                     to = domain_of(moved, state_.mesh->tetrahedra());
    state_.scalars = start_scalars_;
    return judge_scalars(
        scalar_solver_->advance({from, to, dt, scalar_carrier(whole)}, state_.scalars));
  }
  if (state_.flow) return followed;
  if (!followed.ok()) log::debug("fields are carried over a longer way: {}", followed.text());
  return {};
}

/// Makes the mesh follow the interfaces after they were remeshed or changed topology since they
/// were those of `before`.
Report Evolution::follow_interfaces(const Scene& before, double t, const RegionSources& sources) {
  state_.connectivity = ++last_connectivity_;
  if (!state_.mesh) return {};
  const MeshChange change = state_.mesh->follow(state_.scene, sources);
  if (!change.ok()) return change;
  // Before the flow, which may depend on them.
  if (!state_.scalars.empty())
    state_.scalars = scalar_solver_->follow(change, before, state_.domain(), state_.scalars);
  if (state_.flow) {
    TransferredFlow arrived =
        solver_->transferred(change, before, state_.domain(), t, *state_.flow);
    if (!arrived.ok()) return arrived;
    state_.flow = std::move(arrived.flow);
    state_.momentum_lost = arrived.momentum_lost;
    state_.energy_lost = arrived.energy_lost;
  } else {
    solver_->follow(change, state_.domain());
  }
  return change;
}

Report Evolution::move_mesh(const Scene& start, const InterfaceMotion& motion,
                            const FlowSolution& flow, double dt) {
  if (!state_.mesh) return {};
  return state_.mesh->move(start, motion, flow.bulk ? flow.bulk->v : Field<TetVertexId, Vec3>(),
                           dt);
}

/// Returns false when an interface could not be remeshed.
bool Evolution::remesh_interfaces() { return remesh_interfaces(all_interfaces(state_.scene)); }

/// Returns false when one of the given interfaces could not be remeshed.
bool Evolution::remesh_interfaces(std::span<const std::size_t> interfaces) {
  const PhaseTimer timer(times_, "remesh surface");
  bool are_remeshed = true;
  for (InterfaceRemesh& done : meniscus::remesh_interfaces(state_, options_, interfaces)) {
    are_remeshed &= done.ok();
    if (done.is_mended || !done.ok()) give_notice(std::move(done));
  }
  return are_remeshed;
}

/// A fault if drops touch each other or a drop touches itself. The step is then refused.
Report Evolution::refuse_contact(bool are_remeshed) {
  const PhaseTimer timer(times_, "topology");
  return {find_contact(state_.scene, options_.topology, are_remeshed)};
}

Report Evolution::change_topology(const Scene& moved, const InterfaceMotion& motion) {
  TopologyReport changed = time_phase(times_, "topology", [&] {
    return meniscus::change_topology(state_, options_.topology, moved, motion);
  });
  for (std::string& warning : changed.warnings) give_notice(FailedSurgery{std::move(warning)});
  if (changed.refusal) return {std::move(changed.refusal)};
  if (changed.events.empty()) return {};
  return refuse_contact(remesh_interfaces(new_interfaces(moved, state_.scene)));
}

void Evolution::restore_volumes() {
  const PhaseTimer timer(times_, "move interfaces");
  for (std::size_t i = 0; i < state_.scene.interfaces.size(); ++i)
    record(state_, i,
           restore_volume(state_.scene.interfaces[i], options_.surface, *state_.surfaces));
}

/// A fault if restoring volumes shifted vertices too far, as long as a shorter step needs less.
Report Evolution::judge_volume_shift(double dt) {
  const double shift = state_.shift_over_edge;
  const ShiftVerdict verdict = shift_judge_.judge(state_, 0.5 * dt >= options_.min_step);
  if (verdict == ShiftVerdict::shorten)
    return {
        Fault{FaultKind::wrong_volume,
              fmt::format("restoring the volume shifts a vertex by {:.2g} of its edges", shift)}};
  if (verdict == ShiftVerdict::accept_for_good) give_notice(LargeVolumeShift{shift});
  state_.tolerates_shift = shift > kMostShiftOverEdge &&
                           (state_.tolerates_shift || verdict == ShiftVerdict::accept_for_good);
  return {};
}

FlowSolution Evolution::solve_flow(const Instant& instant, const ImplicitStage* implicit) {
  if (state_.mesh) state_.mesh->place_interfaces(state_.scene);
  FlowDomain domain = state_.domain();
  domain.stage = implicit;
  if (implicit != nullptr) domain.known = nullptr;
  FlowSolution solution = solver_->solve(domain, instant);
  state_.iterations += solution.iterations;
  for (const std::string& warning : solution.warnings)
    give_notice({.t = instant.t, .what = FailedSolver{warning}});
  return solution;
}

void Evolution::give_notice(Notice notice) {
  if (listener_) listener_(notice);
  notices_.push_back(std::move(notice));
}

/// What `make` makes of the measures of the state.
template <class Make>
auto Evolution::measured(const Make& make) const {
  std::vector<ScalarMeasures> scalars = scalar_measures();
  const PhaseTimer timer(times_, "diagnostics");
  return make(RowMaker(state_, options_, std::move(scalars), carriers_));
}

Rows Evolution::rows() const {
  return measured([&](const RowMaker& maker) { return maker.rows(first_.flow, first_.motion); });
}

std::vector<DropRow> Evolution::moving_drop_rows() const {
  return measured([&](const RowMaker& maker) { return maker.moving_drop_rows(first_.flow); });
}

std::vector<DropRow> Evolution::drop_rows() const {
  return measured([](const RowMaker& maker) { return maker.drop_rows(); });
}

std::vector<ScalarMeasures> Evolution::scalar_measures() const {
  if (state_.scalars.empty()) return {};
  return scalar_solver_->measures(state_.domain(), state_.scalars);
}

double Evolution::seconds_in(const std::string& phase) const {
  return times_[phase] + solver_->times()[phase] +
         (scalar_solver_ ? scalar_solver_->times()[phase] : 0.0) +
         (state_.mesh ? state_.mesh->times()[phase] : 0.0);
}

void Evolution::set_interface_fields(std::vector<SurfaceFields> fields) {
  meniscus::set_interface_fields(state_, std::move(fields));
}

void Evolution::set_bulk_fields(VolumeFields fields) {
  if (!state_.mesh) reject_input("fields in the bulk need a volume mesh; this solver has none");
  state_.mesh->set_fields(std::move(fields));
}

void Evolution::set_surroundings(const Scene& surroundings) {
  MENISCUS_ASSERT(surroundings.boundary.mesh == state_.scene.boundary.mesh,
                  "another outer boundary of {} vertices",
                  surroundings.boundary.mesh.num_vertices());
  state_.scene.flow = surroundings.flow;
  state_.scene.boundary.patches = surroundings.boundary.patches;
}

void Evolution::save(Archive& archive) const {
  meniscus::save(state_, archive);
  solver_->save(archive, state_.domain());
}

void Evolution::load(const Archive& archive) {
  meniscus::load(state_, archive);
  state_.connectivity = ++last_connectivity_;
  for (const BulkScalar& scalar : state_.scalars)
    if (scalar.values.size() != scalar_solver_->num_values(state_.domain()))
      reject_input("checkpoint: evolution/scalar: {} values do not fit the volume mesh's {} nodes",
                   scalar.values.size(), scalar_solver_->num_values(state_.domain()));
  solver_->load(archive, state_.domain());
}

}  // namespace meniscus
