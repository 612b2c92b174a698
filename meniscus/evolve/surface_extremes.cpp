#include "meniscus/evolve/surface_extremes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Dense>

#include "meniscus/surface/quartic_curvature.hpp"
#include "meniscus/surface/spline_patch.hpp"

namespace meniscus {
namespace {

using Vec2 = Eigen::Vector2d;

// Differences over this part of an edge; each round of a search takes a third of the one before.
constexpr double kFirstDifference = 0.3;
constexpr int kRounds = 4;

/// The way from u = 0 to the extremum of f(u) = f0 + g·u + ½uᵀMu, a maximum for sign > 0. It goes
/// along each eigenvector of M of the right curvature, by at most `reach`.
Vec2 way_to_extremum(const Vec2& g, const Eigen::Matrix2d& M, double sign, double reach) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(M);
  Vec2 way = Vec2::Zero();
  for (int k = 0; k < 2; ++k) {
    const Vec2 direction = eigen.eigenvectors().col(k);
    const double m = eigen.eigenvalues()[k], slope = direction.dot(g);
    if (sign * m < 0.0) way += std::clamp(-slope / m, -reach, reach) * direction;
  }
  return way;
}

/// Where a function of two variables is extreme near the origin, by differences over `h` at first.
Vec2 extremum(const auto& f, double sign, double h) {
  Vec2 at = Vec2::Zero();
  double difference = kFirstDifference * h;
  for (int round = 0; round < kRounds; ++round, difference /= 3.0) {
    const auto value = [&](double u, double v) { return f(Vec2(at + difference * Vec2(u, v))); };
    const double f0 = value(0, 0), east = value(1, 0), west = value(-1, 0), north = value(0, 1),
                 south = value(0, -1);
    Eigen::Matrix2d M;
    M(0, 0) = east + west - 2.0 * f0;
    M(1, 1) = north + south - 2.0 * f0;
    M(0, 1) = M(1, 0) = 0.25 * (value(1, 1) + value(-1, -1) - value(1, -1) - value(-1, 1));
    const Vec2 g(0.5 * (east - west), 0.5 * (north - south));
    at += difference * way_to_extremum(g, M, sign, h / difference);
    if (at.norm() > h) at *= h / at.norm();
  }
  return at;
}

}  // namespace

/// The surface around one vertex, over its tangent plane.
struct SurfaceExtremes::Around {
  VertexCurvature fit;
  HeightPatch axes;
  SplinePatch spline;
  double h;  ///< mean edge at the vertex [R0]

  [[nodiscard]] double paraboloid(const Vec3& d) const {
    return -0.5 * (fit.k1 * d.x() * d.x() + fit.k2 * d.y() * d.y());
  }
  /// At coordinates u of the spline, which near the vertex are those of the tangent plane.
  [[nodiscard]] Vec3 point(const Vec2& u) const {
    const SplinePatch::Level at = spline.level(u.x(), u.y());
    Vec3 d(u.x(), u.y(), 0.0);
    d.z() = paraboloid(d);
    d += at.trust * (spline.point(at.g, u.x(), u.y()) - d);
    return axes.x + d.x() * axes.t1 + d.y() * axes.t2 + d.z() * axes.n;
  }
  /// How far a point lies above the surface, to first order.
  [[nodiscard]] double above(const Vec3& x) const {
    const Vec3 from = x - axes.x, d(from.dot(axes.t1), from.dot(axes.t2), from.dot(axes.n));
    const Vec3 flat = spline.coordinates(d);
    const SplinePatch::Level at = spline.level(flat.x(), flat.y());
    return at.trust * (flat.z() - at.g) + (1.0 - at.trust) * (d.z() - paraboloid(d));
  }
};

SurfaceExtremes::SurfaceExtremes(const SurfaceMesh& mesh, SurfaceTopology topology,
                                 const VertexField<VertexCurvature>& osculating)
    : mesh_(mesh),
      topology_(std::move(topology)),
      fit_(quartic_curvature(mesh, topology_, osculating)),
      rings_(mesh, topology_) {}

SurfaceExtremes::Around SurfaceExtremes::around(VertexId v) {
  const VertexCurvature& fit = fit_[v];
  HeightPatch axes;
  axes.x = mesh_.x[v];
  axes.t1 = fit.d1;
  axes.t2 = fit.d2;
  axes.n = fit.n;
  std::vector<Vec3> points{mesh_.x[v]};
  const auto gather = [&](VertexId w) {
    for (const Vec3& p : rings_.gather(w, true)) points.push_back(p);
  };
  gather(v);
  double h = 0.0;
  for (const VertexId w : topology_.ring(v)) {
    gather(w);
    h += (mesh_.x[w] - mesh_.x[v]).norm() / topology_.valence(v);
  }
  nearest_first(mesh_.x[v], points);
  return {fit, axes,
          SplinePatch(axes, OsculatingQuadric::sphere(fit.half_sum()), points,
                      SplinePatch::Coordinates::unrolled),
          h};
}

double SurfaceExtremes::support(const Vec3& e) {
  const auto ids = mesh_.x.ids();
  const VertexId best =
      *std::ranges::max_element(ids, {}, [&](VertexId v) { return e.dot(mesh_.x[v]); });
  const Around near = around(best);
  const auto along = [&](const Vec2& u) { return e.dot(near.point(u)); };
  return std::max(e.dot(mesh_.x[best]), along(extremum(along, 1.0, near.h)));
}

ExtremeDistance SurfaceExtremes::extreme_distance(const Vec3& c, const Mat3& P, double sign) {
  const auto distance = [&](const Vec3& x) { return (P * (x - c)).norm(); };
  const auto ids = mesh_.x.ids();
  const VertexId best =
      *std::ranges::max_element(ids, {}, [&](VertexId v) { return sign * distance(mesh_.x[v]); });
  const Around near = around(best);
  const Vec3 x =
      near.point(extremum([&](const Vec2& u) { return distance(near.point(u)); }, sign, near.h));
  return {distance(x), x};
}

ExtremeDistance SurfaceExtremes::extreme_in_plane(const Vec3& c, const Vec3& e, double sign,
                                                  const ExtremeDistance& found) {
  const auto ids = mesh_.x.ids();
  const Around near = around(*std::ranges::min_element(
      ids, {}, [&](VertexId v) { return (mesh_.x[v] - found.point).squaredNorm(); }));
  const Vec3 along = (found.point - c).normalized(), across = e.cross(along);
  const auto direction = [&](double angle) {
    return Vec3(std::cos(angle) * along + std::sin(angle) * across);
  };
  // Where a ray from c meets the surface, by secants from the point found.
  const auto distance = [&](double angle) {
    const Vec3 d = direction(angle);
    double r0 = found.distance, f0 = near.above(c + r0 * d);
    double r1 = r0 - f0 / std::max(0.5, d.dot(near.axes.n));
    for (int k = 0; k < 20 && std::abs(r1 - r0) > 1e-13; ++k) {
      const double f1 = near.above(c + r1 * d);
      if (f1 == f0) break;
      const double r2 = r1 - f1 * (r1 - r0) / (f1 - f0);
      r0 = r1, f0 = f1, r1 = r2;
    }
    return r1;
  };
  const double h = near.h / found.distance;
  const double angle = extremum([&](const Vec2& u) { return distance(u.x()); }, sign, h).x();
  const double r = distance(angle);
  // A section that its plane hardly cuts has no extreme point of its own.
  if (!(std::abs(r - found.distance) < near.h)) return found;
  return {r, c + r * direction(angle)};
}

}  // namespace meniscus
