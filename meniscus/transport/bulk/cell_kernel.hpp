#pragma once

#include <array>
#include <span>

#include "meniscus/flow/fem/curved_maps.hpp"
#include "meniscus/flow/fem/elements.hpp"
#include "meniscus/transport/bulk/scalar_space.hpp"

namespace meniscus::bulk {

/// The points of one cell. Where it is straight the rule is exact for a product of two functions of
/// the element and a velocity's derivative along one. Tables have a row for each point and a column
/// for each node, and zeros up to a width that vector instructions like. Matrices of the element
/// are row by row.
template <int Nodes>
class CellKernel {
 public:
  static constexpr std::size_t kNodes = Nodes;
  static constexpr std::size_t kPoints = Nodes == 4 ? 4 : 14;
  static constexpr std::size_t kWidth = Nodes == 4 ? 4 : 16;  ///< of a table's row
  using ByPoint = std::array<double, kPoints>;
  using ByNode = std::array<double, kNodes>;
  using Square = std::array<double, kNodes * kNodes>;
  struct alignas(64) Table : std::array<double, kPoints * kWidth> {};
  using Vectors = std::array<Vec3, kPoints>;

  CellKernel(const ScalarSpace& space, const NodePositions& positions)
      : space_(space), positions_(positions), maps_(space.elements, positions) {}

  /// Evaluates the maps of a cell. Without gradients there are masses and shares alone.
  void go_to(CellId c, bool has_gradients = true);

  [[nodiscard]] std::span<const std::int32_t> nodes() const { return nodes_; }
  [[nodiscard]] double volume() const { return volume_; }
  /// Edge of the regular tetrahedron of this volume, halved for quadratic elements.
  [[nodiscard]] double size() const;
  [[nodiscard]] static const Table& values();  ///< φ_i
  [[nodiscard]] const ByPoint& weights() const { return weight_; }

  /// ∫φ_i φ_j.
  [[nodiscard]] Square mass() const;
  /// ∫∇φ_i·∇φ_j.
  [[nodiscard]] Square stiffness() const;
  /// ∇²φ_i, where the cell is straight; zero where it is curved or linear.
  [[nodiscard]] ByNode laplacians() const;
  /// u·∇φ_i at the points, u given there.
  [[nodiscard]] Table along(const Vectors& u) const;
  /// ∫f_i g_j of two tables.
  [[nodiscard]] Square product(const Table& f, const Table& g) const;
  /// ∫f_i.
  [[nodiscard]] ByNode integral(const Table& f) const;
  /// ∫φ_i.
  [[nodiscard]] ByNode shares() const;

  /// A nodal field at the points, and its gradients.
  [[nodiscard]] Vectors at_points(const Field<NodeId, Vec3>& field) const;
  [[nodiscard]] ByPoint at_points(std::span<const double> field) const;
  [[nodiscard]] Vectors gradients_of(std::span<const double> field) const;
  /// ∂v_a/∂x_b at (a, b).
  [[nodiscard]] std::array<Mat3, kPoints> gradients_of(const Field<NodeId, Vec3>& field) const;

 private:
  [[nodiscard]] Vectors slopes_of(const ByNode& value) const;
  [[nodiscard]] std::size_t node(std::size_t i) const {
    return static_cast<std::size_t>(nodes_[i]);
  }

  const ScalarSpace& space_;
  const NodePositions& positions_;
  fem::MapsOfCurvedCells maps_;
  std::span<const std::int32_t> nodes_;
  bool is_curved_ = false;
  double volume_ = 0.0;
  std::array<Vec3, 4> corner_gradient_{};  // of the straight cell
  alignas(64) ByPoint weight_{};
  std::array<Table, 3> gradient_{};  // where the cell is curved or linear
};

extern template class CellKernel<4>;
extern template class CellKernel<10>;

/// A nodal field and its gradient at a point of a cell.
struct PointValue {
  double value = 0.0;
  Vec3 gradient = Vec3::Zero();
  Vec3 x = Vec3::Zero();
  Mat3 inverse =
      Mat3::Zero();  ///< ∂b_a/∂x_k of the barycentric coordinates but the first, at (a, k)
};
[[nodiscard]] PointValue value_at(const ScalarSpace& space, const NodePositions& positions,
                                  CellId c, const std::array<double, 4>& barycentric,
                                  std::span<const double> values);

/// Calls `action` with the kernel that a space is made of.
template <class Action>
void with_kernel(const ScalarSpace& space, const NodePositions& positions, Action action) {
  if (space.elements.elements == fem::Elements::p2_p1) {
    CellKernel<10> kernel(space, positions);
    return action(kernel);
  }
  CellKernel<4> kernel(space, positions);
  return action(kernel);
}

/// A multiple of an element matrix, and the values of a matrix on the space's graph that get it.
template <std::size_t Size>
struct Addition {
  const std::array<double, Size>& element;
  double factor;
  std::vector<double>& values;
};

/// Adds element matrices of one cell.
template <std::size_t Size, class... Others>
void add_to(const ScalarSpace& space, CellId c, const Addition<Size>& first,
            const Others&... others) {
  const auto nodes = space.elements.velocity.of(c);
  const std::size_t count = nodes.size();
  std::size_t position = static_cast<std::size_t>(c.value) * Size, pair = 0;
  for (std::size_t a = 0; a < count; ++a) {
    const auto row =
        static_cast<std::size_t>(space.graph.row_start[static_cast<std::size_t>(nodes[a])]);
    for (std::size_t b = 0; b < count; ++b, ++pair, ++position) {
      const std::size_t entry = row + space.graph.position[position];
      first.values[entry] += first.factor * first.element[pair];
      ((others.values[entry] += others.factor * others.element[pair]), ...);
    }
  }
}

}  // namespace meniscus::bulk
