#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/surface/curvature.hpp"
#include "meniscus/surface/remesh.hpp"

namespace meniscus::test {

/// Exact normal and sum of principal curvatures at a point of the ellipsoid |x_i/axes_i| = 1.
struct ExactCurvature {
  Vec3 n;
  double sum;
};
inline ExactCurvature ellipsoid_curvature(const Vec3& x, const Vec3& axes) {
  const Vec3 gradient = x.cwiseQuotient(axes.cwiseProduct(axes));
  const double size = gradient.norm();
  const Vec3 n = gradient / size;
  const Mat3 hessian = axes.cwiseProduct(axes).cwiseInverse().asDiagonal();
  return {n, ((Mat3::Identity() - n * n.transpose()) * hessian).trace() / size};
}
/// Distance of a point near the ellipsoid from it, to first order in the distance.
inline double ellipsoid_distance(const Vec3& x, const Vec3& axes) {
  const double level = x.cwiseQuotient(axes).norm();
  return (level - 1.0) * level / x.cwiseQuotient(axes.cwiseProduct(axes)).norm();
}

/// A mesh in the equilibrium of its springs, with every vertex on the ellipsoid.
inline SurfaceMesh equilibrated_ellipsoid(int num_vertices, const Vec3& axes) {
  SurfaceMesh mesh = stretched_sphere(num_vertices, axes);
  const RemeshReport report = remesh(mesh, {.C0 = num_vertices / (4.0 * std::numbers::pi)});
  EXPECT_TRUE(report.ok()) << report.text();
  for (Vec3& x : mesh.x) x /= x.cwiseQuotient(axes).norm();
  return mesh;
}

/// ∮⟨κ⟩² dS of a prolate spheroid of semi-axes a along, b across, by the midpoint rule in the
/// eccentric angle (2000 points: relative error below 1e-5 up to a/b = 10).
inline double prolate_curvature_integral(double a, double b) {
  constexpr int kPoints = 2000;
  double sum = 0.0;
  for (int i = 0; i < kPoints; ++i) {
    const double t = std::numbers::pi * (i + 0.5) / kPoints;
    const double q = std::hypot(a * std::sin(t), b * std::cos(t));
    const double k1 = a * b / (q * q * q), k2 = a / (b * q);
    sum += b * std::sin(t) * q * (k1 * k1 + k2 * k2);
  }
  return sum * std::numbers::pi * std::numbers::pi / kPoints;
}

/// Torus about the z-axis, rows of vertices shifted by half a cell in turn; `rows` must be even.
inline SurfaceMesh torus(int columns, int rows, double major, double minor) {
  SurfaceMesh mesh;
  const auto id = [&](int i, int j) {
    return VertexId{((j + rows) % rows) * columns + (i + columns) % columns};
  };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const double u = 2.0 * std::numbers::pi * (i + 0.5 * (j % 2)) / columns;
      const double v = 2.0 * std::numbers::pi * j / rows;
      const double r = major + minor * std::cos(v);
      mesh.x.add(Vec3(r * std::cos(u), r * std::sin(u), minor * std::sin(v)));
    }
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const int shift = j % 2;
      mesh.faces.add({id(i, j), id(i + 1, j), id(i + shift, j + 1)});
      mesh.faces.add({id(i + 1, j), id(i + 1 + shift, j + 1), id(i + shift, j + 1)});
    }
  return mesh;
}
inline ExactCurvature torus_curvature(const Vec3& x, double major, double minor) {
  const double rho = std::hypot(x.x(), x.y());
  const Vec3 center(major * x.x() / rho, major * x.y() / rho, 0.0);
  const Vec3 n = (x - center) / minor;
  return {n, 1.0 / minor + (rho - major) / (minor * rho)};
}

/// A sphere with bumps: r = 1 + Σ_k a_k cos(m_k d_k·x + φ_k) over a few random directions, scaled
/// so that no slope is steep.
inline SurfaceMesh bumpy_sphere(int num_vertices, unsigned seed, double amplitude) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  SurfaceMesh mesh = sphere(num_vertices);
  constexpr int kWaves = 5;
  std::array<Vec3, kWaves> direction;
  std::array<double, kWaves> phase;
  for (std::size_t k = 0; k < kWaves; ++k) {
    const Vec3 d(normal(random), normal(random), normal(random));
    direction[k] = (1.0 + 2.0 * uniform(random)) * d.normalized();
    phase[k] = 2.0 * std::numbers::pi * uniform(random);
  }
  for (Vec3& x : mesh.x) {
    double r = 1.0;
    for (std::size_t k = 0; k < kWaves; ++k)
      r += amplitude / kWaves * std::cos(direction[k].dot(x) + phase[k]);
    x *= r;
  }
  return mesh;
}

/// Slope of log(error) against log(1/h) for h ~ N^(−1/2), by least squares over the levels.
inline double observed_order(std::span<const double> vertices, std::span<const double> errors) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const auto n = static_cast<double>(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const double x = 0.5 * std::log(vertices[i]), y = -std::log(errors[i]);
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace meniscus::test
