#include "meniscus/flow/fem/scalar_laplacians.hpp"

#include <algorithm>

#include "meniscus/core/error.hpp"
#include "meniscus/linear/collective.hpp"

namespace meniscus::fem {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Linear functions as quadratic ones: a vertex keeps its value, the middle of an edge has the mean
/// of its ends. Fixed nodes are zero, but that fixed vertices keep their own equation.
linear::CsrMatrix interpolation_from_linear(const LinearFunctions& coarse, std::int32_t num_rows,
                                            const std::vector<bool>& is_fixed) {
  linear::CsrMatrix matrix;
  matrix.num_columns = coarse.num_owned;
  matrix.row_start.push_back(0);
  for (std::size_t i = 0; i < at(num_rows); ++i) {
    const auto& [a, b] = coarse.ends[i];
    MENISCUS_ASSERT(coarse.number[at(a)] >= 0 && coarse.number[at(b)] >= 0, "node {}", i);
    if (a == b) {
      matrix.columns.push_back(coarse.number[at(a)]);
      matrix.values.push_back(1.0);
    }
    for (const std::int32_t end : coarse.ends[i]) {  // in rising order
      if (a == b || is_fixed[i] || is_fixed[at(end)]) continue;
      matrix.columns.push_back(coarse.number[at(end)]);
      matrix.values.push_back(0.5);
    }
    matrix.row_start.push_back(static_cast<std::int32_t>(matrix.columns.size()));
  }
  return matrix;
}

}  // namespace

ScalarLaplacians::ScalarLaplacians(const FlowSpace& space, const Partition* partition)
    : partition_(partition),
      num_nodes_(space.velocity.num_nodes),
      num_owned_nodes_(partition != nullptr ? partition->owned.num_nodes
                                            : space.velocity.num_nodes),
      coarse_(partition != nullptr ? partition->coarse : linear_functions(space)) {}

/// Whether two sets of fixed nodes are equal on every rank.
bool ScalarLaplacians::is_same(const std::vector<bool>& a, const std::vector<bool>& b) const {
  return partition_ == nullptr ? a == b : !linear::any(partition_->communicator, a != b);
}

void ScalarLaplacians::choose(const Constraints& constraints, std::size_t num_values) {
  laplacians_.clear();
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<bool> is_fixed(at(num_nodes_), false);
    for (const NodeConstraint& constraint : constraints.all())
      is_fixed[at(constraint.node.value)] = constraint.is_fixed[k];
    const auto same = std::ranges::find_if(laplacians_, [&](const ScalarLaplacian& other) {
      return is_same(other.is_fixed, is_fixed);
    });
    laplacian_of_[k] = static_cast<int>(same - laplacians_.begin());
    if (same != laplacians_.end()) continue;
    linear::CsrMatrix from_linear;
    if (!coarse_.ends.empty())
      from_linear = interpolation_from_linear(coarse_, num_owned_nodes_, is_fixed);
    laplacians_.push_back(
        {std::move(is_fixed), std::vector<double>(num_values), std::move(from_linear)});
  }
}

void ScalarLaplacians::put_into(linear::SaddleSystem& system, const NodeGraph& graph,
                                std::int32_t num_rows) const {
  for (const ScalarLaplacian& laplacian : laplacians_) {
    MENISCUS_ASSERT(laplacian.values.size() == graph.num_entries(), "{} {}",
                    laplacian.values.size(), graph.num_entries());
    system.laplacians.push_back(
        {num_rows, num_rows, graph.row_start, graph.columns, laplacian.values});
    if (!coarse_.ends.empty()) system.interpolations.push_back(laplacian.from_linear.view());
  }
  system.laplacian_of = laplacian_of_;
}

}  // namespace meniscus::fem
