#include "meniscus/surface/edge_interpolation.hpp"

#include <algorithm>

#include <Eigen/Cholesky>

namespace meniscus {
namespace {

using Coefficients = Eigen::Matrix<double, 5, 1>;

constexpr std::size_t kLeastRing = 6;  // five unknowns; a ring of five would leave noise undamped
/// Smallest pivot of the scaled normal equations' Cholesky factor over the largest.
constexpr double kSingularPivot = 1e-2;

Coefficients monomials(const HeightPatch& frame, const Vec3& x) {
  const double u = (x - frame.x).dot(frame.t1), v = (x - frame.x).dot(frame.t2);
  return {u, v, 0.5 * u * u, u * v, 0.5 * v * v};
}

std::vector<VertexId> with_second_ring(const SurfaceTopology& topology, VertexId v) {
  std::vector<VertexId> rings;
  for (const VertexId w : topology.ring(v)) {
    rings.push_back(w);
    for (const VertexId far : topology.ring(w))
      if (far != v) rings.push_back(far);
  }
  std::ranges::sort(rings);
  const auto repeated = std::ranges::unique(rings);
  rings.erase(repeated.begin(), repeated.end());
  return rings;
}

}  // namespace

VertexInterpolation::VertexInterpolation(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                                         VertexId v, const Vec3& n)
    : vertex_(v), frame_(flat_patch(mesh.x[v], n)) {
  const auto first = topology.ring(v);
  std::vector<VertexId> narrow(first.begin(), first.end());
  for (const bool is_wide : {false, true}) {
    ring_ = is_wide ? with_second_ring(topology, v) : narrow;
    if (ring_.size() < kLeastRing) continue;
    const double h = (mesh.x[narrow.front()] - mesh.x[v]).norm();
    const Coefficients scale(h, h, h * h, h * h, h * h);
    const auto count = static_cast<Eigen::Index>(ring_.size());
    Eigen::Matrix<double, 5, Eigen::Dynamic> weighted(5, count);
    Eigen::Matrix<double, 5, 5> normal = Eigen::Matrix<double, 5, 5>::Zero();
    for (Eigen::Index j = 0; j < count; ++j) {
      const Vec3& x = mesh.x[ring_[static_cast<std::size_t>(j)]];
      const Coefficients m = monomials(frame_, x).cwiseQuotient(scale);
      weighted.col(j) = h * h / (x - frame_.x).squaredNorm() * m;
      normal += weighted.col(j) * m.transpose();
    }
    const Eigen::LLT<Eigen::Matrix<double, 5, 5>> factor(normal);
    const auto pivots = factor.matrixLLT().diagonal();
    if (factor.info() != Eigen::Success ||
        !(pivots.minCoeff() > kSingularPivot * pivots.maxCoeff()))
      continue;
    fit_ = scale.cwiseInverse().asDiagonal() * factor.solve(weighted);
    return;
  }
  ring_.clear();
}

void VertexInterpolation::add(const Vec3& x, double factor, Stencil& stencil) const {
  double own = factor;
  const Coefficients m = monomials(frame_, x);
  for (std::size_t j = 0; j < ring_.size(); ++j) {
    const double weight = factor * m.dot(fit_.col(static_cast<Eigen::Index>(j)));
    stencil.push_back({ring_[j], weight});
    own -= weight;
  }
  stencil.push_back({vertex_, own});
}

std::vector<Stencil> edge_stencils(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                                   const VertexField<Vec3>& normals,
                                   const std::vector<Vec3>& middles) {
  std::vector<VertexInterpolation> around;
  around.reserve(static_cast<std::size_t>(mesh.num_vertices()));
  for (const VertexId v : mesh.x.ids()) around.emplace_back(mesh, topology, v, normals[v]);
  std::vector<Stencil> stencils(topology.edges().size());
  for (std::size_t e = 0; e < stencils.size(); ++e)
    for (const VertexId end : {topology.edges()[e].a, topology.edges()[e].b})
      around[static_cast<std::size_t>(end.value)].add(middles[e], 0.5, stencils[e]);
  return stencils;
}

}  // namespace meniscus
