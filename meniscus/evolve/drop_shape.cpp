#include "meniscus/evolve/drop_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Dense>

#include "meniscus/evolve/plane_section.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/curvature.hpp"

namespace meniscus {
namespace {

struct FittedSurface {
  const SurfaceMesh& mesh;
  SurfaceTopology topology;
  VertexField<VertexCurvature> fit;

  explicit FittedSurface(const SurfaceMesh& surface)
      : mesh(surface), topology(surface), fit(fitted_curvature(surface, topology)) {}

  [[nodiscard]] double mean_edge_at(VertexId v) const {
    double sum = 0.0;
    for (const VertexId w : topology.ring(v)) sum += (mesh.x[w] - mesh.x[v]).norm();
    return sum / topology.valence(v);
  }
};

/// Extremum of f(u) = f0 + 2 g·u + uᵀM u, a maximum for sign > 0, else a minimum. Moves from u = 0
/// along each eigenvector of M of the right curvature, by at most `reach`.
double extremum(double f0, const Eigen::Vector2d& g, const Eigen::Matrix2d& M, double sign,
                double reach) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(M);
  double f = f0;
  for (int k = 0; k < 2; ++k) {
    const double m = eigen.eigenvalues()[k], slope = eigen.eigenvectors().col(k).dot(g);
    if (sign * m >= 0.0) continue;
    const double u = std::clamp(-slope / m, -reach, reach);
    f += 2.0 * slope * u + m * u * u;
  }
  return f;
}

/// Largest (sign > 0) or smallest distance |P(x − c)| of the smooth surface, P a projector. It is
/// that of the extreme vertex, corrected on its paraboloid x + u1 d1 + u2 d2 − (k1 u1² + k2 u2²)/2
/// n.
struct ExtremeVertex {
  double distance = 0.0;
  Vec3 direction = Vec3::Zero();
};
ExtremeVertex extreme_distance(const FittedSurface& surface, const Vec3& c, const Mat3& P,
                               double sign) {
  VertexId best{0};
  double extreme = -std::numeric_limits<double>::infinity();
  for (const VertexId v : surface.mesh.x.ids()) {
    const double value = sign * (P * (surface.mesh.x[v] - c)).norm();
    if (value > extreme) extreme = value, best = v;
  }
  const VertexCurvature& fit = surface.fit[best];
  const Vec3 r = P * (surface.mesh.x[best] - c), d1 = P * fit.d1, d2 = P * fit.d2;
  const double along_n = r.dot(fit.n);
  Eigen::Matrix2d M;
  M << d1.squaredNorm() - fit.k1 * along_n, d1.dot(d2), d1.dot(d2),
      d2.squaredNorm() - fit.k2 * along_n;
  const double squared =
      extremum(r.squaredNorm(), {r.dot(d1), r.dot(d2)}, M, sign, surface.mean_edge_at(best));
  return {std::sqrt(std::max(0.0, squared)), r.normalized()};
}

/// The maximum of e·x over the smooth surface, e a unit vector.
double support(const FittedSurface& surface, const Vec3& e) {
  const auto ids = surface.mesh.x.ids();
  const VertexId best =
      *std::ranges::max_element(ids, {}, [&](VertexId v) { return e.dot(surface.mesh.x[v]); });
  const VertexCurvature& fit = surface.fit[best];
  const Eigen::Matrix2d M =
      Eigen::Vector2d(-0.5 * fit.k1 * e.dot(fit.n), -0.5 * fit.k2 * e.dot(fit.n)).asDiagonal();
  return extremum(e.dot(surface.mesh.x[best]), 0.5 * Eigen::Vector2d(e.dot(fit.d1), e.dot(fit.d2)),
                  M, 1.0, surface.mean_edge_at(best));
}

double half_extent(const FittedSurface& surface, const Vec3& e) {
  return 0.5 * (support(surface, e) + support(surface, -e));
}

void measure_planar(const FittedSurface& surface, DropShape& shape) {
  const auto curves =
      plane_section(surface.mesh, surface.topology, surface.fit, shape.centroid, Vec3::UnitZ());
  const ExtremeDistance longest = largest_distance(curves, shape.centroid);
  shape.L = longest.distance;
  shape.B = smallest_distance(curves, shape.centroid).distance;
  shape.W = half_extent(surface, Vec3::UnitZ());
  const Vec3 r = longest.point - shape.centroid;
  double angle = std::atan2(r.y(), r.x()) * 180.0 / std::numbers::pi;
  if (angle > 90.0) angle -= 180.0;
  if (angle <= -90.0) angle += 180.0;
  shape.angle_deg = angle;
}

void measure_axial(const FittedSurface& surface, DropShape& shape) {
  shape.L = half_extent(surface, Vec3::UnitX());
  const Mat3 across = Mat3::Identity() - Mat3(Vec3::UnitX() * Vec3::UnitX().transpose());
  shape.B = shape.W = extreme_distance(surface, shape.centroid, across, 1.0).distance;
}

void measure_general(const FittedSurface& surface, DropShape& shape) {
  const ExtremeVertex longest = extreme_distance(surface, shape.centroid, Mat3::Identity(), 1.0);
  const ExtremeVertex shortest = extreme_distance(surface, shape.centroid, Mat3::Identity(), -1.0);
  shape.L = longest.distance;
  shape.B = shortest.distance;
  const Vec3 normal_to_both = longest.direction.cross(shortest.direction);
  const Vec3 e = normal_to_both.norm() > 1e-6 ? normal_to_both.normalized()
                                              : longest.direction.unitOrthogonal();
  shape.W = half_extent(surface, e);
}

}  // namespace

DropShape drop_shape(const SurfaceMesh& mesh, FlowFamily family,
                     const ReconstructedSurface& faces) {
  const FittedSurface surface(mesh);
  DropShape shape;
  shape.volume = faces.volume();
  shape.area = faces.area();
  shape.centroid = enclosed_centroid(mesh);
  switch (family) {
    case FlowFamily::planar:
      measure_planar(surface, shape);
      break;
    case FlowFamily::axial:
      measure_axial(surface, shape);
      break;
    case FlowFamily::quiescent:
    case FlowFamily::general:
      measure_general(surface, shape);
      break;
  }
  shape.D = (shape.L - shape.B) / (shape.L + shape.B);
  shape.extent_x = half_extent(surface, Vec3::UnitX());
  for (const VertexCurvature& fit : surface.fit)
    shape.H_max = std::max(shape.H_max, fit.half_sum());
  shape.D_inertia = inertial_deformation(faces.second_moments(), shape.volume);
  return shape;
}

double inertial_deformation(const Mat3& second_moments, double volume) {
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(second_moments, Eigen::EigenvaluesOnly);
  const double smallest = std::sqrt(5.0 * std::max(0.0, eigen.eigenvalues()[0]) / volume);
  const double largest = std::sqrt(5.0 * std::max(0.0, eigen.eigenvalues()[2]) / volume);
  return (largest - smallest) / (largest + smallest);
}

}  // namespace meniscus
