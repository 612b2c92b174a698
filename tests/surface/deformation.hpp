#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <Eigen/Geometry>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/solids/tessellate.hpp"
#include "meniscus/surface/remesh.hpp"
#include "meniscus/surface/smooth_surface.hpp"

namespace meniscus::test {

/// The three-dimensional deformation of leveque1996, made a test of interfaces by enright2002: a
/// sphere of radius 0.15 at (0.35, 0.35, 0.35) in the unit box is drawn into a thin sheet and
/// brought back by the solenoidal velocity below, whose sign follows cos(πt/T). The exact shape
/// and volume return at t = T.
constexpr double kDeformedRadius = 0.15;
inline const Vec3 kDeformedCenter = Vec3::Constant(0.35);
inline Vec3 deformation_velocity(const Vec3& x, double t, double period) {
  const auto wave = [](double s) { return std::sin(2.0 * std::numbers::pi * s); };
  const auto hump = [](double s) { return std::pow(std::sin(std::numbers::pi * s), 2); };
  return std::cos(std::numbers::pi * t / period) *
         Vec3(2.0 * hump(x.x()) * wave(x.y()) * wave(x.z()),
              -wave(x.x()) * hump(x.y()) * wave(x.z()), -wave(x.x()) * wave(x.y()) * hump(x.z()));
}

struct DeformationOptions {
  double N0 = 100.0;
  double period = 0.75;
  double edge_floor = 0.0;
  double step = 0.01;             ///< |∇v| ≤ 4π, so that a step stretches by at most 13 %
  double spring_tolerance = 0.0;  ///< of the springs (`RemeshOptions`)
};

struct DeformationResult {
  std::string failure;   ///< of the last step that could not be remeshed
  int failed_steps = 0;  ///< they went on with the mesh as it was
  int start_vertices = 0, most_vertices = 0, end_vertices = 0;
  double smallest_angle_deg = 180.0;  ///< of all remeshed steps
  double volume_error = 0.0;          ///< of the smooth surface at the end, relative
  double worst_volume_error = 0.0;    ///< the largest along the way
  double flat_volume_error = 0.0;     ///< of the flat faces at the end, over those at the start
  double shape_error = 0.0;  ///< root mean square of | |x − c|/r − 1 | over the smooth surface
  double worst_shape_error = 0.0;  ///< its largest
};

/// By the classical Runge–Kutta method of fourth order.
inline void advect(SurfaceMesh& mesh, double t, double dt, double period) {
  for (Vec3& x : mesh.x) {
    const Vec3 k1 = deformation_velocity(x, t, period),
               k2 = deformation_velocity(x + 0.5 * dt * k1, t + 0.5 * dt, period),
               k3 = deformation_velocity(x + 0.5 * dt * k2, t + 0.5 * dt, period),
               k4 = deformation_velocity(x + dt * k3, t + dt, period);
    x += dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
}

/// Volume within the smooth surface of a mesh: of faces cut eight times.
inline double smooth_volume(const SurfaceMesh& mesh) {
  const SmoothSurface surface(mesh, SurfaceTopology(mesh));
  return enclosed_volume(tessellation(mesh, surface, 1e-9));
}

inline void measure_return(const SurfaceMesh& mesh, DeformationResult& result) {
  const SmoothSurface surface(mesh, SurfaceTopology(mesh));
  const SurfaceMesh fine = tessellation(mesh, surface, 1e-5);
  double sum = 0.0;
  for (const Vec3& x : fine.x) {
    const double error = std::abs((x - kDeformedCenter).norm() / kDeformedRadius - 1.0);
    sum += error * error;
    result.worst_shape_error = std::max(result.worst_shape_error, error);
  }
  result.shape_error = std::sqrt(sum / fine.num_vertices());
}

/// Moves the vertices and remeshes after every step; nothing restores the volume.
inline DeformationResult deform_and_return(const DeformationOptions& options) {
  const RemeshOptions remeshing{
      .C0 = options.N0 / (4.0 * std::numbers::pi),
      .restores_volume = false,
      .edge_floor = options.edge_floor,
      .spring_tolerance = options.spring_tolerance,
      .find_fault = [](const SurfaceMesh& m) { return find_self_intersection(m); }};
  DeformationResult result;
  SurfaceMesh mesh = sphere(std::max(static_cast<int>(options.N0), remeshing.min_vertices));
  for (Vec3& x : mesh.x) x = kDeformedCenter + kDeformedRadius * x.normalized();
  result.start_vertices = mesh.num_vertices();
  const double exact = 4.0 / 3.0 * std::numbers::pi * std::pow(kDeformedRadius, 3),
               flat = enclosed_volume(mesh);
  const int num_steps = static_cast<int>(std::lround(options.period / options.step));
  const double dt = options.period / num_steps;
  for (int step = 0; step < num_steps; ++step) {
    advect(mesh, step * dt, dt, options.period);
    const RemeshReport report = remesh(mesh, remeshing);
    if (!report.ok()) {
      ++result.failed_steps;
      result.failure = report.text();
    } else {
      result.smallest_angle_deg = std::min(result.smallest_angle_deg, report.min_angle_deg);
    }
    result.most_vertices = std::max(result.most_vertices, mesh.num_vertices());
    if (step % 5 == 4)
      result.worst_volume_error =
          std::max(result.worst_volume_error, std::abs(smooth_volume(mesh) / exact - 1.0));
  }
  result.end_vertices = mesh.num_vertices();
  result.volume_error = smooth_volume(mesh) / exact - 1.0;
  result.flat_volume_error = enclosed_volume(mesh) / flat - 1.0;
  measure_return(mesh, result);
  return result;
}

}  // namespace meniscus::test
