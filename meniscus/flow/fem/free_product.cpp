#include "meniscus/flow/fem/free_product.hpp"

#include <algorithm>

#include "meniscus/flow/fem/partition.hpp"

namespace meniscus::fem {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

Eigen::Map<Vec3> vector_at(std::span<double> values, NodeId i) {
  return Eigen::Map<Vec3>(values.data() + 3 * at(i.value));
}

/// The components that a constraint leaves free.
Vec3 free_part(const Vec3& local, const NodeConstraint& constraint) {
  Vec3 result = local;
  for (std::size_t k = 0; k < 3; ++k)
    if (constraint.is_fixed[k]) result[static_cast<Eigen::Index>(k)] = 0.0;
  return result;
}

std::vector<double> local_velocities(const StokesProblem& problem, std::span<const double> owned) {
  if (problem.partition != nullptr) return velocities_with_ghosts(owned, *problem.partition);
  std::vector<double> all;
  all.reserve(owned.size() + 1);  // for the number that the Laplacian wants after all
  all.assign(owned.begin(), owned.end());
  return all;
}

std::vector<double> local_pressures(const StokesProblem& problem, std::span<const double> owned) {
  if (problem.partition != nullptr) return pressures_with_ghosts(owned, *problem.partition);
  return {owned.begin(), owned.end()};
}

/// Calls `action` with the fixed unknowns of the first so many nodes.
template <class Action>
void for_each_fixed(const Constraints& constraints, std::int32_t num_nodes, Action action) {
  for (const NodeConstraint& constraint : constraints.all())
    for (std::size_t k = 0; k < 3 && constraint.node.value < num_nodes; ++k)
      if (constraint.is_fixed[k]) action(3 * at(constraint.node.value) + k);
}

}  // namespace

void FreeProduct::multiply(std::span<const double> x, std::span<double> y) const {
  const OwnedCounts owned = owned_counts(problem_);
  const std::size_t num_velocities = 3 * at(owned.num_nodes);
  std::vector<double> v = local_velocities(problem_, x.first(num_velocities));
  const std::vector<double> p = local_pressures(problem_, x.subspan(num_velocities));
  for (const NodeConstraint& constraint : problem_.constraints.all()) {
    Eigen::Map<Vec3> at_node = vector_at(v, constraint.node);
    at_node = (constraint.frame * free_part(at_node, constraint)).eval();
  }
  std::vector<double> momentum(v.size()), continuity(p.size());
  product_.add(v, p, momentum, continuity);
  constrain(momentum);
  for_each_fixed(problem_.constraints, owned.num_nodes, [&](std::size_t i) { momentum[i] = x[i]; });
  std::copy_n(momentum.begin(), num_velocities, y.begin());
  std::copy_n(continuity.begin(), y.size() - num_velocities,
              y.begin() + static_cast<std::ptrdiff_t>(num_velocities));
}

void FreeProduct::multiply_gradient(std::span<const double> p, std::span<double> v) const {
  std::vector<double> momentum(3 * at(problem_.space.velocity.num_nodes));
  product_.add_straight_gradient(local_pressures(problem_, p), momentum);
  constrain(momentum);
  std::copy_n(momentum.begin(), v.size(), v.begin());
}

void FreeProduct::multiply_laplacians(const LaplacianMatrix& laplacian, std::span<const double> x,
                                      std::span<double> r) const {
  std::vector<double> v = local_velocities(problem_, x);
  for_each_fixed(problem_.constraints, problem_.space.velocity.num_nodes,
                 [&](std::size_t i) { v[i] = 0.0; });
  v.push_back(0.0);  // as the matrix wants it
  laplacian.multiply(v, r);
  for_each_fixed(problem_.constraints, owned_counts(problem_).num_nodes,
                 [&](std::size_t i) { r[i] = x[i]; });
}

std::vector<double> FreeProduct::diagonals_of(const LaplacianMatrix& laplacian) const {
  std::vector<double> diagonals;
  for (const double each : laplacian.diagonal()) diagonals.insert(diagonals.end(), 3, each);
  for_each_fixed(problem_.constraints, owned_counts(problem_).num_nodes,
                 [&](std::size_t i) { diagonals[i] = 1.0; });
  return diagonals;
}

void FreeProduct::constrain(std::span<double> momentum) const {
  for (const NodeConstraint& constraint : problem_.constraints.all()) {
    Eigen::Map<Vec3> at_node = vector_at(momentum, constraint.node);
    at_node = free_part(constraint.frame.transpose() * at_node, constraint);
  }
}

}  // namespace meniscus::fem
