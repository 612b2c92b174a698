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
void add(std::array<double, Size>& total, double factor, const std::array<double, Size>& part) {
  for (std::size_t e = 0; e < Size; ++e) total[e] += factor * part[e];
}

double sum(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

double normal_flow(std::span<const NodeId> nodes, const fem::FacePoint& point,
                   const Field<NodeId, Vec3>& v) {
  Vec3 here = Vec3::Zero();
  for (std::size_t i = 0; i < nodes.size(); ++i) here += point.value[i] * v[nodes[i]];
  return here.dot(point.area);
}

/// −∮γφ_j v·n dS by node; v·n is shifted so that the boundary has no net flux. Adds −∮γφ_iφ_j v·n
/// dS to the rates. Empty where nothing crosses the boundary.
std::vector<double> add_inflow(const ScalarSpace& space, const NodePositions& positions,
                               const Field<NodeId, Vec3>& v, double capacity, MatrixValues& rates) {
  const auto count = at(space.num_nodes());
  std::vector<double> flux(count, 0.0), area(count, 0.0);
  std::vector<fem::FacePoints> points;  // by face
  for (const FaceId f : space.boundary.faces()) {
    const auto nodes = space.boundary.of(f);
    for (const fem::FacePoint& point : points.emplace_back(fem::face_points(positions.x, nodes))) {
      const double through = normal_flow(nodes, point, v), here = point.area.norm();
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        flux[at(nodes[i].value)] += capacity * point.value[i] * through;
        area[at(nodes[i].value)] += capacity * point.value[i] * here;
      }
    }
  }
  const double whole = sum(area);
  const double largest =
      std::abs(*std::ranges::max_element(flux, {}, [](double each) { return std::abs(each); }));
  if (!(largest > 1e-13 * whole)) return {};
  const double shift = -sum(flux) / whole;
  for (std::size_t i = 0; i < count; ++i) flux[i] = -(flux[i] + shift * area[i]);
  for (const FaceId f : space.boundary.faces()) {
    const auto nodes = space.boundary.of(f);
    Eigen::MatrixXd element = Eigen::MatrixXd::Zero(std::ssize(nodes), std::ssize(nodes));
    for (const fem::FacePoint& point : points[at(f.value)]) {
      const Eigen::Map<const Eigen::VectorXd> value(point.value.data(), element.rows());
      element += capacity * (normal_flow(nodes, point, v) + shift * point.area.norm()) * value *
                 value.transpose();
    }
    for (Eigen::Index i = 0; i < element.rows(); ++i)
      for (Eigen::Index j = 0; j < element.cols(); ++j)
        rates[place_of(space.graph, nodes[static_cast<std::size_t>(i)],
                       nodes[static_cast<std::size_t>(j)])] -= element(i, j);
  }
  return flux;
}

/// ψ with Kψ near −d.
std::vector<double> solve_potential(const ScalarSpace& space, const MatrixValues& stiffness,
                                    std::span<const double> defect) {
  // What is left multiplies the difference from a mean alone, so that it need not be small.
  constexpr double kTolerance = 0.3;
  constexpr int kMostIterations = 10;
  const linear::TransportSolver solver(
      {space.num_nodes(), space.num_nodes(), space.graph.row_start, space.graph.columns, stiffness},
      linear::ScalarSystem::potential);
  std::vector<double> right(defect.begin(), defect.end()), potential(defect.size(), 0.0);
  for (double& each : right) each = -each;
  (void)solver.solve(right, potential, kTolerance, kMostIterations);
  return potential;
}

/// Adds what a potential convects to the rates, and its rows' sums to the defect.
void add_potential_flow(const ScalarSpace& space, const MatrixValues& stiffness,
                        std::span<const double> potential, MatrixValues& rates,
                        std::vector<double>& defect) {
  const fem::NodeGraph& graph = space.graph;
  for (std::size_t i = 0; i < defect.size(); ++i) {
    double half = 0.0;
    std::size_t diagonal = 0;
    for (auto e = at(graph.row_start[i]); e < at(graph.row_start[i + 1]); ++e) {
      const auto j = at(graph.columns[e]);
      if (j == i) diagonal = e;
      // Zero at the diagonal.
      const double flow = 0.5 * stiffness[e] * (potential[j] - potential[i]);
      rates[e] += flow;
      half += flow;
    }
    rates[diagonal] += half;
    defect[i] += 2.0 * half;
  }
}

/// How far the stabilisation looks upstream [1/G]. It is half a cell where convection outweighs
/// conduction, half a step where neither does much in it. Where conduction outweighs it is nothing.
double upstream_time(double speed, double size, double diffusivity, double duration) {
  const double peclet = diffusivity > 0.0 ? 0.5 * speed * size / diffusivity : HUGE_VAL;
  if (!(peclet > 1.0)) return 0.0;
  const double convection = 2.0 * speed / size, step = 2.0 / duration;
  return (1.0 - 1.0 / peclet) / std::hypot(convection, step);
}

/// What the cells give: the operators without potential and boundary, ∫γu·∇φ_i as the defect, and
/// ∫γ∇φ_i·∇φ_j.
struct CellSums {
  TransportMatrices matrices;
  MatrixValues stiffness;
};
CellSums cell_sums(const TetMesh& mesh, const ScalarSpace& space, const NodePositions& positions,
                   const Field<NodeId, Vec3>& velocity, const Coefficients& coefficients,
                   double duration) {
  const std::size_t entries = space.graph.num_entries(), nodes = at(space.num_nodes());
  CellSums sums{{.rates = MatrixValues(entries, 0.0),
                 .inflow = {},
                 .streamline = MatrixValues(entries, 0.0),
                 .sources = std::vector<double>(nodes, 0.0),
                 .defect = std::vector<double>(nodes, 0.0)},
                MatrixValues(entries, 0.0)};
  with_kernel(space, positions, [&](auto& cell) {
    for (const CellId c : mesh.cells.ids()) {
      cell.go_to(c);
      const double capacity = coefficients.capacity[region_of(mesh, c)],
                   conductivity = coefficients.conductivity[region_of(mesh, c)],
                   source = coefficients.source[region_of(mesh, c)];
      const auto u = cell.at_points(velocity);
      double squared = 0.0;
      for (std::size_t q = 0; q < u.size(); ++q) squared += cell.weights()[q] * u[q].squaredNorm();
      const auto along = cell.along(u);
      const auto upstream = cell.integral(along);
      const double tau = upstream_time(std::sqrt(squared / cell.volume()), cell.size(),
                                       conductivity / capacity, duration);
      const auto stiffness = cell.stiffness();
      const auto convected = cell.product(along, cell.values());
      auto rates = convected;
      for (std::size_t e = 0; e < rates.size(); ++e)
        rates[e] = capacity * convected[e] - conductivity * stiffness[e];
      if (tau > 0.0) {
        const auto laplacians = cell.laplacians();
        add(rates, -tau * capacity, cell.product(along, along));
        for (std::size_t a = 0; a < upstream.size(); ++a)
          for (std::size_t b = 0; b < upstream.size(); ++b)
            rates[a * upstream.size() + b] += tau * conductivity * upstream[a] * laplacians[b];
        add_to(space, c, Addition{rates, 1.0, sums.matrices.rates},
               Addition{stiffness, capacity, sums.stiffness},
               Addition{convected, tau * capacity, sums.matrices.streamline});
      } else {
        add_to(space, c, Addition{rates, 1.0, sums.matrices.rates},
               Addition{stiffness, capacity, sums.stiffness});
      }
      for (std::size_t a = 0; a < upstream.size(); ++a)
        sums.matrices.defect[at(cell.nodes()[a])] += capacity * upstream[a];
      if (source == 0.0) continue;
      auto given = cell.shares();
      add(given, tau, upstream);
      for (std::size_t a = 0; a < given.size(); ++a)
        sums.matrices.sources[at(cell.nodes()[a])] += source * given[a];
    }
  });
  return sums;
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
  std::vector<double> volumes = element_volumes(mesh, space, positions),
                      density = volume_shares(scene, volumes);
  for (std::size_t r = 0; r < density.size(); ++r) {
    volumes[r] *= density[r];
    density[r] *= capacity[r];
  }
  MassMatrix mass{MatrixValues(space.graph.num_entries(), 0.0),
                  std::vector<double>(at(space.num_nodes()), 0.0),
                  {},
                  std::move(volumes)};
  with_kernel(space, positions, [&](auto& cell) {
    for (const CellId c : mesh.cells.ids()) {
      cell.go_to(c, false);
      const std::size_t region = region_of(mesh, c);
      const auto element = cell.mass();
      add_to(space, c, Addition{element, density[region], mass.values});
      const auto shares = cell.shares();
      for (std::size_t i = 0; i < shares.size(); ++i) {
        const std::int32_t node = cell.nodes()[i];
        const double part = density[region] * shares[i];
        mass.rows[at(node)] += part;
        if (region > 0) mass.of_drops.push_back({static_cast<std::int32_t>(region), node, part});
      }
    }
  });
  return mass;
}

std::vector<double> region_amounts(const MassMatrix& mass, std::span<const double> values) {
  std::vector<double> amounts(mass.volumes.size(), 0.0);
  for (const MassMatrix::Part& part : mass.of_drops)
    amounts[at(part.region)] += part.value * values[at(part.node)];
  const double drops = sum(amounts);
  amounts[0] = std::inner_product(mass.rows.begin(), mass.rows.end(), values.begin(), -drops);
  return amounts;
}

MatrixValues stiffness_matrix(const TetMesh& mesh, const ScalarSpace& space,
                              const NodePositions& positions,
                              std::span<const double> conductivity) {
  MatrixValues values(space.graph.num_entries(), 0.0);
  with_kernel(space, positions, [&](auto& cell) {
    for (const CellId c : mesh.cells.ids()) {
      cell.go_to(c);
      const auto stiffness = cell.stiffness();
      add_to(space, c, Addition{stiffness, conductivity[region_of(mesh, c)], values});
    }
  });
  return values;
}

TransportMatrices transport_matrices(const TetMesh& mesh, const ScalarSpace& space,
                                     const NodePositions& positions, const RelativeFlow& flow,
                                     const Coefficients& coefficients, double duration) {
  auto [matrices, stiffness] = cell_sums(mesh, space, positions, flow.u, coefficients, duration);
  matrices.inflow = add_inflow(space, positions, flow.v, coefficients.capacity[0], matrices.rates);
  std::vector<double>& defect = matrices.defect;
  for (std::size_t i = 0; i < defect.size(); ++i) {
    defect[i] -= flow.growth[i];
    if (!matrices.inflow.empty()) defect[i] += matrices.inflow[i];
  }
  // The sum is that of what boundaries and volumes lose to round-off.
  const double rest = sum(defect) / static_cast<double>(defect.size());
  for (double& each : defect) each -= rest;
  const std::vector<double> potential = solve_potential(space, stiffness, defect);
  add_potential_flow(space, stiffness, potential, matrices.rates, defect);
  return std::move(matrices);
}

}  // namespace meniscus::bulk
