#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/surface/remesh.hpp"
#include "tests/surface/shapes.hpp"

namespace meniscus::test {

/// A closed surface F = 0, F < 0 inside, with its derivatives in closed form.
struct ImplicitShape {
  std::string name;
  std::function<double(const Vec3&)> level;
  std::function<Vec3(const Vec3&)> gradient;
  std::function<Mat3(const Vec3&)> hessian;
  SurfaceMesh start;  ///< a fine triangulation, roughly on it
};

/// Normal and principal curvatures at a point of F = 0: the shape operator is P H P/|∇F| with
/// P = I − nn; its eigenvalues follow from its trace and that of its square.
struct ExactShape {
  Vec3 n;
  double k1, k2;
};
inline ExactShape exact_shape(const ImplicitShape& shape, const Vec3& x) {
  const Vec3 gradient = shape.gradient(x);
  const Vec3 n = gradient.normalized();
  const Mat3 p = Mat3::Identity() - n * n.transpose();
  const Mat3 s = p * shape.hessian(x) * p / gradient.norm();
  const double sum = s.trace(), squares = s.squaredNorm();
  const double difference = std::sqrt(std::max(0.0, 2.0 * squares - sum * sum));
  return {n, 0.5 * (sum + difference), 0.5 * (sum - difference)};
}

/// Onto F = 0 along the gradient, by Newton's method; from near it, the nearest point to second
/// order.
inline Vec3 projected(const ImplicitShape& shape, Vec3 x) {
  for (int step = 0; step < 50; ++step) {
    const Vec3 gradient = shape.gradient(x);
    const Vec3 d = shape.level(x) / gradient.squaredNorm() * gradient;
    x -= d;
    if (d.squaredNorm() < 1e-30) break;
  }
  return x;
}
/// Distance from F = 0, signed, to second order in the distance.
inline double signed_distance(const ImplicitShape& shape, const Vec3& x) {
  const Vec3 d = x - projected(shape, x);
  return d.dot(shape.gradient(x)) > 0.0 ? d.norm() : -d.norm();
}

/// A relaxed mesh with its vertices on the shape: remeshed by the law with C0, projected, twice.
inline SurfaceMesh relaxed_mesh(const ImplicitShape& shape, double C0) {
  SurfaceMesh mesh = shape.start;
  for (int pass = 0; pass < 2; ++pass) {
    const RemeshReport report =
        remesh(mesh, {.C0 = C0, .max_sweeps = 60, .spring_tolerance = 0.002});
    EXPECT_TRUE(report.ok()) << shape.name << ": " << report.text();
    for (Vec3& x : mesh.x) x = projected(shape, x);
  }
  return mesh;
}

inline ImplicitShape implicit_ellipsoid(const Vec3& axes) {
  const Vec3 weights = axes.cwiseProduct(axes).cwiseInverse();
  return {"ellipsoid", [weights](const Vec3& x) { return x.dot(weights.cwiseProduct(x)) - 1.0; },
          [weights](const Vec3& x) -> Vec3 { return 2.0 * weights.cwiseProduct(x); },
          [weights](const Vec3&) -> Mat3 { return 2.0 * Mat3(weights.asDiagonal()); },
          stretched_sphere(1500, axes)};
}

/// About the z-axis: (|x|² + R² − r²)² − 4R²(x² + y²).
inline ImplicitShape implicit_torus(double major, double minor) {
  const double shift = major * major - minor * minor, four = 4.0 * major * major;
  const Mat3 flat = Vec3(1, 1, 0).asDiagonal();
  return {"torus",
          [=](const Vec3& x) {
            const double q = x.squaredNorm() + shift;
            return q * q - four * (x.x() * x.x() + x.y() * x.y());
          },
          [=](const Vec3& x) -> Vec3 {
            return 4.0 * (x.squaredNorm() + shift) * x - 2.0 * four * (flat * x);
          },
          [=](const Vec3& x) -> Mat3 {
            return 8.0 * x * x.transpose() + 4.0 * (x.squaredNorm() + shift) * Mat3::Identity() -
                   2.0 * four * flat;
          },
          torus(100, 40, major, minor)};
}

/// Cassini's oval turned about the x-axis, (|x|² + 1)² − 4x² = (1 + neck²)²: half-length about
/// √2, thickest radius about ½, a neck of the given radius in the middle.
inline ImplicitShape implicit_dumbbell(double neck) {
  const double c2 = 1.0 + neck * neck;
  const Mat3 along = Vec3(1, 0, 0).asDiagonal();
  ImplicitShape shape{
      "dumbbell",
      [=](const Vec3& x) {
        const double q = x.squaredNorm() + 1.0;
        return q * q - 4.0 * x.x() * x.x() - c2 * c2;
      },
      [=](const Vec3& x) -> Vec3 { return 4.0 * (x.squaredNorm() + 1.0) * x - 8.0 * (along * x); },
      [=](const Vec3& x) -> Mat3 {
        return 8.0 * x * x.transpose() + 4.0 * (x.squaredNorm() + 1.0) * Mat3::Identity() -
               8.0 * along;
      },
      sphere(2500)};
  for (Vec3& x : shape.start.x) {  // by its radius in each direction
    const double cosine = x.normalized().x(), cos_2 = 2.0 * cosine * cosine - 1.0;
    x = std::sqrt(cos_2 + std::sqrt(c2 * c2 - 1.0 + cos_2 * cos_2)) * x.normalized();
  }
  return shape;
}

inline std::vector<ImplicitShape> implicit_shapes() {
  return {implicit_ellipsoid(Vec3(1.5, 1.0, 0.8)), implicit_torus(1.0, 0.4),
          implicit_dumbbell(0.4)};
}

}  // namespace meniscus::test
