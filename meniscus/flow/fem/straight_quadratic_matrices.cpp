#include "meniscus/flow/fem/straight_quadratic_matrices.hpp"

namespace meniscus::fem {
namespace {

using Gradients = std::array<Vec3, 4>;

/// ∫(4b_k − 1)(4b_l − 1)/V, and ∫(4b_k − 1) 4b_l/V.
double gamma(std::size_t k, std::size_t l) { return k == l ? 0.6 : -0.2; }

/// 20∫b_k b_l/V.
double pair(std::size_t k, std::size_t l) { return k == l ? 2.0 : 1.0; }

/// 5∫b_k ∇φ/V, φ being that of an edge.
Vec3 edge_with(std::size_t k, const std::array<std::size_t, 2>& edge, const Gradients& g) {
  const auto [p, q] = edge;
  return pair(k, p) * g[q] + pair(k, q) * g[p];
}

}  // namespace

StraightQuadraticMatrices::StraightQuadraticMatrices(const LinearTetrahedron& tet,
                                                     double viscosity) {
  const Gradients& g = tet.gradient;
  const double V = tet.volume, scale = viscosity * V;
  const auto set = [&](std::size_t i, std::size_t j, const Mat3& block) {
    products.block<3, 3>(static_cast<Eigen::Index>(3 * i), static_cast<Eigen::Index>(3 * j)) =
        block;
    if (i != j)
      products.block<3, 3>(static_cast<Eigen::Index>(3 * j), static_cast<Eigen::Index>(3 * i)) =
          block.transpose();
  };
  const auto set_divergence = [&](std::size_t k, std::size_t i, const Vec3& value) {
    divergence.block<1, 3>(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(3 * i)) =
        value.transpose();
  };
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 scaled = scale * g[k];
    for (std::size_t l = k; l < 4; ++l) set(k, l, gamma(k, l) * scaled * g[l].transpose());
    for (std::size_t e = 0; e < 6; ++e) {
      const auto [p, q] = kCellEdges[e];
      set(k, 4 + e, scaled * (gamma(k, p) * g[q] + gamma(k, q) * g[p]).transpose());
      set_divergence(k, 4 + e, -0.2 * V * edge_with(k, kCellEdges[e], g));
    }
    for (std::size_t l = 0; l < 4; ++l) {
      set_divergence(k, l, -0.25 * V * gamma(l, k) * g[l]);
      masses(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(l)) =
          pair(k, l) * V / (20.0 * viscosity);
    }
  }
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [p, q] = kCellEdges[e];
    for (std::size_t f = e; f < 6; ++f)
      set(4 + e, 4 + f,
          0.8 * scale *
              (g[q] * edge_with(p, kCellEdges[f], g).transpose() +
               g[p] * edge_with(q, kCellEdges[f], g).transpose()));
  }
}

}  // namespace meniscus::fem
