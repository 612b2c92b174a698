#include "meniscus/flow/fem/finite_element_flow.hpp"

#include <limits>
#include <optional>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/boundary_conditions.hpp"
#include "meniscus/flow/fem/capillary_force.hpp"
#include "meniscus/flow/fem/mesh_archive.hpp"
#include "meniscus/flow/fem/stokes_residual.hpp"
#include "meniscus/flow/fem/stokes_solver.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus::fem {
namespace {

FlowReport failure(std::string text) { return {false, std::move(text), 0}; }

/// The problem's coefficients and forces; its tractions apart, as their power is paid for outside.
struct InstantProblem {
  StokesProblem stokes;
  Field<TetVertexId, Vec3> traction;
  std::string failure;
};

InstantProblem instant_problem(const Scene& scene, const TetMesh& mesh, CapillaryForm form,
                               double t) {
  InstantProblem problem{StokesProblem(mesh), {}, {}};
  for (const CellId c : mesh.cells.ids()) {
    const Liquid& liquid = scene.liquids[mesh.region[c]];
    problem.stokes.viscosity[c] = liquid.viscosity;
    problem.stokes.body_force[c] = liquid.body_force;
  }
  BoundaryConditions conditions = boundary_conditions(scene.boundary, mesh, t);
  problem.failure = std::move(conditions.failure);
  problem.stokes.constraints = std::move(conditions.constraints);
  problem.stokes.has_open_boundary = conditions.has_open_patch;
  problem.traction = std::move(conditions.traction);
  problem.stokes.load = problem.traction;
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
    const Interface& interface = scene.interfaces[i];
    if (interface.tension == 0.0) continue;
    const VertexField<Vec3> force = capillary_force(interface.mesh, interface.tension, form);
    for (const VertexId v : force.ids())
      problem.stokes.load[mesh.interfaces[i].vertex(v)] += force[v];
  }
  return problem;
}

/// The pressures of its inside let no liquid through an interface, Σ A_i·v_i = 0, exactly but for
/// the linear solver's residual: what that leaves goes along the area vectors, so that no volume is
/// lost to a loose tolerance.
void remove_net_flux(const SurfaceMesh& surface, VertexField<Vec3>& velocity) {
  const VertexField<Vec3> area = vertex_area_vectors(surface);
  double flux = 0.0, squared = 0.0;
  for (const VertexId v : area.ids()) {
    flux += area[v].dot(velocity[v]);
    squared += area[v].squaredNorm();
  }
  for (const VertexId v : area.ids()) velocity[v] -= flux / squared * area[v];
}

class FiniteElementFlow final : public FlowSolver {
 public:
  explicit FiniteElementFlow(const Options& options) : options_(options) {
    check_linear_options(options);
  }

  FlowReport rebuild(const Scene& scene) override {
    const PhaseTimer timer(times_, "tetrahedralize");
    const VolumeMeshReport report = tetrahedralize(scene, options_.volume_mesh, mesh_);
    if (!report.ok) return failure(report.failure);
    use_topology();
    return {};
  }

  FlowReport solve(const Scene& scene, double t) override;

  std::span<const VertexField<Vec3>> velocity() const override { return velocity_; }
  std::optional<Power> power() const override { return power_; }

  void mark(const Scene& scene) override {
    follow_interfaces(scene);
    marked_ = mesh_.x;
  }
  FlowReport move_from_mark(const Scene& marked, std::span<const VertexField<Vec3>> motion,
                            double dt) override;

  double shortest_mesh_edge() const override { return shortest_edge(mesh_); }
  const TetMesh* volume_mesh() const override { return &mesh_; }
  std::span<const Vec3> mesh_velocity() const override {
    return state_ ? state_->v.span() : std::span<const Vec3>{};
  }
  std::span<const double> corner_pressure() const override { return corner_pressure_; }

  void save(Archive& archive) const override {
    fem::save(mesh_, archive, "flow/mesh");
    if (state_) fem::save(*state_, archive, "flow/guess");
    if (!prepared_at_.empty()) save_positions(prepared_at_, archive, "flow/preconditioner/x");
  }
  void load(const Archive& archive, const Scene& scene) override;

  const PhaseTimes& times() const override { return times_; }

 private:
  void use_topology() {
    stokes_.emplace(mesh_, options_);
    state_.reset();
    prepared_at_ = {};
  }
  void follow_interfaces(const Scene& scene);
  void take_solution(const Scene& scene, const InstantProblem& problem);
  void level_pressure();
  void restore_preconditioner(const Archive& archive, const Scene& scene);

  Options options_;
  TetMesh mesh_;
  Field<TetVertexId, Vec3> marked_;
  std::optional<StokesSolver> stokes_;
  /// The last solution: the next solve's first guess while the topology stands.
  std::optional<StokesState> state_;
  /// Where the vertices were when the preconditioner was made that the next solve will keep; empty
  /// when it is to make its own. Every preconditioner serves two solves: the stages of a step.
  Field<TetVertexId, Vec3> prepared_at_;
  std::vector<VertexField<Vec3>> velocity_;
  std::vector<double> corner_pressure_;
  Power power_;
  PhaseTimes times_;
};

/// Surface vertices are where the scene has them, even where it was corrected after the mesh moved.
void FiniteElementFlow::follow_interfaces(const Scene& scene) {
  MENISCUS_ASSERT(mesh_.interfaces.size() == scene.interfaces.size(), "{} {}",
                  mesh_.interfaces.size(), scene.interfaces.size());
  for (std::size_t i = 0; i < mesh_.interfaces.size(); ++i) {
    const SurfaceMesh& surface = scene.interfaces[i].mesh;
    MENISCUS_ASSERT(mesh_.interfaces[i].num_vertices == surface.num_vertices(), "{} {}",
                    mesh_.interfaces[i].num_vertices, surface.num_vertices());
    for (const VertexId v : surface.x.ids()) mesh_.x[mesh_.interfaces[i].vertex(v)] = surface.x[v];
  }
}

FlowReport FiniteElementFlow::solve(const Scene& scene, double t) {
  if (!stokes_) return failure("there is no volume mesh yet");
  follow_interfaces(scene);
  for (const CellId c : mesh_.cells.ids())
    if (!(signed_volume(mesh_, c) > 0.0)) return failure("a cell of the volume mesh is inverted");
  std::optional<InstantProblem> problem;
  {
    const PhaseTimer timer(times_, "assemble");
    problem.emplace(instant_problem(scene, mesh_, options_.capillary, t));
  }
  if (!problem->failure.empty()) return failure(problem->failure);
  if (!state_) {
    state_ = stokes_->state_at_rest();
    for (const TetVertexId v : mesh_.x.ids()) state_->v[v] = scene.flow.velocity(mesh_.x[v], t);
  }
  const bool is_kept = !prepared_at_.empty();
  const StokesReport report = stokes_->solve(
      problem->stokes, *state_,
      is_kept ? linear::Preconditioner::kept : linear::Preconditioner::fresh, times_);
  const bool was_made =
      !is_kept && report.ok && report.solver == options_.linear && report.iterations > 0;
  prepared_at_ = was_made ? mesh_.x : Field<TetVertexId, Vec3>();
  if (!report.ok) return {false, report.failure, report.iterations, report.failed_solvers};
  take_solution(scene, *problem);
  return {true, {}, report.iterations, report.failed_solvers};
}

void FiniteElementFlow::take_solution(const Scene& scene, const InstantProblem& problem) {
  const PhaseTimer timer(times_, "assemble");
  if (!problem.stokes.has_open_boundary) level_pressure();
  velocity_.clear();
  for (std::size_t i = 0; i < mesh_.interfaces.size(); ++i) {
    const EmbeddedSurface& surface = mesh_.interfaces[i];
    VertexField<Vec3> v(surface.num_vertices);
    for (const VertexId at : v.ids()) v[at] = state_->v[surface.vertex(at)];
    remove_net_flux(scene.interfaces[i].mesh, v);
    velocity_.push_back(std::move(v));
  }
  const StokesPower power = fem::power(problem.stokes, stokes_->pressure_space(), *state_);
  double traction = 0.0;
  for (const TetVertexId v : problem.traction.ids())
    traction += problem.traction[v].dot(state_->v[v]);
  power_ = {power.reaction + traction + power.body_force, power.dissipation};
  corner_pressure_.clear();
  for (const std::int32_t node : stokes_->pressure_space().nodes.cell_nodes)
    corner_pressure_.push_back(state_->p[static_cast<std::size_t>(node)]);
}

/// Where no boundary is open the pressure is given relative to its mean over the matrix's nodes.
void FiniteElementFlow::level_pressure() {
  const std::vector<RegionId>& region = stokes_->pressure_space().region;
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < region.size(); ++i)
    if (region[i] == RegionId{0}) {
      sum += state_->p[i];
      ++count;
    }
  if (count == 0) return;
  for (double& p : state_->p) p -= sum / count;
}

FlowReport FiniteElementFlow::move_from_mark(const Scene& marked,
                                             std::span<const VertexField<Vec3>> motion, double dt) {
  if (!state_) return failure("there is no velocity to move the mesh with");
  const PhaseTimer timer(times_, "move mesh");
  mesh_.x = marked_;
  const VolumeVelocity velocity =
      volume_velocity(marked, mesh_, motion, state_->v, options_.volume_motion);
  for (const TetVertexId v : mesh_.x.ids()) mesh_.x[v] += dt * velocity.w[v];
  for (const CellId c : mesh_.cells.ids())
    if (!(signed_volume(mesh_, c) > 0.0)) {
      mesh_.x = marked_;
      return failure("moving the volume mesh inverts a cell");
    }
  return {};
}

/// A resumed run must do the same arithmetic: it gets the preconditioner that the saved one had.
void FiniteElementFlow::restore_preconditioner(const Archive& archive, const Scene& scene) {
  if (!archive.reals.contains("flow/preconditioner/x")) return;
  prepared_at_ = load_positions(archive, "flow/preconditioner/x");
  if (prepared_at_.size() != mesh_.num_vertices())
    reject_input("checkpoint: flow/preconditioner/x does not fit the volume mesh");
  TetMesh then = mesh_;
  then.x = prepared_at_;
  // The time matters to the values of the boundary's velocities alone.
  stokes_->prepare(instant_problem(scene, then, options_.capillary, 0.0).stokes);
}

void FiniteElementFlow::load(const Archive& archive, const Scene& scene) {
  mesh_ = load_mesh(archive, "flow/mesh");
  if (mesh_.interfaces.size() != scene.interfaces.size())
    reject_input("checkpoint: the volume mesh has {} interfaces, the scene {}",
                 mesh_.interfaces.size(), scene.interfaces.size());
  for (std::size_t i = 0; i < mesh_.interfaces.size(); ++i)
    if (mesh_.interfaces[i].num_vertices != scene.interfaces[i].mesh.num_vertices())
      reject_input("checkpoint: interface {} has {} vertices in the volume mesh, {} in the scene",
                   i, mesh_.interfaces[i].num_vertices, scene.interfaces[i].mesh.num_vertices());
  use_topology();
  restore_preconditioner(archive, scene);
  if (!archive.reals.contains("flow/guess/velocity")) return;
  state_ = load_state(archive, "flow/guess");
  const StokesState rest = stokes_->state_at_rest();
  if (state_->v.size() != rest.v.size() || state_->p.size() != rest.p.size())
    reject_input("checkpoint: flow/guess does not fit the volume mesh");
}

}  // namespace

std::unique_ptr<FlowSolver> make_finite_element_flow(const Options& options) {
  return std::make_unique<FiniteElementFlow>(options);
}

}  // namespace meniscus::fem
