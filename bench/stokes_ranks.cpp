// Wall seconds of what a flow solver does with a new mesh, on as many ranks as mpirun starts: the
// partition, the sparsity, a solve from rest with a fresh preconditioner, and one with the
// preconditioner kept, as in the two stages of a time step. The least of several repetitions, each
// phase beginning when all ranks are there (docs/parallel.md).
// Arguments: vertices on the drop [1430: 47 thousand in all], viscosity ratio [0.1], elements
// [P1-P1], repetitions [3], PETSc options.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <limits>
#include <string_view>

#include <fmt/format.h>

#include "meniscus/flow/fem/partition.hpp"
#include "meniscus/flow/fem/stokes_solver.hpp"
#include "meniscus/linear/collective.hpp"
#include "meniscus/volume/tetrahedralize.hpp"
#include "tests/flow/fem/stretched_drop.hpp"

namespace meniscus::fem {
namespace {

linear::Communicator world() { return linear::Communicator::world(); }

/// Seconds from the arrival of all ranks to the end of the last.
double seconds(const std::function<void()>& action) {
  using Clock = std::chrono::steady_clock;
  linear::barrier(world());
  const Clock::time_point start = Clock::now();
  action();
  linear::barrier(world());
  return std::chrono::duration<double>(Clock::now() - start).count();
}

enum Phase { partition, partition_and_sparsity, first_solve, second_solve, num_phases };
using Times = std::array<double, num_phases>;

Times phase_times(const StokesProblem& problem, const Options& options, int& iterations) {
  Times times{};
  times[partition] = seconds([&] { (void)make_partition(problem.space, world()); });
  std::optional<StokesSolver> solver;
  times[partition_and_sparsity] = seconds([&] { solver.emplace(problem.space, options); });
  PhaseTimes ignored;
  const auto solve = [&](linear::Preconditioner preconditioner) {
    StokesState state = solver->state_at_rest();
    const StokesReport report = solver->solve(problem, state, preconditioner, ignored);
    iterations = report.ok() ? report.iterations : -1;
  };
  times[first_solve] = seconds([&] { solve(linear::Preconditioner::fresh); });
  times[second_solve] = seconds([&] { solve(linear::Preconditioner::kept); });
  return times;
}

}  // namespace
}  // namespace meniscus::fem

int main(int count, char** arguments) {
  using namespace meniscus;
  using namespace meniscus::fem;
  const auto number = [&](int k, double otherwise) {
    return count > k ? std::atof(arguments[k]) : otherwise;
  };
  const Scene scene =
      stretched_drop(DropShape::sphere, static_cast<int>(number(1, 1430)), number(2, 0.1));
  Options options;
  options.processes = linear::Processes::all;
  if (count > 3 && std::string_view(arguments[3]) == "P2-P1") options.elements = Elements::p2_p1;
  if (count > 5) options.petsc_options = arguments[5];
  TetMesh mesh;
  if (const VolumeMeshReport report = tetrahedralize(scene, {}, mesh); !report.ok()) {
    fmt::print("{}\n", report.text());
    return EXIT_FAILURE;
  }
  const FlowSpace space = flow_space(mesh, options.elements);
  const StokesProblem problem = instant(scene, mesh, space);
  Times least;
  least.fill(std::numeric_limits<double>::infinity());
  int iterations = 0;
  for (int k = 0; k < static_cast<int>(number(4, 3)); ++k) {
    const Times now = phase_times(problem, options, iterations);
    for (std::size_t i = 0; i < now.size(); ++i) least[i] = std::min(least[i], now[i]);
  }
  if (world().rank() != 0) return EXIT_SUCCESS;
  fmt::print(
      "| ranks | elements | nodes | iterations | partition | partition + sparsity | fresh solve | "
      "kept "
      "solve | all |\n|---|---|---|---|---|---|---|---|---|\n"
      "| {} | {} | {} | {} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | {:.3f} |\n",
      world().size(), options.elements == Elements::p1_p1 ? "P1-P1" : "P2-P1",
      space.velocity.num_nodes, iterations, least[partition], least[partition_and_sparsity],
      least[first_solve], least[second_solve],
      least[partition_and_sparsity] + least[first_solve] + least[second_solve]);
  return EXIT_SUCCESS;
}
