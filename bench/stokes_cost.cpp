// CPU seconds of each phase of one Stokes solve on graded meshes around a sphere, by linear solver.
// Arguments: vertices on the drop, viscosity ratio.

#include <cstdlib>
#include <ctime>

#include <fmt/format.h>

#include "meniscus/flow/fem/boundary_conditions.hpp"
#include "meniscus/flow/fem/capillary_force.hpp"
#include "meniscus/flow/fem/stokes_solver.hpp"
#include "tests/flow/fem/sphere_scene.hpp"

namespace meniscus::fem {
namespace {

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

Scene stretched_drop(int num_vertices, double lambda) {
  const Mat3 gradient = ImposedFlow::uniaxial_extension();
  return sphere_in_sphere(
      {.num_vertices = num_vertices,
       .viscosity_ratio = lambda,
       .Ca = 0.17,
       .outer_per_inner = 1.25,
       .outer_velocity = [gradient](const Vec3& x, double) { return Vec3(gradient * x); },
       .is_linear_flow = true});
}

StokesProblem instant(const Scene& scene, const TetMesh& mesh) {
  StokesProblem problem(mesh);
  for (const CellId c : mesh.cells.ids())
    problem.viscosity[c] = scene.liquids[mesh.region[c]].viscosity;
  problem.constraints = boundary_conditions(scene.boundary, mesh, 0.0).constraints;
  const VertexField<Vec3> force =
      capillary_force(scene.interfaces[0].mesh, scene.interfaces[0].tension, CapillaryForm::weak);
  for (const VertexId v : force.ids()) problem.load[mesh.interfaces[0].vertex(v)] += force[v];
  return problem;
}

void measure(const Scene& scene, const TetMesh& mesh, LinearSolver which, const char* label) {
  Options options;
  options.linear = which;
  const double start = cpu_seconds();
  StokesSolver solver(mesh, options);
  const double graph = cpu_seconds() - start;
  const StokesProblem problem = instant(scene, mesh);
  StokesJacobian jacobian(mesh, solver.pressure_space());
  jacobian.assemble(problem);
  const double before = cpu_seconds();
  jacobian.assemble(problem);
  const double assembly = cpu_seconds() - before;
  StokesState state = solver.state_at_rest();
  PhaseTimes times;
  const double begin = cpu_seconds();
  const StokesReport report = solver.solve(problem, state, linear::Preconditioner::fresh, times);
  const double solve = cpu_seconds() - begin - assembly;
  fmt::print("| {} | {} | {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.1f} |\n", label,
             mesh.num_vertices(), report.ok ? "yes" : report.failure, report.iterations, graph,
             assembly, solve, graph + assembly + solve,
             1e6 * (graph + assembly + solve) / mesh.num_vertices());
  std::fflush(stdout);
}

}  // namespace
}  // namespace meniscus::fem

int main(int count, char** arguments) {
  using namespace meniscus;
  using namespace meniscus::fem;
  const Scene scene = stretched_drop(count > 1 ? std::atoi(arguments[1]) : 400,
                                     count > 2 ? std::atof(arguments[2]) : 0.1);
  TetMesh mesh;
  if (const VolumeMeshReport report = tetrahedralize(scene, {}, mesh); !report.ok) {
    fmt::print("{}\n", report.failure);
    return EXIT_FAILURE;
  }
  fmt::print(
      "| solver | vertices | ok | iterations | graph | assembly | solve | total | µs/vertex |"
      "\n|---|---|---|---|---|---|---|---|---|\n");
  measure(scene, mesh, LinearSolver::block, "block");
  measure(scene, mesh, LinearSolver::minres, "minres");
  measure(scene, mesh, LinearSolver::paper_gmres, "paper-gmres");
  if (mesh.num_vertices() < 20000) measure(scene, mesh, LinearSolver::mumps, "mumps");
  return EXIT_SUCCESS;
}
