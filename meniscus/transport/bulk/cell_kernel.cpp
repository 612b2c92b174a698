#include "meniscus/transport/bulk/cell_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "meniscus/core/vector_clones.hpp"

namespace meniscus::bulk {
namespace {

/// ∂φ_i/∂b_a at barycentric coordinates b, by columns a.
template <int Nodes>
Eigen::Matrix<double, Nodes, 4> barycentric_derivatives(const std::array<double, 4>& b) {
  Eigen::Matrix<double, Nodes, 4> result = Eigen::Matrix<double, Nodes, 4>::Zero();
  for (int i = 0; i < 4; ++i)
    result(i, i) = Nodes == 4 ? 1.0 : 4.0 * b[static_cast<std::size_t>(i)] - 1.0;
  if constexpr (Nodes == 10)
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [p, q] = fem::kCellEdges[e];
      const auto row = static_cast<Eigen::Index>(4 + e);
      result(row, static_cast<Eigen::Index>(p)) = 4.0 * b[q];
      result(row, static_cast<Eigen::Index>(q)) = 4.0 * b[p];
    }
  return result;
}

// The hot loops of a step, on tables of quadratic elements: 14 points, 10 nodes in rows of 16.
constexpr std::size_t kRows = 14, kColumns = 10, kWide = 16;
using Wide [[gnu::vector_size(8 * kWide)]] = double;

[[gnu::always_inline]] inline void load(const double* from, Wide& to) {
  std::memcpy(&to, from, sizeof to);
}

/// C = Aᵀ W B.
MENISCUS_VECTOR_CLONES void weighted_product(const double* A, const double* W, const double* B,
                                             double* C) {
  for (std::size_t i = 0; i < kColumns; ++i) {
    Wide sum{}, row;
    for (std::size_t q = 0; q < kRows; ++q) {
      load(B + q * kWide, row);
      sum += (W[q] * A[q * kWide + i]) * row;
    }
    for (std::size_t j = 0; j < kColumns; ++j) C[i * kColumns + j] = sum[j];
  }
}

/// Σ_k u_k(q) table_k at the points, `Count` tables one after the other.
template <std::size_t Count>
[[gnu::always_inline]] inline void combine(const double* tables, const double* u, double* result) {
  constexpr std::size_t size = kRows * kWide;
  for (std::size_t q = 0; q < kRows; ++q)
    for (std::size_t j = q * kWide; j < (q + 1) * kWide; ++j) {
      double sum = 0.0;
      for (std::size_t k = 0; k < Count; ++k) sum += u[Count * q + k] * tables[k * size + j];
      result[j] = sum;
    }
}
MENISCUS_VECTOR_CLONES void combine_three(const double* tables, const double* u,
                                          double* __restrict result) {
  combine<3>(tables, u, result);
}
MENISCUS_VECTOR_CLONES void combine_four(const double* tables, const double* u,
                                         double* __restrict result) {
  combine<4>(tables, u, result);
}

/// Σ_i values_i(q) field_i, `values` by node, the points side by side in rows of 16. It is for
/// `count` fields of which `field` holds the values node by node.
MENISCUS_VECTOR_CLONES void evaluate(const double* values, const double* field, std::size_t count,
                                     double* result) {
  for (std::size_t k = 0; k < count; ++k) {
    Wide sum{}, row;
    for (std::size_t i = 0; i < kColumns; ++i) {
      load(values + i * kWide, row);
      sum += field[count * i + k] * row;
    }
    for (std::size_t q = 0; q < kRows; ++q) result[count * q + k] = sum[q];
  }
}

template <int Nodes>
struct Reference {
  using Kernel = CellKernel<Nodes>;
  static constexpr std::size_t n = Kernel::kNodes, width = Kernel::kWidth;
  typename Kernel::Table value{};
  std::array<typename Kernel::Table, 4> derivative{};  ///< by barycentric coordinate
  /// By the coordinates but the first, which is 1 less their sum.
  std::array<typename Kernel::Table, 3> relative_derivative{};
  /// Values and derivatives by node, the points side by side (`evaluate`).
  alignas(64) std::array<double, n * kWide> value_by_node{};
  alignas(64) std::array<std::array<double, n * kWide>, 4> derivative_by_node{};
  typename Kernel::ByPoint share{};
  typename Kernel::Square mass{};    ///< of volume 1
  typename Kernel::ByNode shares{};  ///< of it

  Reference() {
    if constexpr (Nodes == 4)
      fill(kTetrahedronRule2);
    else
      fill(kTetrahedronRule5);
    for (std::size_t q = 0; q < share.size(); ++q)
      for (std::size_t i = 0; i < n; ++i) {
        shares[i] += share[q] * value[q * width + i];
        for (std::size_t j = 0; j < n; ++j)
          mass[i * n + j] += share[q] * value[q * width + i] * value[q * width + j];
      }
  }
  template <class Rule>
  void fill(const Rule& rule) {
    for (std::size_t q = 0; q < rule.size(); ++q) {
      const std::array<double, 4>& b = rule[q].barycentric;
      share[q] = rule[q].share;
      if constexpr (Nodes == 4)
        std::ranges::copy(b, value.begin() + static_cast<std::ptrdiff_t>(q * width));
      else
        std::ranges::copy(fem::quadratic_tetrahedron_values(b),
                          value.begin() + static_cast<std::ptrdiff_t>(q * width));
      const auto by = barycentric_derivatives<Nodes>(b);
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t i = 0; i < n; ++i)
          derivative_by_node[a][i * kWide + q] = derivative[a][q * width + i] =
              by(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(a));
      for (std::size_t i = 0; i < n; ++i) value_by_node[i * kWide + q] = value[q * width + i];
    }
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t e = 0; e < value.size(); ++e)
        relative_derivative[a][e] = derivative[a + 1][e] - derivative[0][e];
  }
};

template <int Nodes>
const Reference<Nodes>& reference() {
  static const Reference<Nodes> table;
  return table;
}

}  // namespace

template <int Nodes>
const typename CellKernel<Nodes>::Table& CellKernel<Nodes>::values() {
  return reference<Nodes>().value;
}

template <int Nodes>
void CellKernel<Nodes>::go_to(CellId c, bool has_gradients) {
  nodes_ = space_.elements.velocity.of(c);
  is_curved_ = Nodes == 10 && positions_.is_curved[c] != 0;
  const auto x = [&](std::size_t i) -> const Vec3& { return positions_.x[NodeId{nodes_[i]}]; };
  const Reference<Nodes>& at = reference<Nodes>();
  const LinearTetrahedron tet = linear_tetrahedron({x(0), x(1), x(2), x(3)});
  corner_gradient_ = tet.gradient;
  if constexpr (Nodes == 10)
    if (is_curved_) {
      const fem::CurvedMaps& maps = maps_.of(c);
      std::array<std::array<double, 3 * kPoints>, 3> slope;  // ∂b_a/∂x_k
      volume_ = 0.0;
      for (std::size_t q = 0; q < kPoints; ++q) {
        volume_ += weight_[q] = maps[q].weight;
        for (std::size_t k = 0; k < 3; ++k)
          for (std::size_t a = 0; a < 3; ++a)
            slope[k][3 * q + a] = maps[q].gradient[a][static_cast<Eigen::Index>(k)];
      }
      for (std::size_t k = 0; has_gradients && k < 3; ++k)
        combine_three(at.relative_derivative[0].data(), slope[k].data(), gradient_[k].data());
      return;
    }
  volume_ = tet.volume;
  if (!has_gradients) return;
  for (std::size_t q = 0; q < kPoints; ++q) weight_[q] = tet.volume * at.share[q];
  if constexpr (Nodes == 4)
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t q = 0; q < kPoints; ++q)
        for (std::size_t i = 0; i < kNodes; ++i)
          gradient_[k][q * kWidth + i] = tet.gradient[i][static_cast<Eigen::Index>(k)];
}

template <int Nodes>
double CellKernel<Nodes>::size() const {
  const double edge = std::cbrt(6.0 * std::numbers::sqrt2 * volume_);
  return Nodes == 4 ? edge : 0.5 * edge;
}

template <int Nodes>
typename CellKernel<Nodes>::Square CellKernel<Nodes>::product(const Table& f,
                                                              const Table& g) const {
  Square result{};
  if constexpr (Nodes == 10) {
    weighted_product(f.data(), weight_.data(), g.data(), result.data());
  } else {
    for (std::size_t q = 0; q < kPoints; ++q)
      for (std::size_t i = 0; i < kNodes; ++i)
        for (std::size_t j = 0; j < kNodes; ++j)
          result[i * kNodes + j] += weight_[q] * f[q * kWidth + i] * g[q * kWidth + j];
  }
  return result;
}

template <int Nodes>
typename CellKernel<Nodes>::Square CellKernel<Nodes>::mass() const {
  if (is_curved_) return product(values(), values());
  Square result = reference<Nodes>().mass;
  for (double& each : result) each *= volume_;
  return result;
}

template <int Nodes>
typename CellKernel<Nodes>::Square CellKernel<Nodes>::stiffness() const {
  Square result{};
  if constexpr (Nodes == 4) {
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j)
        result[4 * i + j] = volume_ * corner_gradient_[i].dot(corner_gradient_[j]);
  } else if (is_curved_) {
    for (const Table& by : gradient_) {
      const Square part = product(by, by);
      for (std::size_t e = 0; e < part.size(); ++e) result[e] += part[e];
    }
  } else {
    // As in StraightQuadraticMatrices, with G_kl = V g_k·g_l.
    std::array<std::array<double, 4>, 4> G{};
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t l = 0; l < 4; ++l)
        G[k][l] = volume_ * corner_gradient_[k].dot(corner_gradient_[l]);
    const auto gamma = [](std::size_t k, std::size_t l) { return k == l ? 0.6 : -0.2; };
    const auto set = [&](std::size_t i, std::size_t j, double value) {
      result[i * kNodes + j] = result[j * kNodes + i] = value;
    };
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t l = 0; l <= k; ++l) set(k, l, gamma(k, l) * G[k][l]);
      for (std::size_t e = 0; e < 6; ++e) {
        const auto [p, q] = fem::kCellEdges[e];
        set(k, 4 + e, gamma(k, p) * G[k][q] + gamma(k, q) * G[k][p]);
      }
    }
    const auto twice = [](std::size_t a, std::size_t b) { return a == b ? 2.0 : 1.0; };
    for (std::size_t e = 0; e < 6; ++e)
      for (std::size_t f = 0; f <= e; ++f) {
        const auto [p, q] = fem::kCellEdges[e];
        const auto [r, s] = fem::kCellEdges[f];
        set(4 + e, 4 + f,
            0.8 * (twice(p, r) * G[q][s] + twice(p, s) * G[q][r] + twice(q, r) * G[p][s] +
                   twice(q, s) * G[p][r]));
      }
  }
  return result;
}

template <int Nodes>
typename CellKernel<Nodes>::ByNode CellKernel<Nodes>::laplacians() const {
  ByNode result{};
  if constexpr (Nodes == 10) {
    if (is_curved_) return result;
    for (std::size_t i = 0; i < 4; ++i) result[i] = 4.0 * corner_gradient_[i].squaredNorm();
    for (std::size_t e = 0; e < 6; ++e)
      result[4 + e] = 8.0 * corner_gradient_[fem::kCellEdges[e][0]].dot(
                                corner_gradient_[fem::kCellEdges[e][1]]);
  }
  return result;
}

template <int Nodes>
typename CellKernel<Nodes>::Table CellKernel<Nodes>::along(const Vectors& u) const {
  Table result;
  if constexpr (Nodes == 10) {
    if (is_curved_) {
      combine_three(gradient_[0].data(), u[0].data(), result.data());
      return result;
    }
    std::array<double, 4 * kPoints> by;  // u·∇b_a
    for (std::size_t q = 0; q < kPoints; ++q)
      for (std::size_t a = 0; a < 4; ++a) by[4 * q + a] = u[q].dot(corner_gradient_[a]);
    combine_four(reference<Nodes>().derivative[0].data(), by.data(), result.data());
  } else {
    for (std::size_t q = 0; q < kPoints; ++q)
      for (std::size_t i = 0; i < kNodes; ++i) {
        const std::size_t e = q * kWidth + i;
        result[e] =
            u[q].x() * gradient_[0][e] + u[q].y() * gradient_[1][e] + u[q].z() * gradient_[2][e];
      }
  }
  return result;
}

template <int Nodes>
typename CellKernel<Nodes>::ByNode CellKernel<Nodes>::integral(const Table& f) const {
  std::array<double, kWidth> sum{};
  for (std::size_t q = 0; q < kPoints; ++q)
    for (std::size_t i = 0; i < kWidth; ++i) sum[i] += weight_[q] * f[q * kWidth + i];
  ByNode result;
  std::copy_n(sum.begin(), kNodes, result.begin());
  return result;
}

template <int Nodes>
typename CellKernel<Nodes>::ByNode CellKernel<Nodes>::shares() const {
  if (is_curved_) return integral(values());
  ByNode result = reference<Nodes>().shares;
  for (double& each : result) each *= volume_;
  return result;
}

template <int Nodes>
typename CellKernel<Nodes>::Vectors CellKernel<Nodes>::at_points(
    const Field<NodeId, Vec3>& field) const {
  Vectors result;
  if constexpr (Nodes == 10) {
    std::array<Vec3, kNodes> v;
    for (std::size_t i = 0; i < kNodes; ++i) v[i] = field[NodeId{nodes_[i]}];
    evaluate(reference<Nodes>().value_by_node.data(), v[0].data(), 3, result[0].data());
    return result;
  }
  result.fill(Vec3::Zero());
  for (std::size_t i = 0; i < kNodes; ++i)
    for (std::size_t q = 0; q < kPoints; ++q)
      result[q] += values()[q * kWidth + i] * field[NodeId{nodes_[i]}];
  return result;
}

template <int Nodes>
typename CellKernel<Nodes>::ByPoint CellKernel<Nodes>::at_points(
    std::span<const double> field) const {
  const Table& phi = values();
  ByPoint result{};
  for (std::size_t q = 0; q < kPoints; ++q)
    for (std::size_t i = 0; i < kNodes; ++i) result[q] += phi[q * kWidth + i] * field[node(i)];
  return result;
}

template <int Nodes>
typename CellKernel<Nodes>::Vectors CellKernel<Nodes>::gradients_of(
    std::span<const double> field) const {
  ByNode value;
  for (std::size_t i = 0; i < kNodes; ++i) value[i] = field[node(i)];
  return slopes_of(value);
}

template <int Nodes>
typename CellKernel<Nodes>::Vectors CellKernel<Nodes>::slopes_of(const ByNode& value) const {
  Vectors result;
  if constexpr (Nodes == 10)
    if (!is_curved_) {
      result.fill(Vec3::Zero());
      ByPoint slope;
      for (std::size_t a = 0; a < 4; ++a) {
        evaluate(reference<Nodes>().derivative_by_node[a].data(), value.data(), 1, slope.data());
        for (std::size_t q = 0; q < kPoints; ++q) result[q] += slope[q] * corner_gradient_[a];
      }
      return result;
    }
  for (std::size_t q = 0; q < kPoints; ++q)
    for (std::size_t k = 0; k < 3; ++k) {
      double sum = 0.0;
      for (std::size_t i = 0; i < kNodes; ++i) sum += gradient_[k][q * kWidth + i] * value[i];
      result[q][static_cast<Eigen::Index>(k)] = sum;
    }
  return result;
}

template <int Nodes>
std::array<Mat3, CellKernel<Nodes>::kPoints> CellKernel<Nodes>::gradients_of(
    const Field<NodeId, Vec3>& field) const {
  std::array<Mat3, kPoints> result;
  for (int a = 0; a < 3; ++a) {
    ByNode component;
    for (std::size_t i = 0; i < kNodes; ++i) component[i] = field[NodeId{nodes_[i]}][a];
    const Vectors slopes = slopes_of(component);
    for (std::size_t q = 0; q < kPoints; ++q) result[q].row(a) = slopes[q].transpose();
  }
  return result;
}

namespace {

template <int Nodes>
PointValue value_of(const ScalarSpace& space, const NodePositions& positions, CellId c,
                    const std::array<double, 4>& b, std::span<const double> values) {
  const auto nodes = space.elements.velocity.of(c);
  const auto by = barycentric_derivatives<Nodes>(b);
  std::array<double, Nodes> phi{};
  if constexpr (Nodes == 4)
    phi = b;
  else
    phi = fem::quadratic_tetrahedron_values(b);
  PointValue result;
  Mat3 jacobian = Mat3::Zero();  // ∂x_k/∂b_a at (k, a)
  Vec3 slope = Vec3::Zero();     // ∂T/∂b_a
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const double value = values[static_cast<std::size_t>(nodes[i])];
    const Vec3& x = positions.x[NodeId{nodes[i]}];
    result.value += phi[i] * value;
    result.x += phi[i] * x;
    for (int a = 0; a < 3; ++a) {
      const double derivative = by(row, a + 1) - by(row, 0);
      jacobian.col(a) += derivative * x;
      slope[a] += derivative * value;
    }
  }
  result.inverse = jacobian.inverse();
  result.gradient = result.inverse.transpose() * slope;
  return result;
}

}  // namespace

PointValue value_at(const ScalarSpace& space, const NodePositions& positions, CellId c,
                    const std::array<double, 4>& barycentric, std::span<const double> values) {
  return space.elements.velocity.nodes_per_cell == 4
             ? value_of<4>(space, positions, c, barycentric, values)
             : value_of<10>(space, positions, c, barycentric, values);
}

template class CellKernel<4>;
template class CellKernel<10>;

}  // namespace meniscus::bulk
