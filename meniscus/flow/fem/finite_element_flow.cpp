#include "meniscus/flow/fem/finite_element_flow.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

#include "meniscus/core/archive_entries.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/excess_stress.hpp"
#include "meniscus/flow/fem/face_elements.hpp"
#include "meniscus/flow/fem/flow_transfer.hpp"
#include "meniscus/flow/fem/instant_problem.hpp"
#include "meniscus/flow/fem/interpolated_state.hpp"
#include "meniscus/flow/fem/kept_preconditioner.hpp"
#include "meniscus/flow/fem/node_sources.hpp"
#include "meniscus/flow/fem/region_motions.hpp"
#include "meniscus/flow/fem/scalar_coupling.hpp"
#include "meniscus/flow/fem/solution_history.hpp"
#include "meniscus/flow/fem/solver_archive.hpp"
#include "meniscus/flow/fem/stokes_residual.hpp"
#include "meniscus/flow/fem/stokes_solver.hpp"
#include "meniscus/flow/fem/vertex_velocity.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/scene/interface_tension.hpp"
#include "meniscus/volume/tetrahedralize.hpp"

namespace meniscus::fem {
namespace {

/// Takes a net flux out of the velocity of an interface, along its area vectors. The pressures
/// inside keep Σ A_i·v_i at zero but for the linear solver's residual. This removes the rest, so
/// that no volume is lost to a loose tolerance.
void remove_net_flux(const SurfaceMesh& surface, double flux, VertexField<Vec3>& velocity) {
  const VertexField<Vec3> area = vertex_area_vectors(surface);
  double squared = 0.0;
  for (const Vec3& each : area) squared += each.squaredNorm();
  for (const VertexId v : area.ids()) velocity[v] -= flux / squared * area[v];
}

/// Σ A_i·v_i over the nodes of a surface.
double net_flux(const FaceNodeTable& faces, const NodePositions& positions,
                const Field<NodeId, Vec3>& v) {
  const Field<NodeId, Vec3> area = node_area_vectors(faces, positions.x);
  double flux = 0.0;
  for (const NodeId i : area.ids()) flux += area[i].dot(v[i]);
  return flux;
}

MiddleNodes middle_nodes(const SurfaceMesh& surface, const FaceNodeTable& faces,
                         const NodePositions& positions, const Field<NodeId, Vec3>& v) {
  MiddleNodes middles;
  for (const FaceId f : surface.faces.ids()) {
    const std::span<const NodeId> nodes = faces.of(f);
    middles.x.add({positions.x[nodes[3]], positions.x[nodes[4]], positions.x[nodes[5]]});
    middles.v.add({v[nodes[3]], v[nodes[4]], v[nodes[5]]});
  }
  return middles;
}

Field<TetVertexId, Vec3> at_vertices(const Field<NodeId, Vec3>& v, std::int32_t num_vertices) {
  const auto vertices = v.span().first(static_cast<std::size_t>(num_vertices));
  return Field<TetVertexId, Vec3>(std::vector<Vec3>(vertices.begin(), vertices.end()));
}

/// Where no boundary is open the pressure is given relative to its mean ∫p dV / V over the matrix.
/// No mesh changes that but by its error.
void level_pressure(const TetMesh& mesh, const PressureSpace& space,
                    std::vector<double>& pressure) {
  double integral = 0.0, volume = 0.0;
  for (const CellId c : mesh.cells.ids()) {
    if (mesh.region[c] != RegionId{0}) continue;
    const double of_cell = signed_volume(mesh, c);
    for (std::size_t k = 0; k < 4; ++k)
      integral += 0.25 * of_cell *
                  pressure[static_cast<std::size_t>(
                      space.nodes.cell_nodes[4 * static_cast<std::size_t>(c.value) + k])];
    volume += of_cell;
  }
  MENISCUS_ASSERT(volume > 0.0, "a scene without a matrix");
  for (double& p : pressure) p -= integral / volume;
}

/// Whether a kept preconditioner can be made again from a checkpoint, whose concentrations are
/// later ones.
bool can_be_made_again(const Scene& scene) {
  const auto varies_in_matrix = [&](const Interface& interface) {
    return has_inertia(scene) && has_varying_tension(interface);
  };
  return !has_varying_viscosity(scene) && std::ranges::none_of(scene.interfaces, varies_in_matrix);
}

/// With inertia the velocity past the mesh with which a solve begins to convect; else empty.
Field<NodeId, Vec3> convecting_velocity(const StokesProblem& problem, const StokesState& begin) {
  if (!problem.inertia) return {};
  Field<NodeId, Vec3> v = begin.v;
  problem.constraints.impose(v);
  for (const NodeId i : v.ids()) v[i] -= problem.inertia->mesh_velocity[i];
  return v;
}

class FiniteElementFlow final : public FlowSolver {
 public:
  FiniteElementFlow(const Options& options, std::shared_ptr<KnownElements> elements)
      : options_(options), elements_(std::move(elements)) {
    MENISCUS_ASSERT(elements_->elements() == options.elements, "elements of another kind");
    if (options.elements == Elements::p2_p1 && options.capillary == CapillaryForm::nodal)
      reject_input("the nodal form of surface tension needs P1-P1 elements");
    if (options.elements == Elements::p2_p1 && options.linear == LinearSolver::paper_gmres)
      reject_input("the paper's GMRES scales by a diagonal that P2-P1 elements lack");
    check_linear_options(options);
  }

  FlowSolution solve(const FlowDomain& domain, const Instant& instant) override;
  void follow(const MeshChange& change, const FlowDomain& domain) override;
  TransferredFlow transferred(const MeshChange& change, const Scene& before,
                              const FlowDomain& domain, double t, const NodalFlow& flow) override;

  void save(Archive& archive, const FlowDomain& domain) const override;
  void load(const Archive& archive, const FlowDomain& domain) override;

  bool is_fit(const FlowDomain& moved) override;

  const PhaseTimes& times() const override { return times_; }

 private:
  void use_connectivity(const FlowDomain& domain);
  [[nodiscard]] bool has_connectivity_of(const FlowDomain& domain) const {
    return stokes_ && connectivity_ == domain.connectivity;
  }
  [[nodiscard]] StokesState first_guess(const FlowDomain& domain, double t,
                                        const StokesProblem& problem) const;
  [[nodiscard]] FlowSolution first_flow(const FlowDomain& domain, double t);
  [[nodiscard]] StageProjection projection(const FlowDomain& domain, double t);
  [[nodiscard]] StokesReport settle(const FlowDomain& domain, double t, StokesState& state);
  void keep_solution(const StokesProblem& problem, double t, StokesState state);
  [[nodiscard]] FlowSolution solution(const FlowDomain& domain, const InstantProblem& problem,
                                      const StokesState& state, const StokesPower& power);
  void restore_preconditioner(const Archive& archive, const FlowDomain& domain);

  Options options_;
  std::shared_ptr<KnownElements> elements_;
  std::int64_t connectivity_ = 0;  // that all below is made for
  std::shared_ptr<const FlowSpace> space_;
  std::optional<StokesSolver> stokes_;
  std::optional<int> made_flattened_;  // edges, when the flow was first asked for on the mesh
  int told_flattened_ = 0;             // most edges that a warning told of on the mesh
  SolutionHistory history_;            // for the next solve's first guess
  double guess_duration_ = 0.0;        // of the stage that the last solution comes from; 0: of none
  KeptPreconditioner preconditioner_;
  double last_duration_ = 0.0;  // of the last stage
  PhaseTimes times_;
};

void FiniteElementFlow::use_connectivity(const FlowDomain& domain) {
  stokes_.reset();
  space_ = elements_->space(domain);
  stokes_.emplace(*space_, options_);
  history_.clear();
  made_flattened_.reset();
  told_flattened_ = 0;
  preconditioner_.at.reset();
  connectivity_ = domain.connectivity;
}

bool FiniteElementFlow::is_fit(const FlowDomain& moved) {
  if (!has_connectivity_of(moved) || !made_flattened_) return true;
  const RemainderTimer timer(times_, "assemble");
  return elements_->positions(moved)->num_flattened <= *made_flattened_;
}

void FiniteElementFlow::follow(const MeshChange& change, const FlowDomain& domain) {
  if (history_.empty()) return;
  const RemainderTimer timer(times_, "assemble");
  SolutionHistory history = std::move(history_);
  stokes_.reset();  // refers to the space
  const std::shared_ptr<const FlowSpace> before = space_;
  use_connectivity(domain);
  // The scalars will look for the same places.
  const auto places = domain.scene.scalars.empty() ? nullptr : elements_->sources(change, domain);
  std::vector<StokesState> states = interpolated_states(
      history.states(), {change.before, *before}, {*domain.mesh, *space_}, change.sources,
      places ? std::span(*places) : std::span<const NodeSource>(), stokes_->cells());
  for (StokesState& state : states) stokes_->share(state);
  history.put_on_mesh(std::move(states));
  history_ = std::move(history);
}

/// Undisturbed flow and drops change on their own. The one is known at once, what the drops add to
/// it goes on as it did last. With inertia the undisturbed flow is what a stage begins with, and
/// each node goes on with its acceleration.
StokesState FiniteElementFlow::first_guess(const FlowDomain& domain, double t,
                                           const StokesProblem& problem) const {
  StokesState state = history_.empty() ? stokes_->state_at_rest() : history_.at(t);
  const double longer = domain.stage != nullptr && guess_duration_ > 0.0
                            ? domain.stage->duration / guess_duration_
                            : 1.0;
  for (const NodeId i : state.v.ids()) state.v[i] = problem.undisturbed[i] + longer * state.v[i];
  return state;
}

void FiniteElementFlow::keep_solution(const StokesProblem& problem, double t, StokesState state) {
  for (const NodeId i : state.v.ids()) state.v[i] -= problem.undisturbed[i];
  if (problem.inertia) history_.clear();
  history_.add(std::move(state), t);
  guess_duration_ = problem.inertia ? problem.inertia->duration : 0.0;
}

/// The flow with which a run of liquids with inertia begins, without divergence and with the
/// boundary's velocity, and the pressure that goes with it.
FlowSolution FiniteElementFlow::first_flow(const FlowDomain& domain, double t) {
  const NodePositions positions = *elements_->positions(domain);
  StokesState state = stokes_->state_at_rest();
  const Scene& scene = domain.scene;
  for (const NodeId i : state.v.ids())
    state.v[i] = scene.initial_velocity ? scene.initial_velocity(positions.x[i])
                                        : scene.flow.velocity(positions.x[i], t);
  FlowSolution result;
  // The first time finds the velocity, the second the pressure of a velocity without divergence.
  for (int k = 0; k < 2; ++k) {
    const StokesReport report = settle(domain, t, state);
    result.iterations += report.iterations;
    if (!report.ok()) return failed_flow(*report.fault, result.iterations);
  }
  const InstantProblem problem = instant_problem(domain, *space_, positions, options_.capillary, t);
  const int iterations = result.iterations;
  result = solution(domain, problem, state, stokes_->power(problem.stokes, state));
  result.iterations = iterations;
  history_.clear();
  history_.add({stokes_->state_at_rest().v, std::move(state.p)}, t);
  guess_duration_ = 0.0;
  return result;
}

/// Takes a velocity to the nearest one without divergence and with the boundary's, by a stage too
/// short for anything else. The pressure becomes what it is then.
StokesReport FiniteElementFlow::settle(const FlowDomain& domain, double t, StokesState& state) {
  constexpr double kShare = 1e-4;  // of the time in which viscosity crosses a cell
  const NodePositions positions = *elements_->positions(domain);
  double fastest = 0.0;
  for (const Liquid& liquid : domain.scene.liquids)
    fastest = std::max(fastest, liquid.viscosity / liquid.density);
  const double edge = shortest_edge(*domain.mesh);
  ImplicitStage stage{.duration = kShare * edge * edge / fastest,
                      .x = {positions.x.begin(), positions.x.end()},
                      .v = {state.v.begin(), state.v.end()},
                      .expected_v = {state.v.begin(), state.v.end()},
                      .slowing = {}};
  const auto stage_problem = [&] {
    return instant_problem(with_stage(domain, stage), *space_, positions, options_.capillary, t);
  };
  preconditioner_.at.reset();
  if (options_.elements == Elements::p1_p1) {
    // Their stabilisation remembers the divergence of what a stage begins with.
    StokesReport report =
        stokes_->project(stage_problem().stokes, state.v, linear::Preconditioner::fresh, times_);
    if (!report.ok()) return report;
    stage.v = {state.v.begin(), state.v.end()};
  }
  const InstantProblem problem = stage_problem();
  StokesReport report =
      stokes_->solve(problem.stokes, state, linear::Preconditioner::fresh, times_);
  if (report.ok() && !problem.stokes.has_open_boundary)
    level_pressure(*domain.mesh, space_->pressure, state.p);
  return report;
}

/// The projection by the matrix of a stage as long as the last.
StageProjection FiniteElementFlow::projection(const FlowDomain& domain, double t) {
  MENISCUS_ASSERT(last_duration_ > 0.0, "no stage before");
  NodePositions positions = *elements_->positions(domain);
  const ImplicitStage stage = stage_at_rest(domain.scene, last_duration_, positions.x);
  InstantProblem problem = instant_problem(with_stage(domain, stage), *space_, std::move(positions),
                                           options_.capillary, t);
  return {*stokes_, std::move(problem.stokes), preconditioner_, times_};
}

TransferredFlow FiniteElementFlow::transferred(const MeshChange& change, const Scene& before,
                                               const FlowDomain& domain, double t,
                                               const NodalFlow& flow) {
  FlowSpace old_space;
  {
    const RemainderTimer timer(times_, "assemble");
    old_space = flow_space(change.before, options_.elements);
    follow(change, domain);
    if (!has_connectivity_of(domain)) use_connectivity(domain);
  }
  StageProjection projection = this->projection(domain, t);
  const NodePositions old_positions =
      node_positions(before, change.before, old_space, domain.surfaces);
  const std::vector<NodeSource> sources =
      node_sources({change.before, old_space, old_positions},
                   {*domain.mesh, *space_, projection.positions()}, change.sources);
  const MovingLiquids then{before, change.before, old_space, old_positions},
      now{domain.scene, *domain.mesh, *space_, projection.positions()};
  Field<NodeId, Vec3> v(interpolated_values<Vec3>(flow.v, old_space, sources));
  TransferredFlow result;
  result.fault = projection.apply(v).fault;
  if (result.ok() && !change.sources.empty())
    result.fault = keep_momentum(now, projection, momentum(then, flow.v), v);
  const Field<NodeId, Vec3>& x = projection.positions().x;
  result.flow = {{x.begin(), x.end()},
                 {v.begin(), v.end()},
                 history_.empty() ? stokes_->state_at_rest().p : history_.states().front().p,
                 flow.power};
  if (!can_be_made_again(domain.scene)) preconditioner_.at.reset();
  const MotionLost lost = motion_lost(then, flow.v, now, result.flow.v);
  result.momentum_lost = lost.momentum;
  result.energy_lost = lost.energy;
  return result;
}

FlowSolution FiniteElementFlow::solve(const FlowDomain& domain, const Instant& instant) {
  MENISCUS_ASSERT(domain.mesh != nullptr, "finite elements need a volume mesh");
  const RemainderTimer timer(times_, "assemble");
  const TetMesh& mesh = *domain.mesh;
  if (!has_connectivity_of(domain)) use_connectivity(domain);
  if (!made_flattened_) made_flattened_ = elements_->positions(domain)->num_flattened;
  if (domain.stage == nullptr && has_inertia(domain.scene)) {
    if (domain.known == nullptr) return first_flow(domain, instant.t);
    const InstantProblem problem = instant_problem(domain, *space_, *elements_->positions(domain),
                                                   options_.capillary, instant.t);
    return solution(domain, problem, {Field<NodeId, Vec3>(domain.known->v), domain.known->p}, {});
  }
  for (const CellId c : mesh.cells.ids())
    if (!(signed_volume(mesh, c) > 0.0))
      return failed_flow({FaultKind::inverted_cell, "a cell of the volume mesh is inverted",
                          mesh.x[mesh.cells[c][0]]});
  const InstantProblem problem = instant_problem(domain, *space_, *elements_->positions(domain),
                                                 options_.capillary, instant.t);
  if (problem.fault) return failed_flow(*problem.fault);
  StokesState state = first_guess(domain, instant.t, problem.stokes);
  if (domain.stage != nullptr) {
    last_duration_ = domain.stage->duration;
    preconditioner_.drop_unless_of_stage(last_duration_);
  }
  const bool is_kept = preconditioner_.at.has_value();
  Field<NodeId, Vec3> convecting = convecting_velocity(problem.stokes, state);
  const StokesReport report = stokes_->solve(
      problem.stokes, state, is_kept ? linear::Preconditioner::kept : linear::Preconditioner::fresh,
      times_);
  if (!stokes_->has_slow_velocities()) convecting = {};
  preconditioner_.decide(problem.stokes, report, is_kept, std::move(convecting));
  if (!can_be_made_again(domain.scene)) preconditioner_.at.reset();
  if (report.ok() && !problem.stokes.has_open_boundary)
    level_pressure(mesh, space_->pressure, state.p);
  FlowSolution result =
      report.ok() ? solution(domain, problem, state, report.power) : failed_flow(*report.fault);
  if (report.ok()) keep_solution(problem.stokes, instant.t, std::move(state));
  result.iterations = report.iterations;
  if (const int flattened = problem.stokes.positions.num_flattened; flattened > told_flattened_)
    result.warnings.push_back(
        fmt::format("{} edges of surfaces are less curved in the elements", flattened));
  told_flattened_ = std::max(told_flattened_, problem.stokes.positions.num_flattened);
  result.warnings.insert(result.warnings.end(), report.failed_solvers.begin(),
                         report.failed_solvers.end());
  return result;
}

FlowSolution FiniteElementFlow::solution(const FlowDomain& domain, const InstantProblem& problem,
                                         const StokesState& state, const StokesPower& power) {
  const TetMesh& mesh = *domain.mesh;
  FlowSolution result;
  for (std::size_t i = 0; i < mesh.interfaces.size(); ++i) {
    const SurfaceMesh& surface = domain.scene.interfaces[i].mesh;
    const FaceNodeTable faces = face_nodes(*space_, mesh, surface, mesh.interfaces[i]);
    const NodePositions& positions = problem.stokes.positions;
    VertexField<Vec3> v = vertex_velocity(surface, faces, positions, state.v);
    remove_net_flux(surface, net_flux(faces, positions, state.v), v);
    result.velocity.push_back(std::move(v));
    if (options_.elements == Elements::p2_p1)
      result.middles.push_back(middle_nodes(surface, faces, positions, state.v));
  }
  if (domain.known != nullptr) {
    result.power = domain.known->power;
  } else {
    double traction = 0.0;
    for (const NodeId i : problem.traction.ids()) traction += problem.traction[i].dot(state.v[i]);
    result.power = {power.reaction + traction + power.body_force, power.dissipation,
                    power.kinetic_rate};
  }
  GeneralisedLiquids liquids = generalised_liquids(problem.stokes, state);
  result.excess_stress = std::move(liquids.excess_stress);
  result.least_viscosity = std::move(liquids.least_viscosity);
  if (result.least_viscosity.empty() && has_varying_viscosity(domain.scene))
    result.least_viscosity = least_viscosities(problem.stokes);
  BulkFlow bulk{at_vertices(state.v, mesh.num_vertices()), {}, {}};
  const auto at_edges = state.v.span().subspan(static_cast<std::size_t>(mesh.num_vertices()));
  bulk.v_at_edges.assign(at_edges.begin(), at_edges.end());
  bulk.corner_pressure.reserve(space_->pressure.nodes.cell_nodes.size());
  for (const std::int32_t node : space_->pressure.nodes.cell_nodes)
    bulk.corner_pressure.push_back(state.p[static_cast<std::size_t>(node)]);
  result.bulk = std::move(bulk);
  if (!has_inertia(domain.scene)) return result;
  const Field<NodeId, Vec3>& x = problem.stokes.positions.x;
  result.nodal =
      NodalFlow{{x.begin(), x.end()}, {state.v.begin(), state.v.end()}, state.p, *result.power};
  if (domain.stage == nullptr)
    result.motions =
        region_motions(domain.scene, mesh, *space_, problem.stokes.positions, result.nodal->v);
  return result;
}

void FiniteElementFlow::save(Archive& archive, const FlowDomain& domain) const {
  if (!has_connectivity_of(domain)) return;
  history_.save(archive);
  if (!history_.empty() && guess_duration_ > 0.0)
    archive.reals["flow/guess/duration"] = {guess_duration_};
  if (made_flattened_) archive.integers["flow/made-flattened"] = {*made_flattened_};
  preconditioner_.save(archive);
}

/// Makes the preconditioner that the saved run had, so that a resumed run does the same arithmetic.
void FiniteElementFlow::restore_preconditioner(const Archive& archive, const FlowDomain& domain) {
  preconditioner_ = load_preconditioner(archive);
  if (!preconditioner_.at) return;
  if (preconditioner_.at->x.size() != space_->velocity.num_nodes ||
      preconditioner_.at->is_curved.size() != domain.mesh->num_cells())
    reject_input("checkpoint: flow/preconditioner/x does not fit the volume mesh");
  if (!preconditioner_.convecting.empty() &&
      preconditioner_.convecting.size() != space_->velocity.num_nodes)
    reject_input("checkpoint: flow/preconditioner/velocity does not fit the volume mesh");
  FlowDomain then = domain;
  ImplicitStage stage;
  if (has_inertia(domain.scene)) {
    stage = stage_at_rest(domain.scene, preconditioner_.duration, preconditioner_.at->x);
    then.stage = &stage;
  }
  // Time and forces matter to the right-hand side alone.
  stokes_->prepare(
      instant_problem(then, *space_, *preconditioner_.at, options_.capillary, 0.0).stokes,
      preconditioner_.convecting);
}

void FiniteElementFlow::load(const Archive& archive, const FlowDomain& domain) {
  use_connectivity(domain);
  if (archive.integers.contains("flow/made-flattened"))
    made_flattened_ =
        static_cast<int>(entry_of_size(archive.integers, "flow/made-flattened", 1).front());
  restore_preconditioner(archive, domain);
  history_.load(archive, stokes_->state_at_rest());
  if (archive.reals.contains("flow/guess/duration"))
    guess_duration_ = entry_of_size(archive.reals, "flow/guess/duration", 1).front();
}

}  // namespace

std::unique_ptr<FlowSolver> make_finite_element_flow(const Options& options,
                                                     std::shared_ptr<KnownElements> elements) {
  return std::make_unique<FiniteElementFlow>(options, std::move(elements));
}

std::unique_ptr<FlowSolver> make_finite_element_flow(const Options& options) {
  return make_finite_element_flow(options, std::make_shared<KnownElements>(options.elements));
}

}  // namespace meniscus::fem
