// Iterations and processor seconds of one Stokes solve from rest on graded meshes, by linear solver
// and phase, and of the assembly of matrices against the memory's speed and of P2's products
// (docs/benchmark-stokes.md). Arguments: shape (sphere, prolate, dumbbell) [sphere], N0 [400],
// elements (P1-P1, P2-P1) [P1-P1], viscosity ratios [0.1], solvers
// [block,minres,paper-gmres,mumps], tolerance [1e-6], PETSc options.

#include <cstdlib>
#include <sstream>
#include <string>

#include <fmt/format.h>
#include <sys/resource.h>

#include "bench/memory_bandwidth.hpp"
#include "meniscus/core/memory.hpp"
#include "meniscus/flow/fem/stokes_solver.hpp"
#include "meniscus/volume/tetrahedralize.hpp"
#include "tests/flow/fem/stretched_drop.hpp"

namespace meniscus::fem {
namespace {

struct Arguments {
  std::string shape = "sphere";
  int N0 = 400;
  Options options;
  std::vector<double> ratios;
  std::vector<std::string> solvers;
};

std::vector<std::string> words(const std::string& list) {
  std::vector<std::string> result;
  std::istringstream stream(list);
  for (std::string word; std::getline(stream, word, ',');) result.push_back(word);
  return result;
}

Arguments read_arguments(int count, char** given) {
  const auto argument = [&](int k, const char* otherwise) {
    return std::string(count > k ? given[k] : otherwise);
  };
  Arguments result;
  result.shape = argument(1, "sphere");
  result.N0 = std::stoi(argument(2, "400"));
  if (argument(3, "P1-P1") == "P2-P1") result.options.elements = Elements::p2_p1;
  for (const std::string& word : words(argument(4, "0.1")))
    result.ratios.push_back(std::stod(word));
  result.solvers = words(argument(5, "block,minres,paper-gmres,mumps"));
  result.options.rtol = std::stod(argument(6, "1e-6"));
  result.options.petsc_options = argument(7, "");
  return result;
}

DropShape shape_of(const std::string& name) {
  if (name == "prolate") return DropShape::prolate;
  return name == "dumbbell" ? DropShape::dumbbell : DropShape::sphere;
}

LinearSolver solver_of(const std::string& name) {
  if (name == "minres") return LinearSolver::minres;
  if (name == "mumps") return LinearSolver::mumps;
  return name == "paper-gmres" ? LinearSolver::paper_gmres : LinearSolver::block;
}

double peak_gigabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024e-9;
}

void set_viscosities(StokesProblem& problem, double ratio) {
  for (const CellId c : problem.mesh.cells.ids())
    problem.viscosity[c] = problem.mesh.region[c] == RegionId{0} ? 1.0 : ratio;
}

/// The least bytes that assembly must move: the matrices and the table of positions, once each.
double assembly_bytes(const FlowSpace& space, const linear::SaddleSystem& system) {
  std::size_t reals = system.A.values.size() + system.B.values.size() + system.C.values.size() +
                      3 * static_cast<std::size_t>(space.velocity.num_nodes);
  for (const linear::CsrView& laplacian : system.laplacians) reals += laplacian.values.size();
  const auto nodes = static_cast<std::size_t>(space.velocity.nodes_per_cell);
  // Nodes and positions of entries; for P1-P1 the edges, and edge, position and column of each
  // entry.
  const bool has_edges = space.elements == Elements::p1_p1;
  const std::size_t bytes_per_cell =
      4 * nodes + (has_edges ? 24 : 16 + 2 * (nodes * nodes + 4 * nodes + 16));
  return 8.0 * static_cast<double>(reals) +
         static_cast<double>(bytes_per_cell) * space.velocity.num_cells() +
         (has_edges ? 10.0 * static_cast<double>(system.C.values.size()) : 0.0);
}

void print_assembly(const StokesProblem& problem) {
  StokesJacobian jacobian(problem.space);
  double least = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < 4; ++pass) {
    const double start = processor_seconds();
    jacobian.assemble(problem);
    least = std::min(least, processor_seconds() - start);
  }
  const double bytes = assembly_bytes(problem.space, jacobian.system()),
               bandwidth = memory_bandwidth();
  const double cells = problem.space.velocity.num_cells();
  fmt::print(
      "assembly: {:.0f} ns and {:.0f} bytes per cell, {:.1f} GB/s; triad {:.1f} GB/s, which would "
      "take {:.0f} ns: ratio {:.1f}\n",
      1e9 * least / cells, bytes / cells, 1e-9 * bytes / least, 1e-9 * bandwidth,
      1e9 * bytes / bandwidth / cells, least * bandwidth / bytes);
}

/// Seconds of the fastest of several calls.
template <class Action>
double least_seconds(Action action) {
  double least = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < 8; ++pass) {
    const double start = processor_seconds();
    action();
    least = std::min(least, processor_seconds() - start);
  }
  return least;
}

/// What stands for the matrices of quadratic elements, with all cells straight or all curved.
void print_products(const StokesProblem& given, bool is_curved) {
  StokesProblem problem = given;
  for (char& each : problem.positions.is_curved) each = is_curved;
  const auto num_cells = static_cast<double>(problem.mesh.num_cells());
  const double making = least_seconds([&] { (void)StokesProduct(problem); });
  const StokesProduct product(problem);
  ProductJacobian jacobian(problem.space);
  const double assembly =
      least_seconds([&] { jacobian.assemble(problem, product, linear::Preconditioner::fresh); });
  const std::vector<double> v(3 * static_cast<std::size_t>(problem.space.velocity.num_nodes), 1.0),
      p(problem.space.pressure.vertex.size(), 1.0);
  std::vector<double> momentum(v.size()), continuity(p.size()), padded(v.size() + 1, 1.0);
  LaplacianMatrix matrix(problem.space, problem.space.velocity.num_nodes);
  matrix.assemble(problem, product);
  const double whole = least_seconds([&] { product.add(v, p, momentum, continuity); }),
               gradient = least_seconds([&] { product.add_straight_gradient(p, momentum); }),
               laplacian = least_seconds([&] { matrix.multiply(padded, momentum); });
  fmt::print(
      "{} cells, ns each: {:.0f} to make products, {:.0f} for preconditioners; a product takes "
      "{:.0f}, of pressures {:.0f}, of Laplacians {:.0f}\n",
      is_curved ? "curved" : "straight", 1e9 * making / num_cells, 1e9 * assembly / num_cells,
      1e9 * whole / num_cells, 1e9 * gradient / num_cells, 1e9 * laplacian / num_cells);
}

void print_solve(const Arguments& arguments, const StokesProblem& problem, double ratio,
                 const std::string& name) {
  Options options = arguments.options;
  options.linear = solver_of(name);
  const FlowSpace& space = problem.space;
  const double start = processor_seconds();
  (void)flow_space(problem.mesh, options.elements);
  StokesSolver solver(space, options);
  const double begin = processor_seconds();
  StokesState state = solver.state_at_rest();
  PhaseTimes ignored;
  const StokesReport report = solver.solve(problem, state, linear::Preconditioner::fresh, ignored);
  const double end = processor_seconds(), tables = begin - start,
               assembly = end - begin - report.setup_seconds - report.krylov_seconds,
               all = end - start;
  const std::string iterations =
      report.ok() && report.solver == options.linear ? std::to_string(report.iterations) : "failed";
  fmt::print(
      "| {} | {} | {} | {:g} | {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.1f} | "
      "{:.2f} |\n",
      arguments.shape, options.elements == Elements::p1_p1 ? "P1-P1" : "P2-P1",
      space.velocity.num_nodes, ratio, name, iterations, tables, assembly, report.setup_seconds,
      report.krylov_seconds, all, 1e6 * all / space.velocity.num_nodes, peak_gigabytes());
  std::fflush(stdout);
}

}  // namespace
}  // namespace meniscus::fem

int main(int count, char** given) {
  using namespace meniscus;
  using namespace meniscus::fem;
  keep_freed_memory();
  const Arguments arguments = read_arguments(count, given);
  check_linear_options(arguments.options);  // starts PETSc
  const Scene scene = stretched_drop(shape_of(arguments.shape), arguments.N0, 1.0);
  TetMesh mesh;
  if (const VolumeMeshReport report =
          tetrahedralize(scene, suited_volume_mesh(arguments.options.elements), mesh);
      !report.ok()) {
    fmt::print("{}\n", report.text());
    return EXIT_FAILURE;
  }
  const FlowSpace space = flow_space(mesh, arguments.options.elements);
  StokesProblem problem = instant(scene, mesh, space);
  fmt::print("{} vertices on the drop, {} in all, {} cells; mesh {:.2f} s\n",
             scene.interfaces[0].mesh.num_vertices(), mesh.num_vertices(), mesh.num_cells(),
             processor_seconds());
  print_assembly(problem);
  if (space.elements == Elements::p2_p1)
    for (const bool is_curved : {false, true}) print_products(problem, is_curved);
  fmt::print(
      "\n| shape | elements | nodes | λ | solver | iterations | tables | assembly | set-up | solve "
      "| "
      "all | µs/node | peak GB |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  std::fflush(stdout);
  for (const double ratio : arguments.ratios) {
    set_viscosities(problem, ratio);
    for (const std::string& name : arguments.solvers) print_solve(arguments, problem, ratio, name);
  }
  return EXIT_SUCCESS;
}
