#include "meniscus/surface/height_patch.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "meniscus/surface/polynomial_fit.hpp"

namespace meniscus {
namespace {

/// The functions that the coefficients c0, c1, … multiply; three terms make a sphere.
template <int Terms>
Eigen::Matrix<double, Terms, 1> patch_functions(double u, double v) {
  if constexpr (Terms == 3)
    return {u, v, 0.5 * (u * u + v * v)};
  else
    return monomials < Terms == 5 ? 2 : 3 > (u, v);
}

double root_mean_square_distance(const Vec3& x, std::span<const Vec3> points) {
  double sum = 0.0;
  for (const Vec3& p : points) sum += (p - x).squaredNorm();
  return std::sqrt(sum / static_cast<double>(points.size()));
}

template <int Terms>
std::optional<HeightPatch> fit_terms(const HeightPatch& frame, std::span<const Vec3> points) {
  if (points.size() < Terms) return std::nullopt;
  // Lengths in units of h keep the normal equations well scaled.
  const double h = root_mean_square_distance(frame.x, points);
  PolynomialFit<Terms> fit;
  Eigen::Matrix<double, Terms, 1> rhs = Eigen::Matrix<double, Terms, 1>::Zero();
  for (const Vec3& p : points) {
    const Vec3 d = (p - frame.x) / h;
    rhs += d.dot(frame.n) *
           fit.add(patch_functions<Terms>(d.dot(frame.t1), d.dot(frame.t2)), 1.0 / d.squaredNorm());
  }
  const auto factor = fit.factor();
  if (!factor) return std::nullopt;
  const Eigen::Matrix<double, Terms, 1> solution = factor->solve(rhs);
  HeightPatch patch = frame;
  patch.c.fill(0.0);
  for (int j = 0; j < Terms; ++j) {
    const double scale = j < 2 ? 1.0 : (j < 5 ? 1.0 / h : 1.0 / (h * h));
    patch.c[static_cast<std::size_t>(j)] = scale * solution[j];
  }
  if constexpr (Terms == 3) patch.c[4] = patch.c[2];
  return patch;
}

}  // namespace

HeightPatch::Height HeightPatch::height(double u, double v) const {
  const double uu = 0.5 * (c[2] + c[5] * u / 3.0 + c[6] * v);
  const double vv = 0.5 * (c[4] + c[8] * v / 3.0 + c[7] * u);
  return {
      .z = u * (c[0] + uu * u + c[3] * v) + v * (c[1] + vv * v),
      .z_u = c[0] + c[2] * u + c[3] * v + 0.5 * c[5] * u * u + c[6] * u * v + 0.5 * c[7] * v * v,
      .z_v = c[1] + c[3] * u + c[4] * v + 0.5 * c[6] * u * u + c[7] * u * v + 0.5 * c[8] * v * v};
}

HeightPatch::Height HeightPatch::rolled_height(double u, double v) const {
  const double squared = u * u + v * v;
  if (squared == 0.0) return {0.0, c[0], c[1]};
  const Height f = height(u, v);
  const double slope = f.z / squared;  // f/ρ²
  const double s = std::sqrt(1.0 + f.z * slope);
  const double s_u = slope * (f.z_u - slope * u) / s, s_v = slope * (f.z_v - slope * v) / s;
  const Height g = height(s * u, s * v);
  const double along = g.z_u * u + g.z_v * v;
  return {.z = g.z, .z_u = s * g.z_u + along * s_u, .z_v = s * g.z_v + along * s_v};
}

double HeightPatch::rolled_z(double u, double v) const {
  const auto z = [&](double a, double b) {
    const double uu = 0.5 * (c[2] + c[5] * a / 3.0 + c[6] * b);
    const double vv = 0.5 * (c[4] + c[8] * b / 3.0 + c[7] * a);
    return a * (c[0] + uu * a + c[3] * b) + b * (c[1] + vv * b);
  };
  const double squared = u * u + v * v;
  if (squared == 0.0) return 0.0;
  const double f = z(u, v), s = std::sqrt(1.0 + f * f / squared);
  return z(s * u, s * v);
}

VertexCurvature HeightPatch::curvature() const {
  const double w = std::sqrt(1.0 + c[0] * c[0] + c[1] * c[1]);
  const Vec3 r_u = t1 + c[0] * n, r_v = t2 + c[1] * n;
  // Cholesky factor of the first fundamental form: metric = l lᵀ.
  const double l11 = r_u.norm(), l21 = r_u.dot(r_v) / l11, l22 = w / l11;
  // −(second fundamental form), positive where the surface bends away from n.
  const double b11 = -c[2] / w, b12 = -c[3] / w, b22 = -c[4] / w;
  // Symmetric matrix of the shape operator in the orthonormal basis e1 ∥ r_u, e2: l⁻¹ b l⁻ᵀ.
  const double s11 = b11 / (l11 * l11), s12 = (b12 / l11 - l21 * s11) / l22,
               s22 = (b22 - 2.0 * l21 * b12 / l11 + l21 * l21 * s11) / (l22 * l22);
  const Eigen::Matrix2d operator_of_shape{{s11, s12}, {s12, s22}};
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> principal;
  principal.computeDirect(operator_of_shape);
  VertexCurvature result;
  result.n = (n - c[0] * t1 - c[1] * t2) / w;
  const Vec3 e1 = r_u / l11, e2 = result.n.cross(e1);
  result.k1 = principal.eigenvalues()[1];
  result.k2 = principal.eigenvalues()[0];
  result.d1 = principal.eigenvectors()(0, 1) * e1 + principal.eigenvectors()(1, 1) * e2;
  result.d2 = result.n.cross(result.d1);
  return result;
}

HeightPatch scaled(const HeightPatch& patch, const Dilation& dilation) {
  HeightPatch result = patch;
  result.x = dilation(patch.x);
  for (std::size_t k = 2; k < 5; ++k) result.c[k] /= dilation.factor;
  for (std::size_t k = 5; k < 9; ++k) result.c[k] /= dilation.factor * dilation.factor;
  return result;
}

HeightPatch flat_patch(const Vec3& x, const Vec3& n) {
  HeightPatch patch;
  patch.x = x;
  patch.n = n;
  patch.t1 = n.unitOrthogonal();
  patch.t2 = n.cross(patch.t1);
  return patch;
}

void unroll(std::span<const Vec3> points, const HeightPatch& frame, std::vector<Vec3>& unrolled) {
  unrolled.clear();
  for (const Vec3& p : points) {
    const Vec3 d = p - frame.x;
    const double z = d.dot(frame.n);
    const Vec3 flat = d - z * frame.n;
    unrolled.emplace_back(frame.x + d.norm() / flat.norm() * flat + z * frame.n);
  }
}

std::optional<HeightPatch> fit_patch(const HeightPatch& frame, std::span<const Vec3> points,
                                     PatchDegree degree) {
  switch (degree) {
    case PatchDegree::umbilic:
      return fit_terms<3>(frame, points);
    case PatchDegree::quadratic:
      return fit_terms<5>(frame, points);
    case PatchDegree::cubic:
      return fit_terms<9>(frame, points);
  }
  return std::nullopt;
}

}  // namespace meniscus
