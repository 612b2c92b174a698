#include "meniscus/flow/fem/finite_element_flow.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/boundary_conditions.hpp"
#include "meniscus/flow/fem/capillary_force.hpp"
#include "meniscus/flow/fem/excess_stress.hpp"
#include "meniscus/flow/fem/face_elements.hpp"
#include "meniscus/flow/fem/mesh_archive.hpp"
#include "meniscus/flow/fem/stokes_residual.hpp"
#include "meniscus/flow/fem/stokes_solver.hpp"
#include "meniscus/flow/fem/vertex_velocity.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus::fem {
namespace {

FlowReport failure(std::string text) { return {false, std::move(text), 0}; }

/// The problem's coefficients and forces; its tractions apart, as their power is paid for outside.
struct InstantProblem {
  StokesProblem stokes;
  Field<NodeId, Vec3> traction;
  std::string failure;
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

InstantProblem instant_problem(const Scene& scene, const TetMesh& mesh, const FlowSpace& space,
                               NodePositions positions, CapillaryForm form, double t) {
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
  for (const Vec3& x : at.x) problem.stokes.undisturbed.add(scene.flow.velocity(x, t));
  BoundaryConditions conditions = boundary_conditions(scene.boundary, nodes.boundary, at, t);
  problem.failure = std::move(conditions.failure);
  problem.stokes.constraints = std::move(conditions.constraints);
  problem.stokes.has_open_boundary = conditions.has_open_patch;
  problem.traction = std::move(conditions.traction);
  problem.stokes.load = problem.traction;
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i)
    if (scene.interfaces[i].tension != 0.0)
      add_capillary_force(scene.interfaces[i], form, nodes.interfaces[i], at, problem.stokes.load);
  return problem;
}

/// The pressures of its inside let no liquid through an interface, Σ A_i·v_i = 0 over its nodes,
/// exactly but for the linear solver's residual: what that leaves goes along the area vectors of
/// the faces, so that no volume is lost to a loose tolerance.
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

Field<TetVertexId, Vec3> at_vertices(const Field<NodeId, Vec3>& v, std::int32_t num_vertices) {
  const auto vertices = v.span().first(static_cast<std::size_t>(num_vertices));
  return Field<TetVertexId, Vec3>(std::vector<Vec3>(vertices.begin(), vertices.end()));
}

FlowReport straightened_report(const NodePositions& positions) {
  FlowReport report;
  if (positions.num_straightened > 0)
    report.warnings.push_back(fmt::format("{} edges of surfaces stay straight in the elements",
                                          positions.num_straightened));
  return report;
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

  std::span<const Mat3> excess_stress() const override { return excess_stress_; }

  void mark(const Scene& scene) override {
    follow_interfaces(scene);
    marked_ = mesh_.x;
  }
  FlowReport move_from_mark(const Scene& marked, std::span<const VertexField<Vec3>> motion,
                            double dt) override;

  double shortest_mesh_edge() const override { return shortest_edge(mesh_); }
  const TetMesh* volume_mesh() const override { return &mesh_; }
  std::span<const Vec3> mesh_velocity() const override {
    return state_ ? state_->v.span().first(static_cast<std::size_t>(mesh_.num_vertices()))
                  : std::span<const Vec3>{};
  }
  std::span<const double> corner_pressure() const override { return corner_pressure_; }

  void save(Archive& archive) const override {
    fem::save(mesh_, archive, "flow/mesh");
    if (state_) fem::save(*state_, archive, "flow/guess");
    if (!prepared_at_) return;
    save_positions(*prepared_at_, archive, "flow/preconditioner");
    archive.integers["flow/preconditioner/iterations"] = {iterations_then_};
  }
  void load(const Archive& archive, const Scene& scene) override;

  const PhaseTimes& times() const override { return times_; }

 private:
  void use_topology() {
    stokes_.reset();
    space_ = flow_space(mesh_, options_.elements);
    stokes_.emplace(space_, options_);
    state_.reset();
    prepared_at_.reset();
  }
  void follow_interfaces(const Scene& scene);
  void judge_preconditioner(const StokesProblem& problem, const StokesReport& report, bool is_kept);
  void take_solution(const Scene& scene, const InstantProblem& problem);
  void level_pressure();
  void restore_preconditioner(const Archive& archive, const Scene& scene);

  Options options_;
  TetMesh mesh_;
  Field<TetVertexId, Vec3> marked_;
  FlowSpace space_;
  std::optional<StokesSolver> stokes_;
  /// The last solution: the next solve's first guess while the topology stands.
  std::optional<StokesState> state_;
  /// Where the nodes were when the preconditioner was made that the next solve will keep, and the
  /// iterations of the solve that made it; none when the next is to make its own.
  std::optional<NodePositions> prepared_at_;
  int iterations_then_ = 0;
  std::vector<VertexField<Vec3>> velocity_;
  std::vector<double> corner_pressure_;
  Power power_;
  std::vector<Mat3> excess_stress_;
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
    problem.emplace(instant_problem(scene, mesh_, space_, node_positions(scene, mesh_, space_),
                                    options_.capillary, t));
  }
  if (!problem->failure.empty()) return failure(problem->failure);
  if (!state_) {
    state_ = stokes_->state_at_rest();
    state_->v = problem->stokes.undisturbed;
  }
  const bool is_kept = prepared_at_.has_value();
  const StokesReport report = stokes_->solve(
      problem->stokes, *state_,
      is_kept ? linear::Preconditioner::kept : linear::Preconditioner::fresh, times_);
  judge_preconditioner(problem->stokes, report, is_kept);
  FlowReport result = straightened_report(problem->stokes.positions);
  result.ok = report.ok;
  result.failure = report.failure;
  result.iterations = report.iterations;
  result.warnings.insert(result.warnings.end(), report.failed_solvers.begin(),
                         report.failed_solvers.end());
  if (report.ok) take_solution(scene, *problem);
  return result;
}

/// A preconditioner is kept while the topology stands and it saves more than it costs: to make one
/// takes as long as three or four iterations (docs/benchmark-stokes.md).
void FiniteElementFlow::judge_preconditioner(const StokesProblem& problem,
                                             const StokesReport& report, bool is_kept) {
  constexpr int kWorthOfOne = 3;
  const bool is_own = report.ok && report.failed_solvers.empty() && report.iterations > 0 &&
                      !problem.is_generalised();  // whose steps make their own
  if (is_kept && report.ok && report.iterations == 0) return;
  if (is_kept && is_own && report.iterations <= iterations_then_ + kWorthOfOne) return;
  prepared_at_.reset();
  if (is_kept || !is_own) return;
  prepared_at_ = problem.positions;
  iterations_then_ = report.iterations;
}

void FiniteElementFlow::take_solution(const Scene& scene, const InstantProblem& problem) {
  const PhaseTimer timer(times_, "assemble");
  if (!problem.stokes.has_open_boundary) level_pressure();
  velocity_.clear();
  for (std::size_t i = 0; i < mesh_.interfaces.size(); ++i) {
    const SurfaceMesh& surface = scene.interfaces[i].mesh;
    const FaceNodeTable faces = face_nodes(space_, mesh_, surface, mesh_.interfaces[i]);
    const NodePositions& positions = problem.stokes.positions;
    VertexField<Vec3> v = vertex_velocity(surface, faces, positions, state_->v);
    remove_net_flux(surface, net_flux(faces, positions, state_->v), v);
    velocity_.push_back(std::move(v));
  }
  const StokesPower power = stokes_->power(problem.stokes, *state_);
  double traction = 0.0;
  for (const NodeId i : problem.traction.ids()) traction += problem.traction[i].dot(state_->v[i]);
  power_ = {power.reaction + traction + power.body_force, power.dissipation};
  excess_stress_ = fem::excess_stress(problem.stokes, *state_);
  corner_pressure_.clear();
  for (const std::int32_t node : space_.pressure.nodes.cell_nodes)
    corner_pressure_.push_back(state_->p[static_cast<std::size_t>(node)]);
}

/// Where no boundary is open the pressure is given relative to its mean over the matrix's nodes.
void FiniteElementFlow::level_pressure() {
  const std::vector<RegionId>& region = space_.pressure.region;
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
  const VolumeVelocity velocity = volume_velocity(
      marked, mesh_, motion, at_vertices(state_->v, mesh_.num_vertices()), options_.volume_motion);
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
  prepared_at_ = load_positions(archive, "flow/preconditioner");
  if (prepared_at_->x.size() != space_.velocity.num_nodes ||
      prepared_at_->is_curved.size() != mesh_.num_cells())
    reject_input("checkpoint: flow/preconditioner/x does not fit the volume mesh");
  const auto iterations = archive.integers.find("flow/preconditioner/iterations");
  if (iterations == archive.integers.end() || iterations->second.size() != 1)
    reject_input("checkpoint: flow/preconditioner/iterations is missing");
  iterations_then_ = static_cast<int>(iterations->second.front());
  // Time and surface tension matter to the right-hand side alone.
  stokes_->prepare(
      instant_problem(scene, mesh_, space_, *prepared_at_, CapillaryForm::weak, 0.0).stokes);
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
