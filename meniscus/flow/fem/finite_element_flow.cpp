#include "meniscus/flow/fem/finite_element_flow.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "meniscus/core/archive_entries.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/boundary_conditions.hpp"
#include "meniscus/flow/fem/capillary_force.hpp"
#include "meniscus/flow/fem/excess_stress.hpp"
#include "meniscus/flow/fem/face_elements.hpp"
#include "meniscus/flow/fem/interpolated_state.hpp"
#include "meniscus/flow/fem/node_sources.hpp"
#include "meniscus/flow/fem/region_motions.hpp"
#include "meniscus/flow/fem/scalar_coupling.hpp"
#include "meniscus/flow/fem/solver_archive.hpp"
#include "meniscus/flow/fem/stokes_residual.hpp"
#include "meniscus/flow/fem/stokes_solver.hpp"
#include "meniscus/flow/fem/vertex_velocity.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/scene/interface_tension.hpp"
#include "meniscus/volume/tetrahedralize.hpp"

namespace meniscus::fem {
namespace {

/// The problem's coefficients and forces; tractions and buoyancy apart, as their power is paid for
/// outside.
struct InstantProblem {
  StokesProblem stokes;
  Field<NodeId, Vec3> traction;
  std::optional<Fault> fault = {};
};

/// The nodes of the faces of every embedded surface.
struct SurfaceNodes {
  std::vector<FaceNodeTable> interfaces;
  FaceNodeTable boundary;
};

SurfaceNodes surface_nodes(const Scene& scene, const TetMesh& mesh, const FlowSpace& space) {
  SurfaceNodes nodes;
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i)
    nodes.interfaces.push_back(
        face_nodes(space, mesh, scene.interfaces[i].mesh, mesh.interfaces[i]));
  nodes.boundary = face_nodes(space, mesh, scene.boundary.mesh, mesh.boundary);
  return nodes;
}

/// Velocities at the nodes of an interface's faces of what is given at its vertices, at the middles
/// of edges half way between.
void add_at_faces(const SurfaceMesh& surface, const FaceNodeTable& faces,
                  const VertexField<Vec3>& at_vertices, Field<NodeId, Vec3>& to) {
  for (const FaceId f : surface.faces.ids())
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &here = at_vertices[surface.faces[f][k]],
                 &next = at_vertices[surface.faces[f][(k + 1) % 3]];
      to[faces.of(f)[k]] = here;
      to[faces.of(f)[3 + k]] = 0.5 * (here + next);
    }
}

/// What the stage of a domain adds by inertia, the nodes being at x.
InertiaTerms inertia_terms(const FlowDomain& domain, const Field<NodeId, Vec3>& x,
                           std::span<const FaceNodeTable> interfaces) {
  const ImplicitStage& stage = *domain.stage;
  const Scene& scene = domain.scene;
  MENISCUS_ASSERT(stage.x.size() == x.span().size() && stage.v.size() == stage.x.size(),
                  "{} nodes, {} before", x.size(), stage.x.size());
  InertiaTerms terms{.duration = stage.duration};
  for (const CellId c : domain.mesh->cells.ids())
    terms.density.add(scene.liquids[domain.mesh->region[c]].density);
  terms.before = Field<NodeId, Vec3>(stage.v);
  for (const NodeId i : x.ids())
    terms.mesh_velocity.add((x[i] - stage.x[static_cast<std::size_t>(i.value)]) / stage.duration);
  terms.interface_went = Field<NodeId, Vec3>(x.size(), Vec3::Zero());
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
    const Interface& interface = scene.interfaces[i];
    if (interface.tension == 0.0 || stage.slowing.empty()) continue;
    add_at_faces(interface.mesh, interfaces[i], stage.slowing[i], terms.interface_went);
    const double factor = stage.duration * largest_tension(interface);
    for (const FaceId f : interfaces[i].faces())
      terms.tension.push_back(face_stiffness(x, interfaces[i].of(f), factor));
  }
  std::vector<char> is_done(stage.x.size(), 0);
  for (const FaceStiffness& face : terms.tension)
    for (const NodeId i : face.nodes)
      if (std::exchange(is_done[static_cast<std::size_t>(i.value)], 1) == 0)
        terms.interface_went[i] += stage.expected_v[static_cast<std::size_t>(i.value)];
  return terms;
}

/// A stage of liquids at rest, for its matrix alone.
ImplicitStage stage_at_rest(const Scene& scene, double duration, const Field<NodeId, Vec3>& x) {
  const std::vector<Vec3> zeros(x.span().size(), Vec3::Zero());
  ImplicitStage stage{duration, {x.begin(), x.end()}, zeros, zeros, {}};
  for (const Interface& interface : scene.interfaces)
    stage.slowing.emplace_back(interface.mesh.num_vertices(), Vec3::Zero());
  return stage;
}

FlowDomain with_stage(const FlowDomain& domain, const ImplicitStage& stage) {
  FlowDomain result = domain;
  result.known = nullptr;
  result.stage = &stage;
  return result;
}

InstantProblem instant_problem(const FlowDomain& domain, const FlowSpace& space,
                               NodePositions positions, CapillaryForm form, double t) {
  const Scene& scene = domain.scene;
  const TetMesh& mesh = *domain.mesh;
  InstantProblem problem{StokesProblem(mesh, space, std::move(positions)), {}, {}};
  const NodePositions& at = problem.stokes.positions;
  const SurfaceNodes nodes = surface_nodes(scene, mesh, space);
  for (const CellId c : mesh.cells.ids()) {
    const Liquid& liquid = scene.liquids[mesh.region[c]];
    problem.stokes.viscosity[c] = liquid.viscosity;
    problem.stokes.body_force[c] = liquid.body_force;
  }
  if (!std::ranges::all_of(scene.liquids, is_newtonian, &Liquid::law))
    for (const Liquid& liquid : scene.liquids) problem.stokes.laws.add(liquid.law);
  if (domain.stage != nullptr) {
    problem.stokes.inertia = inertia_terms(domain, at.x, nodes.interfaces);
    problem.stokes.undisturbed = problem.stokes.inertia->before;
  } else {
    for (const Vec3& x : at.x) problem.stokes.undisturbed.add(scene.flow.velocity(x, t));
  }
  BoundaryConditions conditions = boundary_conditions(scene.boundary, nodes.boundary, at, t);
  problem.fault = std::move(conditions.fault);
  problem.stokes.constraints = std::move(conditions.constraints);
  problem.stokes.has_open_boundary = conditions.has_open_patch;
  problem.traction = std::move(conditions.traction);
  if (domain.scalars != nullptr) {
    const CellField<double> factors = viscosity_factors(scene, mesh, space, *domain.scalars);
    for (const CellId c : mesh.cells.ids()) problem.stokes.viscosity[c] *= factors[c];
    add_buoyancy(scene, *domain.scalars, problem.stokes, problem.traction);
  }
  problem.stokes.force = problem.traction;
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i)
    if (scene.interfaces[i].tension != 0.0)
      add_capillary_force(scene.interfaces[i], form, nodes.interfaces[i], at, problem.stokes.force);
  return problem;
}

/// Takes a net flux out of the velocity of an interface, along its area vectors. The pressures
/// inside keep Σ A_i·v_i at zero but for the linear solver's residual; this removes the rest, so
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

/// Where no boundary is open the pressure is given relative to its mean ∫p dV / V over the matrix,
/// which no mesh changes but by its error.
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

Vec3 momentum_of(std::span<const RegionMotion> motions) {
  Vec3 sum = Vec3::Zero();
  for (const RegionMotion& each : motions) sum += each.momentum;
  return sum;
}

class FiniteElementFlow final : public FlowSolver {
 public:
  explicit FiniteElementFlow(const Options& options) : options_(options) {
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

  const PhaseTimes& times() const override { return times_; }

 private:
  void use_connectivity(const FlowDomain& domain);
  [[nodiscard]] bool has_connectivity_of(const FlowDomain& domain) const {
    return stokes_ && connectivity_ == domain.connectivity;
  }
  void decide_on_preconditioner(const StokesProblem& problem, const StokesReport& report,
                                bool is_kept);
  void drop_preconditioner_of_other_stages(double duration);
  [[nodiscard]] StokesState first_guess(const FlowDomain& domain,
                                        const StokesProblem& problem) const;
  [[nodiscard]] FlowSolution first_flow(const FlowDomain& domain, double t);
  class Projection;
  [[nodiscard]] std::optional<Fault> keep_momentum(const FlowDomain& domain, Projection& projection,
                                                   const Vec3& momentum,
                                                   Field<NodeId, Vec3>& v) const;
  [[nodiscard]] StokesReport settle(const FlowDomain& domain, double t, StokesState& state);
  void keep_solution(const StokesProblem& problem, StokesState state);
  [[nodiscard]] FlowSolution solution(const FlowDomain& domain, const InstantProblem& problem,
                                      const StokesState& state, const StokesPower& power);
  void restore_preconditioner(const Archive& archive, const FlowDomain& domain);

  Options options_;
  std::int64_t connectivity_ = 0;  // that all below is made for
  FlowSpace space_;
  std::optional<StokesSolver> stokes_;
  /// The last solution less the undisturbed flow: the next solve's first guess.
  std::optional<StokesState> guess_;
  /// Where the nodes were when the preconditioner was made that the next solve will keep, and the
  /// iterations of the solve that made it; none when the next is to make its own.
  std::optional<NodePositions> prepared_at_;
  int iterations_then_ = 0;         // 0 where none was yet
  double prepared_duration_ = 0.0;  // of the stage then; 0 without inertia
  double last_duration_ = 0.0;      // of the last stage
  PhaseTimes times_;
};

void FiniteElementFlow::use_connectivity(const FlowDomain& domain) {
  stokes_.reset();
  space_ = flow_space(*domain.mesh, options_.elements);
  stokes_.emplace(space_, options_);
  guess_.reset();
  prepared_at_.reset();
  connectivity_ = domain.connectivity;
}

void FiniteElementFlow::follow(const MeshChange& change, const FlowDomain& domain) {
  if (!guess_) return;
  const RemainderTimer timer(times_, "assemble");
  const StokesState guess = *std::move(guess_);
  stokes_.reset();  // refers to the space
  const FlowSpace before = std::move(space_);
  use_connectivity(domain);
  guess_ =
      interpolated_state(guess, {change.before, before}, {*domain.mesh, space_}, change.sources);
}

/// Undisturbed flow and drops change on their own: the one is known at once, what the drops add to
/// it is taken from the last solution.
StokesState FiniteElementFlow::first_guess(const FlowDomain& domain,
                                           const StokesProblem& problem) const {
  if (domain.stage != nullptr)
    return {Field<NodeId, Vec3>(domain.stage->expected_v),
            guess_ ? guess_->p : stokes_->state_at_rest().p};
  StokesState state = guess_ ? *guess_ : stokes_->state_at_rest();
  for (const NodeId i : state.v.ids()) state.v[i] += problem.undisturbed[i];
  return state;
}

void FiniteElementFlow::keep_solution(const StokesProblem& problem, StokesState state) {
  for (const NodeId i : state.v.ids()) state.v[i] -= problem.undisturbed[i];
  guess_ = std::move(state);
}

/// The flow with which a run of liquids with inertia begins, without divergence and with the
/// boundary's velocity, and the pressure that goes with it.
FlowSolution FiniteElementFlow::first_flow(const FlowDomain& domain, double t) {
  const NodePositions positions =
      node_positions(domain.scene, *domain.mesh, space_, options_.processes);
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
  const InstantProblem problem = instant_problem(domain, space_, positions, options_.capillary, t);
  const int iterations = result.iterations;
  result = solution(domain, problem, state, stokes_->power(problem.stokes, state));
  result.iterations = iterations;
  keep_solution(problem.stokes, std::move(state));
  return result;
}

/// Takes a velocity to the nearest one without divergence and with the boundary's, by a stage too
/// short for anything else, and the pressure to what it is then.
StokesReport FiniteElementFlow::settle(const FlowDomain& domain, double t, StokesState& state) {
  constexpr double kShare = 1e-4;  // of the time in which viscosity crosses a cell
  const NodePositions positions =
      node_positions(domain.scene, *domain.mesh, space_, options_.processes);
  double fastest = 0.0;
  for (const Liquid& liquid : domain.scene.liquids)
    fastest = std::max(fastest, liquid.viscosity / liquid.density);
  const double edge = shortest_edge(*domain.mesh);
  ImplicitStage stage{.duration = kShare * edge * edge / fastest,
                      .x = {positions.x.begin(), positions.x.end()},
                      .v = {state.v.begin(), state.v.end()},
                      .expected_v = {state.v.begin(), state.v.end()},
                      .slowing = {}};
  const InstantProblem problem =
      instant_problem(with_stage(domain, stage), space_, positions, options_.capillary, t);
  prepared_at_.reset();
  StokesReport report =
      stokes_->solve(problem.stokes, state, linear::Preconditioner::fresh, times_);
  if (report.ok() && !problem.stokes.has_open_boundary)
    level_pressure(*domain.mesh, space_.pressure, state.p);
  return report;
}

/// Takes divergence out of velocities on a new mesh, by the matrix of a stage as long as the last,
/// whose preconditioner the next stage may keep.
class FiniteElementFlow::Projection {
 public:
  Projection(FiniteElementFlow& flow, const FlowDomain& domain, double t)
      : Projection(
            flow, domain, t,
            node_positions(domain.scene, *domain.mesh, flow.space_, flow.options_.processes)) {}

  StokesReport apply(Field<NodeId, Vec3>& v) {
    using linear::Preconditioner;
    StokesReport report = flow_.stokes_->project(
        problem_.stokes, v, flow_.prepared_at_ ? Preconditioner::kept : Preconditioner::fresh,
        flow_.times_);
    if (report.ok() && report.iterations > 0 && !flow_.prepared_at_) {
      flow_.prepared_at_ = problem_.stokes.positions;
      flow_.prepared_duration_ = stage_.duration;
      flow_.iterations_then_ = 0;
    }
    return report;
  }
  [[nodiscard]] const NodePositions& positions() const { return problem_.stokes.positions; }
  /// A uniform field but at nodes with conditions, where it is zero.
  [[nodiscard]] Field<NodeId, Vec3> uniform_off_walls(const Vec3& value) const {
    Field<NodeId, Vec3> field(positions().x.size(), value);
    for (const NodeConstraint& constraint : problem_.stokes.constraints.all())
      field[constraint.node].setZero();
    return field;
  }

 private:
  Projection(FiniteElementFlow& flow, const FlowDomain& domain, double t, NodePositions positions)
      : flow_(flow),
        stage_(stage_at_rest(domain.scene, flow.last_duration_, positions.x)),
        problem_(instant_problem(with_stage(domain, stage_), flow.space_, std::move(positions),
                                 flow.options_.capillary, t)) {
    MENISCUS_ASSERT(stage_.duration > 0.0, "no stage before");
  }

  FiniteElementFlow& flow_;
  ImplicitStage stage_;
  InstantProblem problem_;
};

/// Gives a velocity without divergence a momentum, by the least that three such fields add: what is
/// left of the uniform ones. Where all densities are equal walls hold the momentum, and what
/// differs is the solver's tolerance; uniform fields off the walls take that away in any case.
std::optional<Fault> FiniteElementFlow::keep_momentum(const FlowDomain& domain,
                                                      Projection& projection, const Vec3& momentum,
                                                      Field<NodeId, Vec3>& v) const {
  constexpr double kLeast = 1e-4;  // of the momentum of a uniform field: walls hold the rest
  const auto momentum_in = [&](const Field<NodeId, Vec3>& of) {
    return momentum_of(
        region_motions(domain.scene, *domain.mesh, space_, projection.positions(), of.span()));
  };
  double scale = 0.0, mass = 0.0;
  for (const Vec3& each : v) scale = std::max(scale, each.norm());
  if (scale == 0.0) return {};
  const auto give = [&](const std::array<Field<NodeId, Vec3>, 3>& fields, const Mat3& momenta) {
    const Vec3 share =
        momenta.completeOrthogonalDecomposition().solve(momentum - momentum_in(v)).eval();
    for (const NodeId i : v.ids())
      for (int k = 0; k < 3; ++k) v[i] += share[k] * fields[static_cast<std::size_t>(k)][i];
  };
  const Vec3 now = momentum_in(v);
  std::array<Field<NodeId, Vec3>, 3> fields, uniform;
  Mat3 momenta, momenta_of_uniform;
  for (int k = 0; k < 3; ++k) {
    Field<NodeId, Vec3> moved = v;
    for (Vec3& each : moved) each += scale * Vec3::Unit(k);
    mass = std::max(mass, (momentum_in(moved) - now).norm());
    if (StokesReport report = projection.apply(moved); !report.ok()) return report.fault;
    for (const NodeId i : moved.ids()) moved[i] -= v[i];
    momenta.col(k) = momentum_in(moved);
    fields[static_cast<std::size_t>(k)] = std::move(moved);
    uniform[static_cast<std::size_t>(k)] = projection.uniform_off_walls(Vec3::Unit(k));
    momenta_of_uniform.col(k) = momentum_in(uniform[static_cast<std::size_t>(k)]);
  }
  if (momenta.norm() >= kLeast * mass) give(fields, momenta);
  give(uniform, momenta_of_uniform);
  return {};
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
  Projection projection(*this, domain, t);
  const NodePositions old_positions =
                          node_positions(before, change.before, old_space, options_.processes),
                      &positions = projection.positions();
  const std::vector<NodeSource> sources = node_sources(
      {change.before, old_space, old_positions}, {*domain.mesh, space_, positions}, change.sources);
  Field<NodeId, Vec3> v(interpolated_values<Vec3>(flow.v, old_space, sources));
  TransferredFlow result;
  result.fault = projection.apply(v).fault;
  const auto had_momentum =
      momentum_of(region_motions(before, change.before, old_space, old_positions, flow.v));
  if (result.ok() && !change.sources.empty())
    result.fault = keep_momentum(domain, projection, had_momentum, v);
  result.flow = {{positions.x.begin(), positions.x.end()},
                 {v.begin(), v.end()},
                 guess_ ? guess_->p : stokes_->state_at_rest().p,
                 flow.power};
  double gross = 0.0;
  RegionMotion lost;
  for (const RegionMotion& each :
       region_motions(before, change.before, old_space, old_positions, flow.v, &gross)) {
    lost.momentum += each.momentum;
    lost.kinetic_energy += each.kinetic_energy;
  }
  for (const RegionMotion& each :
       region_motions(domain.scene, *domain.mesh, space_, positions, result.flow.v)) {
    lost.momentum -= each.momentum;
    lost.kinetic_energy -= each.kinetic_energy;
  }
  if (gross > 0.0) result.momentum_lost = lost.momentum.norm() / gross;
  result.energy_lost = lost.kinetic_energy;
  return result;
}

FlowSolution FiniteElementFlow::solve(const FlowDomain& domain, const Instant& instant) {
  MENISCUS_ASSERT(domain.mesh != nullptr, "finite elements need a volume mesh");
  const RemainderTimer timer(times_, "assemble");
  const TetMesh& mesh = *domain.mesh;
  if (!has_connectivity_of(domain)) use_connectivity(domain);
  if (has_inertia(domain.scene) && options_.elements != Elements::p2_p1)
    reject_input("liquids with inertia need P2-P1 elements");
  if (domain.stage == nullptr && has_inertia(domain.scene)) {
    if (domain.known == nullptr) return first_flow(domain, instant.t);
    const InstantProblem problem = instant_problem(
        domain, space_, node_positions(domain.scene, mesh, space_, options_.processes),
        options_.capillary, instant.t);
    return solution(domain, problem, {Field<NodeId, Vec3>(domain.known->v), domain.known->p}, {});
  }
  for (const CellId c : mesh.cells.ids())
    if (!(signed_volume(mesh, c) > 0.0))
      return failed_flow({FaultKind::inverted_cell, "a cell of the volume mesh is inverted",
                          mesh.x[mesh.cells[c][0]]});
  const InstantProblem problem = instant_problem(
      domain, space_, node_positions(domain.scene, mesh, space_, options_.processes),
      options_.capillary, instant.t);
  if (problem.fault) return failed_flow(*problem.fault);
  StokesState state = first_guess(domain, problem.stokes);
  if (domain.stage != nullptr) {
    last_duration_ = domain.stage->duration;
    drop_preconditioner_of_other_stages(last_duration_);
  }
  const bool is_kept = prepared_at_.has_value();
  const StokesReport report = stokes_->solve(
      problem.stokes, state, is_kept ? linear::Preconditioner::kept : linear::Preconditioner::fresh,
      times_);
  decide_on_preconditioner(problem.stokes, report, is_kept);
  // A kept one could not be made again from a checkpoint, whose scalars are later ones.
  if (has_varying_viscosity(domain.scene)) prepared_at_.reset();
  if (report.ok() && !problem.stokes.has_open_boundary)
    level_pressure(mesh, space_.pressure, state.p);
  FlowSolution result =
      report.ok() ? solution(domain, problem, state, report.power) : failed_flow(*report.fault);
  if (report.ok()) keep_solution(problem.stokes, std::move(state));
  result.iterations = report.iterations;
  if (const int straight = problem.stokes.positions.num_straightened; straight > 0)
    result.warnings.push_back(
        fmt::format("{} edges of surfaces stay straight in the elements", straight));
  result.warnings.insert(result.warnings.end(), report.failed_solvers.begin(),
                         report.failed_solvers.end());
  return result;
}

/// One made for a stage of another length is of no use: seven times the length took 2000
/// iterations.
void FiniteElementFlow::drop_preconditioner_of_other_stages(double duration) {
  constexpr double kMostRatio = 2.0;
  if (prepared_at_ &&
      (duration > kMostRatio * prepared_duration_ || kMostRatio * duration < prepared_duration_))
    prepared_at_.reset();
}

/// Keeps a preconditioner while the connectivity stands and it saves more than it costs: to make
/// one takes as long as three or four iterations (docs/benchmark-stokes.md).
void FiniteElementFlow::decide_on_preconditioner(const StokesProblem& problem,
                                                 const StokesReport& report, bool is_kept) {
  constexpr int kWorthOfOne = 3;
  const bool is_own = report.ok() && report.failed_solvers.empty() && report.iterations > 0 &&
                      !problem.is_generalised();  // whose steps make their own
  if (is_kept && report.ok() && report.iterations == 0) return;
  if (is_kept && is_own && iterations_then_ == 0) iterations_then_ = report.iterations;
  if (is_kept && is_own && report.iterations <= iterations_then_ + kWorthOfOne) return;
  prepared_at_.reset();
  if (is_kept || !is_own) return;
  prepared_at_ = problem.positions;
  prepared_duration_ = problem.inertia ? problem.inertia->duration : 0.0;
  iterations_then_ = report.iterations;
}

FlowSolution FiniteElementFlow::solution(const FlowDomain& domain, const InstantProblem& problem,
                                         const StokesState& state, const StokesPower& power) {
  const TetMesh& mesh = *domain.mesh;
  FlowSolution result;
  for (std::size_t i = 0; i < mesh.interfaces.size(); ++i) {
    const SurfaceMesh& surface = domain.scene.interfaces[i].mesh;
    const FaceNodeTable faces = face_nodes(space_, mesh, surface, mesh.interfaces[i]);
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
  for (const std::int32_t node : space_.pressure.nodes.cell_nodes)
    bulk.corner_pressure.push_back(state.p[static_cast<std::size_t>(node)]);
  result.bulk = std::move(bulk);
  if (!has_inertia(domain.scene)) return result;
  const Field<NodeId, Vec3>& x = problem.stokes.positions.x;
  result.nodal =
      NodalFlow{{x.begin(), x.end()}, {state.v.begin(), state.v.end()}, state.p, *result.power};
  if (domain.stage == nullptr)
    result.motions =
        region_motions(domain.scene, mesh, space_, problem.stokes.positions, result.nodal->v);
  return result;
}

void FiniteElementFlow::save(Archive& archive, const FlowDomain& domain) const {
  if (!has_connectivity_of(domain)) return;
  if (guess_) fem::save(*guess_, archive, "flow/guess");
  if (!prepared_at_) return;
  save_positions(*prepared_at_, archive, "flow/preconditioner");
  archive.integers["flow/preconditioner/iterations"] = {iterations_then_};
  if (prepared_duration_ > 0.0)
    archive.reals["flow/preconditioner/duration"] = {prepared_duration_};
}

/// Makes the preconditioner that the saved run had, so that a resumed run does the same arithmetic.
void FiniteElementFlow::restore_preconditioner(const Archive& archive, const FlowDomain& domain) {
  if (!archive.reals.contains("flow/preconditioner/x")) return;
  prepared_at_ = load_positions(archive, "flow/preconditioner");
  if (prepared_at_->x.size() != space_.velocity.num_nodes ||
      prepared_at_->is_curved.size() != domain.mesh->num_cells())
    reject_input("checkpoint: flow/preconditioner/x does not fit the volume mesh");
  iterations_then_ = static_cast<int>(
      entry_of_size(archive.integers, "flow/preconditioner/iterations", 1).front());
  FlowDomain then = domain;
  ImplicitStage stage;
  if (has_inertia(domain.scene)) {
    prepared_duration_ = entry_of_size(archive.reals, "flow/preconditioner/duration", 1).front();
    stage = stage_at_rest(domain.scene, prepared_duration_, prepared_at_->x);
    then.stage = &stage;
  }
  // Time, forces and velocities matter to the right-hand side alone.
  stokes_->prepare(instant_problem(then, space_, *prepared_at_, options_.capillary, 0.0).stokes);
}

void FiniteElementFlow::load(const Archive& archive, const FlowDomain& domain) {
  use_connectivity(domain);
  restore_preconditioner(archive, domain);
  if (!archive.reals.contains("flow/guess/velocity")) return;
  guess_ = load_state(archive, "flow/guess");
  const StokesState rest = stokes_->state_at_rest();
  if (guess_->v.size() != rest.v.size() || guess_->p.size() != rest.p.size())
    reject_input("checkpoint: flow/guess does not fit the volume mesh");
}

}  // namespace

std::unique_ptr<FlowSolver> make_finite_element_flow(const Options& options) {
  return std::make_unique<FiniteElementFlow>(options);
}

}  // namespace meniscus::fem
