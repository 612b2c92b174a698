#include "meniscus/evolve/drop_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Dense>

#include "meniscus/evolve/surface_extremes.hpp"

namespace meniscus {
namespace {

void measure_planar(SurfaceExtremes& surface, DropShape& shape) {
  const auto curves = plane_section(surface.mesh(), surface.topology(), surface.fit(),
                                    shape.centroid, Vec3::UnitZ());
  const auto extreme = [&](double sign, const ExtremeDistance& found) {
    return surface.extreme_in_plane(shape.centroid, Vec3::UnitZ(), sign, found);
  };
  const ExtremeDistance longest = extreme(1.0, largest_distance(curves, shape.centroid));
  shape.L = longest.distance;
  shape.B = extreme(-1.0, smallest_distance(curves, shape.centroid)).distance;
  shape.W = surface.half_extent(Vec3::UnitZ());
  const Vec3 r = longest.point - shape.centroid;
  double angle = std::atan2(r.y(), r.x()) * 180.0 / std::numbers::pi;
  if (angle > 90.0) angle -= 180.0;
  if (angle <= -90.0) angle += 180.0;
  shape.angle_deg = angle;
}

void measure_axial(SurfaceExtremes& surface, DropShape& shape) {
  shape.L = surface.half_extent(Vec3::UnitX());
  const Mat3 across = Mat3::Identity() - Mat3(Vec3::UnitX() * Vec3::UnitX().transpose());
  shape.B = shape.W = surface.extreme_distance(shape.centroid, across, 1.0).distance;
}

void measure_general(SurfaceExtremes& surface, DropShape& shape) {
  const Vec3& c = shape.centroid;
  const ExtremeDistance longest = surface.extreme_distance(c, Mat3::Identity(), 1.0);
  const ExtremeDistance shortest = surface.extreme_distance(c, Mat3::Identity(), -1.0);
  shape.L = longest.distance;
  shape.B = shortest.distance;
  const Vec3 along = (longest.point - c).normalized();
  const Vec3 normal_to_both = along.cross((shortest.point - c).normalized());
  const Vec3 e =
      normal_to_both.norm() > 1e-6 ? normal_to_both.normalized() : along.unitOrthogonal();
  shape.W = surface.half_extent(e);
}

/// The surface's extremes, by what is known of it.
SurfaceExtremes extremes_of(const SurfaceMesh& mesh, const ReconstructedSurface& faces) {
  if (faces.smooth()) return {mesh, *faces.topology(), faces.smooth()->vertex_curvature()};
  SurfaceTopology topology(mesh);
  const VertexField<VertexCurvature> osculating = osculating_curvature(mesh, topology);
  return {mesh, std::move(topology), osculating};
}

}  // namespace

DropShape drop_shape(const SurfaceMesh& mesh, FlowFamily family,
                     const ReconstructedSurface& faces) {
  SurfaceExtremes surface = extremes_of(mesh, faces);
  DropShape shape;
  shape.volume = faces.volume();
  shape.area = faces.area();
  shape.centroid = faces.centroid();
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
  shape.extent_x = surface.half_extent(Vec3::UnitX());
  for (const VertexCurvature& fit : surface.fit())
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
