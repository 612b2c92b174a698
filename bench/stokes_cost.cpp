// CPU seconds of each phase of one Stokes solve on graded meshes around a sphere, by linear solver.
// Arguments: vertices on the drop, viscosity ratio, elements (P1-P1 or P2-P1), "block" for that
// solver alone.

#include <cstdlib>
#include <ctime>
#include <string_view>

#include <fmt/format.h>

#include "bench/stretched_drop.hpp"
#include "meniscus/flow/fem/stokes_solver.hpp"

namespace meniscus::fem {
namespace {

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void measure(const Scene& scene, const TetMesh& mesh, Elements elements, LinearSolver which,
             const char* label) {
  Options options;
  options.elements = elements;
  options.linear = which;
  const double start = cpu_seconds();
  const FlowSpace space = flow_space(mesh, elements);
  StokesSolver solver(space, options);
  const double graph = cpu_seconds() - start;
  const StokesProblem problem = instant(scene, mesh, space);
  StokesJacobian jacobian(space);
  jacobian.assemble(problem);
  const double before = cpu_seconds();
  jacobian.assemble(problem);
  const double assembly = cpu_seconds() - before;
  StokesState state = solver.state_at_rest();
  PhaseTimes times;
  const double begin = cpu_seconds();
  const StokesReport report = solver.solve(problem, state, linear::Preconditioner::fresh, times);
  const double solve = cpu_seconds() - begin - assembly;
  fmt::print("| {} | {} | {} | {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.1f} |\n", label,
             elements == Elements::p1_p1 ? "P1-P1" : "P2-P1", space.velocity.num_nodes,
             report.ok ? "yes" : report.failure, report.iterations, graph, assembly, solve,
             graph + assembly + solve, 1e6 * (graph + assembly + solve) / space.velocity.num_nodes);
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
      "| solver | elements | nodes | ok | iterations | graph | assembly | solve | total | µs/node |"
      "\n|---|---|---|---|---|---|---|---|---|---|\n");
  const bool is_quadratic = count > 3 && std::string_view(arguments[3]) == "P2-P1";
  const Elements elements = is_quadratic ? Elements::p2_p1 : Elements::p1_p1;
  measure(scene, mesh, elements, LinearSolver::block, "block");
  const bool has_peers = count <= 4 || std::string_view(arguments[4]) != "block";
  if (!has_peers) return EXIT_SUCCESS;
  measure(scene, mesh, elements, LinearSolver::minres, "minres");
  if (!is_quadratic) measure(scene, mesh, elements, LinearSolver::paper_gmres, "paper-gmres");
  if (mesh.num_vertices() < 20000) measure(scene, mesh, elements, LinearSolver::mumps, "mumps");
  return EXIT_SUCCESS;
}
