#include "meniscus/flow/fem/product_jacobian.hpp"

#include <algorithm>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/elements.hpp"
#include "meniscus/flow/fem/inertia_product.hpp"
#include "meniscus/flow/fem/linear_integrals.hpp"

namespace meniscus::fem {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// The nodes that are vertices, counted in their order; −1 for the others.
std::vector<std::int32_t> count_vertices(const LinearFunctions& coarse) {
  std::vector<std::int32_t> vertex_of;
  vertex_of.reserve(std::size(coarse.number));
  std::int32_t count = 0;
  for (const std::int32_t number : coarse.number) vertex_of.push_back(number < 0 ? -1 : count++);
  return vertex_of;
}

NodeTable vertices_of_cells(const NodeTable& nodes, const std::vector<std::int32_t>& vertex_of) {
  NodeTable vertices{1 + std::ranges::max(vertex_of), 4, {}};
  for (const CellId c : ids<CellId>(nodes.num_cells()))
    for (const std::int32_t node : nodes.of(c).first(4))
      vertices.cell_nodes.push_back(vertex_of[at(node)]);
  return vertices;
}

}  // namespace

ProductJacobian::ProductJacobian(const FlowSpace& space, const Partition* partition)
    : space_(space),
      owned_(partition != nullptr ? partition->owned : all_owned(space)),
      coarse_(partition != nullptr ? partition->coarse : linear_functions(space)),
      vertex_of_(count_vertices(coarse_)),
      vertices_(vertices_of_cells(space.velocity, vertex_of_)),
      vertex_graph_(node_graph(vertices_, vertices_)),
      pressure_graph_(node_graph(space.pressure.nodes, space.pressure.nodes)),
      laplacians_(space, partition),
      region_weights_(space.pressure, partition),
      partition_(partition),
      laplacian_(space, owned_.num_nodes) {
  MENISCUS_ASSERT(space.elements == Elements::p2_p1, "linear elements have matrices");
  std::vector<std::int32_t> number;  // of a vertex
  for (const std::int32_t each : coarse_.number)
    if (each >= 0) number.push_back(each);
  for (std::int32_t& column : vertex_graph_.columns) column = number[at(column)];
  if (partition == nullptr) return;
  for (std::int32_t& column : pressure_graph_.columns)
    column = partition->pressure_number[at(column)];
}

void ProductJacobian::assemble(const StokesProblem& problem, const StokesProduct& product,
                               linear::Preconditioner preconditioner) {
  product_.emplace(problem, product);
  constant_pressure_is_null_ = !problem.has_open_boundary;
  if (preconditioner == linear::Preconditioner::fresh || diagonals_.empty())
    assemble_preconditioner(problem, product);
  region_weights_.update(std::span(pressure_mass_).first(at(owned_.num_pressures)));
}

void ProductJacobian::assemble_preconditioner(const StokesProblem& problem,
                                              const StokesProduct& product) {
  pressure_mass_.assign(at(pressure_graph_.num_rows()), 0.0);
  consistent_mass_.assign(pressure_graph_.num_entries(), 0.0);
  laplacians_.choose(problem.constraints, vertex_graph_.num_entries());
  with_linear_integrals(product.cells(),
                        [&](CellId c, const LinearIntegrals& integrals, std::size_t lane) {
                          add_pressure_mass(problem, c, integrals, lane);
                          add_laplacians(problem, c, integrals, lane);
                        });
  laplacian_.assemble(problem, product);
  diagonals_ = product_->diagonals_of(laplacian_);
  divergence_ = {};
  if (!problem.inertia) return;
  add_tension(*problem.inertia);
  assemble_divergence(problem, *product.inertia());
}

void ProductJacobian::add_pressure_mass(const StokesProblem& problem, CellId c,
                                        const LinearIntegrals& integrals, std::size_t lane) {
  const auto pressures = space_.pressure.nodes.of(c);
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t l = 0; l < 4; ++l) {
      const double mass = integrals.values[k][l][lane] / problem.viscosity[c];
      pressure_mass_[at(pressures[k])] += mass;
      consistent_mass_[pressure_graph_.entry(pressures[k], 16 * at(c.value) + 4 * k + l)] += mass;
    }
}

void ProductJacobian::add_laplacians(const StokesProblem& problem, CellId c,
                                     const LinearIntegrals& integrals, std::size_t lane) {
  const auto nodes = space_.velocity.of(c), vertices = vertices_.of(c);
  const double density_rate =
      problem.inertia ? problem.inertia->density[c] / problem.inertia->duration : 0.0;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t l = 0; l < 4; ++l) {
      const std::size_t entry = vertex_graph_.entry(vertices[k], 16 * at(c.value) + 4 * k + l);
      for (ScalarLaplacian& laplacian : laplacians_.all())
        if (k == l || (!laplacian.is_fixed[at(nodes[k])] && !laplacian.is_fixed[at(nodes[l])]))
          laplacian.values[entry] += problem.viscosity[c] * integrals.gradients[k][l][lane] +
                                     density_rate * integrals.values[k][l][lane];
    }
}

/// Adds to the Laplacians what the tension of the stage does to linear functions.
void ProductJacobian::add_tension(const InertiaTerms& terms) {
  Eigen::Matrix<double, 6, 3> from_linear = Eigen::Matrix<double, 6, 3>::Zero();
  for (int k = 0; k < 3; ++k)
    from_linear(k, k) = 1.0, from_linear(3 + k, k) = from_linear(3 + k, (k + 1) % 3) = 0.5;
  const auto add = [&](const FaceNodes& nodes, const Eigen::Matrix<double, 6, 6>& stiffness) {
    const Mat3 values = from_linear.transpose() * stiffness * from_linear;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t row = vertex_of_[at(nodes[k].value)];
      for (std::size_t l = 0; l < 3; ++l) {
        const std::int32_t number = coarse_.number[at(nodes[l].value)];
        const auto first = vertex_graph_.columns.begin() + vertex_graph_.row_start[at(row)],
                   last = vertex_graph_.columns.begin() + vertex_graph_.row_start[at(row) + 1];
        const auto entry = std::find(first, last, number) - vertex_graph_.columns.begin();
        for (ScalarLaplacian& laplacian : laplacians_.all())
          if (k == l ||
              (!laplacian.is_fixed[at(nodes[k].value)] && !laplacian.is_fixed[at(nodes[l].value)]))
            laplacian.values[static_cast<std::size_t>(entry)] +=
                values(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(l));
      }
    }
  };
  for (const FaceStiffness& face : terms.tension) add(face.nodes, face.values);
  for (const FaceElasticity& face : terms.elasticity) add(face.nodes, face.mean_of_components());
}

void ProductJacobian::assemble_divergence(const StokesProblem& problem,
                                          const InertiaProduct& inertia) {
  if (divergence_graph_.row_start.empty())
    divergence_graph_ = node_graph(space_.pressure.nodes, space_.velocity);
  const NodeGraph& graph = divergence_graph_;
  std::vector<Vec3> entries(graph.num_entries(), Vec3::Zero());
  QuadraticElement element(space_, problem.positions);
  for (const CellId c : problem.mesh.cells.ids()) {
    const auto pressures = space_.pressure.nodes.of(c);
    for (const auto& point : element.points(c))
      for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t i = 0; i < 10; ++i)
          entries[graph.entry(pressures[k], 40 * at(c.value) + 10 * k + i)] -=
              point.weight * point.pressure[k] * point.gradient.col(static_cast<Eigen::Index>(i));
  }
  divergence_.num_columns = 3 * owned_.num_nodes;
  divergence_.row_start.push_back(0);
  divergence_.values.reserve(3 * entries.size());
  divergence_.columns.reserve(3 * entries.size());
  for (std::int32_t row = 0; row < owned_.num_pressures; ++row) {
    for (auto n = at(graph.row_start[at(row)]); n < at(graph.row_start[at(row) + 1]); ++n) {
      const NodeId node{graph.columns[n]};
      Vec3 entry = entries[n];
      if (const NodeConstraint* constraint = problem.constraints.find(node)) {
        entry = (constraint->frame.transpose() * entry).eval();
        for (std::size_t k = 0; k < 3; ++k)
          if (constraint->is_fixed[k]) entry[static_cast<Eigen::Index>(k)] = 0.0;
      }
      const std::int32_t number =
          partition_ != nullptr ? partition_->node_number[at(node.value)] : node.value;
      for (int k = 0; k < 3; ++k) {
        divergence_.columns.push_back(3 * number + k);
        divergence_.values.push_back(entry[k]);
      }
    }
    divergence_.row_start.push_back(static_cast<std::int32_t>(divergence_.columns.size()));
  }
  std::vector<double> by_node(at(problem.space.velocity.num_nodes));
  inertia.add_mass_diagonal(by_node);
  mass_diagonal_.clear();
  for (std::size_t i = 0; i < at(owned_.num_nodes); ++i)
    mass_diagonal_.insert(mass_diagonal_.end(), 3, by_node[i]);
}

linear::SaddleSystem ProductJacobian::system() const {
  MENISCUS_ASSERT(product_.has_value(), "nothing was assembled");
  const std::int32_t num_velocities = 3 * owned_.num_nodes, num_pressures = owned_.num_pressures;
  linear::SaddleSystem system;
  system.A = {num_velocities, num_velocities, {}, {}, {}};
  system.B = {num_pressures, num_velocities, {}, {}, {}};
  system.C = {num_pressures, num_pressures, {}, {}, {}};
  using Values = std::span<const double>;
  const FreeProduct& product = *product_;
  system.products = {[&product](Values x, std::span<double> y) { product.multiply(x, y); },
                     [&product](Values p, std::span<double> v) { product.multiply_gradient(p, v); },
                     [&product, this](Values v, std::span<double> r) {
                       product.multiply_laplacians(laplacian_, v, r);
                     }};
  system.laplacian_diagonals = diagonals_;
  laplacians_.put_into(system, vertex_graph_, coarse_.num_owned);
  system.consistent_mass = {num_pressures, num_pressures, pressure_graph_.row_start,
                            pressure_graph_.columns, consistent_mass_};
  system.pressure_mass = std::span(pressure_mass_).first(at(num_pressures));
  region_weights_.put_into(system);
  if (!divergence_.row_start.empty()) {
    system.divergence = divergence_.view();
    system.mass_diagonal = mass_diagonal_;
  }
  system.constant_pressure_is_null = constant_pressure_is_null_;
  return system;
}

}  // namespace meniscus::fem
