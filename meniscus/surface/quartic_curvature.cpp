#include "meniscus/surface/quartic_curvature.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "meniscus/core/error.hpp"
#include "meniscus/surface/height_patch.hpp"
#include "meniscus/surface/polynomial_fit.hpp"
#include "meniscus/surface/rings.hpp"

namespace meniscus {
namespace {

constexpr int kTerms = num_monomials(4);

/// Least relative root of a pivot of a fit. It is smaller than elsewhere: u⁴/24 alone makes these
/// roots twelve times as small as ½u². Below it the fit amplifies the vertices' noise more than the
/// lower degree's truncation is worth.
constexpr double kLeastQuarticPivot = 1.25e-4;

/// Gradient and second derivatives of g at the vertex.
std::optional<Eigen::Matrix<double, 5, 1>> level_derivatives(const HeightPatch& frame,
                                                             double half_sum,
                                                             std::span<const Vec3> points) {
  if (points.size() < kTerms) return std::nullopt;
  double squares = 0.0;
  for (const Vec3& p : points) squares += (p - frame.x).squaredNorm();
  const double h = std::sqrt(squares / static_cast<double>(points.size()));
  PolynomialFit<kTerms> fit;
  Eigen::Matrix<double, kTerms, 1> rhs = Eigen::Matrix<double, kTerms, 1>::Zero();
  for (const Vec3& p : points) {
    const Vec3 d = p - frame.x;
    const double level = d.dot(frame.n) + 0.5 * half_sum * d.squaredNorm();
    rhs += level *
           fit.add(monomials<4>(d.dot(frame.t1) / h, d.dot(frame.t2) / h), h * h / d.squaredNorm());
  }
  const auto factor = fit.factor(kLeastQuarticPivot);
  if (!factor) return std::nullopt;
  Eigen::Matrix<double, 5, 1> g = factor->solve(rhs).head<5>();
  g.head<2>() /= h;
  g.tail<3>() /= h * h;
  return g;
}

/// A circle is no wider than 2/|k|: where even the closest neighbour is further away, what bends so
/// is the polynomial.
bool is_seen(const VertexCurvature& curvature, const Vec3& x, std::span<const Vec3> neighbours) {
  double closest = std::numeric_limits<double>::infinity();
  for (const Vec3& p : neighbours) closest = std::min(closest, (p - x).norm());
  return closest * std::max(std::abs(curvature.k1), std::abs(curvature.k2)) <= 2.0;
}

}  // namespace

VertexField<VertexCurvature> quartic_curvature(const SurfaceMesh& mesh,
                                               const SurfaceTopology& topology,
                                               const VertexField<VertexCurvature>& osculating) {
  MENISCUS_ASSERT(osculating.size() == mesh.num_vertices(), "{} estimates of {} vertices",
                  osculating.size(), mesh.num_vertices());
  VertexField<VertexCurvature> result = osculating;
  RingGatherer rings(mesh, topology);
  for (const VertexId v : mesh.x.ids()) {
    const double half_sum = osculating[v].half_sum();
    HeightPatch frame = flat_patch(mesh.x[v], osculating[v].n);
    const std::span<const Vec3> points = rings.gather(v, true);
    const auto g = level_derivatives(frame, half_sum, points);
    if (!g) continue;
    // z + ½H(u² + v² + z²) = g twice differentiated at the vertex.
    const double z_u = (*g)[0], z_v = (*g)[1];
    frame.c = {z_u, z_v, (*g)[2] - half_sum * (1.0 + z_u * z_u), (*g)[3] - half_sum * z_u * z_v,
               (*g)[4] - half_sum * (1.0 + z_v * z_v)};
    if (const VertexCurvature quartic = frame.curvature(); is_seen(quartic, mesh.x[v], points))
      result[v] = quartic;
  }
  return result;
}

}  // namespace meniscus
