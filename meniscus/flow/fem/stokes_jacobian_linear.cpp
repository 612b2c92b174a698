#include <array>
#include <span>

#include "meniscus/flow/fem/elements.hpp"
#include "meniscus/flow/fem/stokes_jacobian.hpp"

namespace meniscus::fem {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

}  // namespace

// The closed form of `CellMatrices<LinearElement>`, for what nearly all cells of nearly all runs
// are: with gradients g_i, block (a, b) of A is μV (g_a·g_b I + g_b g_aᵀ), of B −V/4 g_b, of C
// τV g_a·g_b. Single numbers in plain loops, all matrices in one pass: matrices of a cell that are
// made first and added afterwards take twice the time (docs/benchmark-stokes.md).
void StokesJacobian::add_free_linear_cell(const StokesProblem& problem, CellId c) {
  const std::size_t first = 16 * at(c.value);
  const std::int32_t* const nodes = space_.velocity.of(c).data();
  const std::int32_t* const pressures = space_.pressure.nodes.of(c).data();
  const std::uint16_t* const places = velocity_graph_.position.data() + first;
  const std::uint16_t* const coupling_places = coupling_graph_.position.data() + first;
  const std::uint16_t* const pressure_places = pressure_graph_.position.data() + first;
  const auto x = [&](std::size_t i) -> const Vec3& {
    return problem.positions.x[NodeId{nodes[i]}];
  };
  const auto [volume, g] = linear_tetrahedron({x(0), x(1), x(2), x(3)});
  const double viscosity = problem.viscosity[c], viscous = viscosity * volume,
               quarter = 0.25 * volume,
               stabilisation = pspg_parameter(volume, viscosity) / viscosity;
  std::array<double, 16> laplacians;
  for (std::size_t a = 0; a < 4; ++a) {
    const std::size_t start = at(velocity_graph_.row_start[at(nodes[a])]),
                      width = 3 * (at(velocity_graph_.row_start[at(nodes[a]) + 1]) - start);
    double *const rows = A_.data() + 9 * start,
                  *const divergences =
                      B_.data() + 3 * at(coupling_graph_.row_start[at(pressures[a])]),
                  *const stabilisations = C_.data() + pressure_graph_.row_start[at(pressures[a])],
                  *const row_of_laplacian = laplacians_.front().values.data() + start;
    const double sx = viscous * g[a][0], sy = viscous * g[a][1], sz = viscous * g[a][2];
    for (std::size_t b = 0; b < 4; ++b) {
      const double gx = g[b][0], gy = g[b][1], gz = g[b][2];
      const double laplacian = sx * gx + sy * gy + sz * gz;
      const std::size_t k = places[4 * a + b];
      double* const row_x = rows + 3 * k;
      double* const row_y = row_x + width;
      double* const row_z = row_y + width;
      row_x[0] += sx * gx + laplacian, row_x[1] += sy * gx, row_x[2] += sz * gx;
      row_y[0] += sx * gy, row_y[1] += sy * gy + laplacian, row_y[2] += sz * gy;
      row_z[0] += sx * gz, row_z[1] += sy * gz, row_z[2] += sz * gz + laplacian;
      row_of_laplacian[k] += laplacians[4 * a + b] = laplacian;
      double* const divergence = divergences + 3 * std::size_t{coupling_places[4 * a + b]};
      divergence[0] -= quarter * gx, divergence[1] -= quarter * gy, divergence[2] -= quarter * gz;
      stabilisations[pressure_places[4 * a + b]] += stabilisation * laplacian;
    }
    pressure_mass_[at(pressures[a])] += quarter / viscosity;
  }
  for (Laplacian& other : std::span(laplacians_).subspan(1))  // where walls let liquid slip
    for (std::size_t k = 0; k < 16; ++k)
      other.values[at(velocity_graph_.row_start[at(nodes[k / 4])]) + places[k]] += laplacians[k];
}

}  // namespace meniscus::fem
