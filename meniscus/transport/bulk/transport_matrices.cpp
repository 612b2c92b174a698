#include "meniscus/transport/bulk/transport_matrices.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/face_elements.hpp"
#include "meniscus/linear/transport_solver.hpp"
#include "meniscus/transport/bulk/cell_kernel.hpp"

namespace meniscus::bulk {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }
std::size_t region_of(const TetMesh& mesh, CellId c) { return at(mesh.region[c].value); }

template <std::size_t Size>
std::array<double, Size> scaled(std::array<double, Size> element, double factor) {
  for (double& each : element) each *= factor;
  return element;
}
template <std::size_t Size>
void add(std::array<double, Size>& total, double factor, const std::array<double, Size>& part) {
  for (std::size_t e = 0; e < Size; ++e) total[e] += factor * part[e];
}

double sum(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// ∮γ v·n φ_i dS by node, and the same with 1 for v·n.
struct BoundaryFlow {
  std::vector<double> flux, area;
};

template <class Action>
void at_boundary_points(const ScalarSpace& space, const NodePositions& positions, Action action) {
  for (const FaceId f : space.boundary.faces()) {
    const auto nodes = space.boundary.of(f);
    for (const fem::FacePoint& point : fem::face_points(positions.x, nodes)) action(nodes, point);
  }
}

BoundaryFlow boundary_flow(const ScalarSpace& space, const NodePositions& positions,
                           const Field<NodeId, Vec3>& v, double capacity) {
  const auto count = at(space.num_nodes());
  BoundaryFlow flow{std::vector<double>(count, 0.0), std::vector<double>(count, 0.0)};
  at_boundary_points(space, positions, [&](auto nodes, const fem::FacePoint& point) {
    Vec3 here = Vec3::Zero();
    for (std::size_t i = 0; i < nodes.size(); ++i) here += point.value[i] * v[nodes[i]];
    const double through = here.dot(point.area), area = point.area.norm();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      flow.flux[at(nodes[i].value)] += capacity * point.value[i] * through;
      flow.area[at(nodes[i].value)] += capacity * point.value[i] * area;
    }
  });
  return flow;
}

/// ∫γ u·∇φ_i, and ∫γ ∇φ_i·∇φ_j.
struct WeakDivergence {
  std::vector<double> of_velocity;
  MatrixValues of_potential;
};
WeakDivergence weak_divergence(const TetMesh& mesh, const ScalarSpace& space,
                               const NodePositions& positions, const Field<NodeId, Vec3>& u,
                               std::span<const double> capacity) {
  WeakDivergence result{std::vector<double>(at(space.num_nodes()), 0.0),
                        MatrixValues(space.graph.num_entries(), 0.0)};
  with_kernel(space, positions, [&](auto& cell) {
    for (const CellId c : mesh.cells.ids()) {
      cell.go_to(c);
      const double weight = capacity[region_of(mesh, c)];
      const auto part = cell.integral(cell.along(cell.at_points(u)));
      for (std::size_t i = 0; i < part.size(); ++i)
        result.of_velocity[at(cell.nodes()[i])] += weight * part[i];
      add_to(space, c, scaled(cell.stiffness(), weight), result.of_potential);
    }
  });
  return result;
}

/// ψ with Kψ near −d; returns what of d is left.
std::vector<double> solve_potential(const ScalarSpace& space, const MatrixValues& stiffness,
                                    std::vector<double> defect, std::vector<double>& potential) {
  // What is left multiplies the difference from a mean alone, so that it need not be small.
  constexpr double kTolerance = 0.3;
  constexpr int kMostIterations = 10;
  const linear::TransportSolver solver(
      {space.num_nodes(), space.num_nodes(), space.graph.row_start, space.graph.columns, stiffness},
      linear::ScalarSystem::potential);
  for (double& each : defect) each = -each;
  potential.assign(defect.size(), 0.0);
  (void)solver.solve(defect, potential, kTolerance, kMostIterations);
  const std::vector<double> reached = product(space, stiffness, potential);
  for (std::size_t i = 0; i < defect.size(); ++i) defect[i] = reached[i] - defect[i];
  return defect;
}

/// How far the stabilisation looks upstream [1/G]. It is half a cell where convection outweighs
/// conduction, half a step where neither does much in it. Where conduction outweighs it is nothing.
double upstream_time(double speed, double size, double diffusivity, double duration) {
  const double peclet = diffusivity > 0.0 ? 0.5 * speed * size / diffusivity : HUGE_VAL;
  if (!(peclet > 1.0)) return 0.0;
  const double convection = 2.0 * speed / size, step = 2.0 / duration;
  return (1.0 - 1.0 / peclet) / std::hypot(convection, step);
}

MatrixValues boundary_matrix(const ScalarSpace& space, const NodePositions& positions,
                             const TransportVelocity& velocity, double capacity) {
  MatrixValues values(space.graph.num_entries(), 0.0);
  const auto entry = [&](std::int32_t row, std::int32_t column) -> double& {
    const auto begin = space.graph.columns.begin() + space.graph.row_start[at(row)],
               end = space.graph.columns.begin() + space.graph.row_start[at(row) + 1];
    const auto found = std::lower_bound(begin, end, column);
    MENISCUS_ASSERT(found != end && *found == column, "no entry {}, {}", row, column);
    return values[static_cast<std::size_t>(found - space.graph.columns.begin())];
  };
  at_boundary_points(space, positions, [&](auto nodes, const fem::FacePoint& point) {
    double through = velocity.normal_correction * point.area.norm();
    for (std::size_t i = 0; i < nodes.size(); ++i)
      through += point.value[i] * (velocity.u[nodes[i]]).dot(point.area);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t j = 0; j < nodes.size(); ++j)
        entry(nodes[i].value, nodes[j].value) -=
            capacity * point.value[i] * point.value[j] * through;
  });
  return values;
}

}  // namespace

std::vector<double> product(const ScalarSpace& space, const MatrixValues& values,
                            std::span<const double> x) {
  const fem::NodeGraph& graph = space.graph;
  std::vector<double> result(x.size(), 0.0);
  for (std::size_t i = 0; i < result.size(); ++i) {
    double total = 0.0;
    for (auto k = at(graph.row_start[i]); k < at(graph.row_start[i + 1]); ++k)
      total += values[k] * x[at(graph.columns[k])];
    result[i] = total;
  }
  return result;
}

MassMatrix mass_matrix(const Scene& scene, const TetMesh& mesh, const ScalarSpace& space,
                       const NodePositions& positions, std::span<const double> capacity) {
  std::vector<double> density = volume_shares(scene, mesh, space, positions);
  for (std::size_t r = 0; r < density.size(); ++r) density[r] *= capacity[r];
  MassMatrix mass{MatrixValues(space.graph.num_entries(), 0.0),
                  std::vector<double>(at(space.num_nodes()), 0.0)};
  with_kernel(space, positions, [&](auto& cell) {
    for (const CellId c : mesh.cells.ids()) {
      cell.go_to(c);
      const auto element = scaled(cell.mass(), density[region_of(mesh, c)]);
      add_to(space, c, element, mass.values);
      const std::size_t count = cell.nodes().size();
      for (std::size_t i = 0; i < count; ++i)
        mass.rows[at(cell.nodes()[i])] += sum(std::span(element).subspan(i * count, count));
    }
  });
  return mass;
}

MatrixValues stiffness_matrix(const TetMesh& mesh, const ScalarSpace& space,
                              const NodePositions& positions,
                              std::span<const double> conductivity) {
  MatrixValues values(space.graph.num_entries(), 0.0);
  with_kernel(space, positions, [&](auto& cell) {
    for (const CellId c : mesh.cells.ids()) {
      cell.go_to(c);
      add_to(space, c, scaled(cell.stiffness(), conductivity[region_of(mesh, c)]), values);
    }
  });
  return values;
}

TransportVelocity transport_velocity(const TetMesh& mesh, const ScalarSpace& space,
                                     const NodePositions& positions, Field<NodeId, Vec3> u,
                                     const Field<NodeId, Vec3>& v, std::span<const double> capacity,
                                     std::span<const double> growth) {
  TransportVelocity result;
  result.u = std::move(u);
  BoundaryFlow through = boundary_flow(space, positions, v, capacity[0]);
  const double net = sum(through.flux), area = sum(through.area);
  const double largest = std::abs(
      *std::ranges::max_element(through.flux, {}, [](double each) { return std::abs(each); }));
  result.crosses_boundary = largest > 1e-13 * area;
  if (result.crosses_boundary) result.normal_correction = -net / area;
  WeakDivergence divergence = weak_divergence(mesh, space, positions, result.u, capacity);
  std::vector<double> defect = std::move(divergence.of_velocity);
  for (std::size_t i = 0; i < defect.size(); ++i) {
    defect[i] -= growth[i];
    if (result.crosses_boundary)
      defect[i] -= through.flux[i] + result.normal_correction * through.area[i];
  }
  // The sum is that of what boundaries and volumes lose to round-off.
  const double rest = sum(defect) / static_cast<double>(defect.size());
  for (double& each : defect) each -= rest;
  result.defect =
      solve_potential(space, divergence.of_potential, std::move(defect), result.potential);
  return result;
}

TransportMatrices transport_matrices(const TetMesh& mesh, const ScalarSpace& space,
                                     const NodePositions& positions,
                                     const TransportVelocity& velocity,
                                     const Coefficients& coefficients, double duration) {
  TransportMatrices matrices{MatrixValues(space.graph.num_entries(), 0.0),
                             {},
                             MatrixValues(space.graph.num_entries(), 0.0),
                             std::vector<double>(at(space.num_nodes()), 0.0)};
  with_kernel(space, positions, [&](auto& cell) {
    for (const CellId c : mesh.cells.ids()) {
      cell.go_to(c);
      const double capacity = coefficients.capacity[region_of(mesh, c)],
                   conductivity = coefficients.conductivity[region_of(mesh, c)];
      auto u = cell.at_points(velocity.u);
      const auto correction = cell.gradients_of(velocity.potential);
      double squared = 0.0;
      for (std::size_t q = 0; q < u.size(); ++q)
        squared += cell.weights()[q] * (u[q] += correction[q]).squaredNorm();
      const auto along = cell.along(u);
      const auto convection = scaled(cell.product(along, cell.values()), capacity);
      const double tau = upstream_time(std::sqrt(squared / cell.volume()), cell.size(),
                                       conductivity / capacity, duration);
      auto rates = convection;
      add(rates, -conductivity, cell.stiffness());
      const double source = coefficients.source[region_of(mesh, c)];
      auto given = scaled(cell.integral(cell.values()), source);
      if (tau > 0.0) {
        const auto upstream = cell.integral(along);
        const auto laplacians = cell.laplacians();
        add(rates, -tau * capacity, cell.product(along, along));
        for (std::size_t a = 0; a < upstream.size(); ++a)
          for (std::size_t b = 0; b < upstream.size(); ++b)
            rates[a * upstream.size() + b] += tau * conductivity * upstream[a] * laplacians[b];
        add_to(space, c, scaled(convection, tau), matrices.streamline);
        add(given, tau * source, upstream);
      }
      if (source != 0.0)
        for (std::size_t a = 0; a < given.size(); ++a)
          matrices.sources[at(cell.nodes()[a])] += given[a];
      add_to(space, c, rates, matrices.rates);
    }
  });
  if (velocity.crosses_boundary) {
    matrices.boundary = boundary_matrix(space, positions, velocity, coefficients.capacity[0]);
    for (std::size_t k = 0; k < matrices.rates.size(); ++k)
      matrices.rates[k] += matrices.boundary[k];
  }
  return matrices;
}

}  // namespace meniscus::bulk
