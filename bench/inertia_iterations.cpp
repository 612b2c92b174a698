// Iterations of an implicit stage of liquids with inertia that begins at rest, over the length of
// the stage and the ratios of densities and viscosities, and what products of cells take
// (docs/inertia.md). Arguments: shape (sphere, prolate, dumbbell) [sphere], N0 [400], elements
// (P1-P1, P2-P1) [P2-P1], viscosity ratios [1e-3,1,1e3], density ratios [1e-3,1,1e3],
// s = μτ/(ρh²) of the matrix, h the mean edge of the interface [1e-3,1e-1,1e1,1e3,inf], and what
// drives the flow: a force on the drop across its axis, or walls in uniaxial extension at Ca = 0.17
// (force, extension) [force].

#include <cstdlib>
#include <limits>
#include <sstream>
#include <string>

#include <fmt/format.h>

#include "meniscus/core/memory.hpp"
#include "meniscus/core/processor_time.hpp"
#include "meniscus/flow/fem/laplacian_matrix.hpp"
#include "tests/flow/fem/stage_from_rest.hpp"

namespace meniscus::fem {
namespace {

std::vector<double> numbers_of(const std::string& list) {
  std::vector<double> result;
  std::istringstream stream(list);
  for (std::string word; std::getline(stream, word, ',');) result.push_back(std::stod(word));
  return result;
}

DropShape shape_of(const std::string& name) {
  if (name == "prolate") return DropShape::prolate;
  return name == "dumbbell" ? DropShape::dumbbell : DropShape::sphere;
}

/// Nanoseconds for each cell of the fastest of several calls.
template <class Action>
double least_nanoseconds(const TetMesh& mesh, Action action) {
  double least = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < 8; ++pass) {
    const double start = processor_seconds();
    action();
    least = std::min(least, processor_seconds() - start);
  }
  return 1e9 * least / mesh.num_cells();
}

void print_products(StageFromRest& stage) {
  for (const double duration : {std::numeric_limits<double>::infinity(), 1.0}) {
    const StokesProblem problem = stage.problem({}, duration);
    StokesProduct product(problem);
    const std::vector<double> v(3 * static_cast<std::size_t>(stage.space().velocity.num_nodes),
                                1.0),
        p(stage.space().pressure.vertex.size(), 1.0);
    std::vector<double> momentum(v.size()), continuity(p.size()), padded(v.size() + 1, 1.0);
    LaplacianMatrix matrix(stage.space(), stage.space().velocity.num_nodes);
    matrix.assemble(problem, product);
    const auto whole = [&] { product.add(v, p, momentum, continuity); };
    const double alone = least_nanoseconds(stage.mesh(), whole),
                 laplacian =
                     least_nanoseconds(stage.mesh(), [&] { matrix.multiply(padded, momentum); }),
                 convecting = least_nanoseconds(stage.mesh(), [&] { product.convect(v); });
    fmt::print(
        "{}: ns for each cell: a product {:.0f}, {:.0f} with convection (set: {:.0f}), a "
        "Laplacian {:.0f}\n",
        problem.inertia ? "inertia" : "Stokes flow", alone, least_nanoseconds(stage.mesh(), whole),
        convecting, laplacian);
  }
}

}  // namespace
}  // namespace meniscus::fem

int main(int count, char** given) {
  using namespace meniscus;
  using namespace meniscus::fem;
  keep_freed_memory();
  const auto argument = [&](int k, const char* otherwise) {
    return std::string(count > k ? given[k] : otherwise);
  };
  check_linear_options({});  // starts PETSc
  const std::string shape = argument(1, "sphere");
  const Elements elements = argument(3, "P2-P1") == "P1-P1" ? Elements::p1_p1 : Elements::p2_p1;
  StageFromRest stage(argument(7, "force") == "extension"
                          ? extended_drop(std::stoi(argument(2, "400")))
                          : pushed_drop(std::stoi(argument(2, "400"))),
                      shape_of(shape), elements);
  fmt::print("{}, {} cells, {} nodes of velocities\n", shape, stage.mesh().num_cells(),
             stage.space().velocity.num_nodes);
  if (elements == Elements::p2_p1) print_products(stage);
  const std::vector<double> lengths = numbers_of(argument(6, "1e-3,1e-1,1e1,1e3,inf"));
  std::string head = "\n| λ | ρ̂ |", rule = "|---|---|";
  for (const double s : lengths) head += fmt::format(" {:g} |", s), rule += "---|";
  fmt::print("{}\n{}\n", head, rule);
  for (const double viscosity_ratio : numbers_of(argument(4, "1e-3,1,1e3")))
    for (const double density_ratio : numbers_of(argument(5, "1e-3,1,1e3"))) {
      std::string row = fmt::format("| {:g} | {:g} |", viscosity_ratio, density_ratio);
      for (const double s : lengths) {
        const StokesReport report =
            stage.solve({viscosity_ratio, 1.0, density_ratio}, stage.duration_of(s, 1.0));
        row += report.ok() ? fmt::format(" {} |", report.iterations) : " failed |";
      }
      fmt::print("{}\n", row);
      std::fflush(stdout);
    }
  return EXIT_SUCCESS;
}
