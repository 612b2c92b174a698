#include "meniscus/surface/edge_interpolation.hpp"

#include <algorithm>

#include "meniscus/core/error.hpp"
#include "meniscus/surface/polynomial_fit.hpp"

namespace meniscus {
namespace {

/// Least relative root of a pivot of a fit. It is larger than elsewhere, so that a second ring
/// takes over sooner.
constexpr double kLeastStencilPivot = 1e-2;
constexpr std::size_t kLeastRing = 6;  // five unknowns; a ring of five would leave noise undamped

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
    MENISCUS_ASSERT(h > 0.0, "vertices {} and {} coincide", v.value, narrow.front().value);
    Eigen::Matrix<double, 5, Eigen::Dynamic> weighted(5, static_cast<Eigen::Index>(ring_.size()));
    PolynomialFit<5> fit;
    for (std::size_t j = 0; j < ring_.size(); ++j) {
      const Vec3 d = (mesh.x[ring_[j]] - frame_.x) / h;
      weighted.col(static_cast<Eigen::Index>(j)) =
          fit.add(monomials<2>(d.dot(frame_.t1), d.dot(frame_.t2)), 1.0 / d.squaredNorm());
    }
    const auto factor = fit.factor(kLeastStencilPivot);
    if (!factor) continue;
    fit_ = factor->solve(weighted);
    scale_ = h;
    return;
  }
  ring_.clear();
}

void VertexInterpolation::add(const Vec3& x, double factor, Stencil& stencil) const {
  double own = factor;
  const Vec3 d = (x - frame_.x) / scale_;
  const auto m = monomials<2>(d.dot(frame_.t1), d.dot(frame_.t2));
  stencil.reserve(stencil.size() + ring_.size() + 1);
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
  MENISCUS_ASSERT(normals.size() == mesh.num_vertices(), "{} normals of {} vertices",
                  normals.size(), mesh.num_vertices());
  MENISCUS_ASSERT(middles.size() == topology.edges().size(), "{} middles of {} edges",
                  middles.size(), topology.edges().size());
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
