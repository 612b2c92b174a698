#pragma once

#include <array>
#include <span>
#include <vector>

#include "meniscus/flow/fem/constraints.hpp"
#include "meniscus/flow/fem/node_graph.hpp"
#include "meniscus/flow/fem/partition.hpp"
#include "meniscus/linear/saddle_system.hpp"

namespace meniscus::fem {

/// A scalar Laplacian ∫μ∇φ·∇φ with the nodes eliminated where a velocity component is fixed.
struct ScalarLaplacian {
  std::vector<bool> is_fixed;  ///< by node
  std::vector<double> values;  ///< on the velocity's graph, or that of the vertices
  /// P2: the interpolation to it from linear functions that vanish at fixed nodes.
  linear::CsrMatrix from_linear;
};

/// The Laplacians that stand for the diagonal blocks of A: components with the same fixed nodes
/// have one in common.
class ScalarLaplacians {
 public:
  ScalarLaplacians(const FlowSpace& space, const Partition* partition);

  /// Makes those that the constraints ask for, with room for so many values. Collective.
  void choose(const Constraints& constraints, std::size_t num_values);
  [[nodiscard]] std::span<ScalarLaplacian> all() { return laplacians_; }
  /// Views of them; `graph` is what their values are on, the velocity's or the vertices', of which
  /// so many rows are owned.
  void put_into(linear::SaddleSystem& system, const NodeGraph& graph, std::int32_t num_rows) const;

 private:
  [[nodiscard]] bool is_same(const std::vector<bool>& a, const std::vector<bool>& b) const;

  const Partition* partition_;
  std::int32_t num_nodes_, num_owned_nodes_;
  LinearFunctions coarse_;
  std::vector<ScalarLaplacian> laplacians_;
  std::array<int, 3> laplacian_of_ = {0, 0, 0};
};

}  // namespace meniscus::fem
