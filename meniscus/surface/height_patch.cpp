#include "meniscus/surface/height_patch.hpp"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace meniscus {
namespace {

/// Smallest pivot of the Cholesky factor over the largest; below it two or more directions of the
/// polynomial space are told apart by less than the noise of a fit (columns have unit scale).
constexpr double kSingularPivot = 1e-3;

/// Turn of the normal by the quartic terms over two rings [radians] at which half of the quartic is
/// taken. Where a surface is as coarse as its own waves a quartic overshoots, and vertices that
/// circulate carry that on; where it is resolved the turn is far below this.
constexpr double kResolvedTurn = 0.3;

/// The functions that the coefficients c0, c1, … multiply; three terms make a sphere.
template <int Terms>
Eigen::Matrix<double, Terms, 1> monomials(double u, double v) {
  Eigen::Matrix<double, Terms, 1> m;
  m[0] = u;
  m[1] = v;
  if constexpr (Terms == 3) {
    m[2] = 0.5 * (u * u + v * v);
    return m;
  } else {
    m[2] = 0.5 * u * u;
    m[3] = u * v;
    m[4] = 0.5 * v * v;
    if constexpr (Terms >= 9) {
      m[5] = u * m[2] / 3.0;
      m[6] = m[2] * v;
      m[7] = u * m[4];
      m[8] = v * m[4] / 3.0;
    }
    if constexpr (Terms == 14) {
      m[9] = u * m[5] / 4.0;
      m[10] = m[5] * v;
      m[11] = m[2] * m[4];
      m[12] = u * m[8];
      m[13] = m[8] * v / 4.0;
    }
    return m;
  }
}

double root_mean_square_distance(const Vec3& x, std::span<const Vec3> points) {
  double sum = 0.0;
  for (const Vec3& p : points) sum += (p - x).squaredNorm();
  return std::sqrt(sum / static_cast<double>(points.size()));
}

/// Normal equations of the weighted fit, lengths in units of h, which keeps them well scaled.
template <int Terms>
struct NormalEquations {
  double h;
  Eigen::Matrix<double, Terms, Terms> matrix;  // its lower half
  Eigen::Matrix<double, Terms, 1> rhs;

  NormalEquations(const HeightPatch& frame, std::span<const Vec3> points)
      : h(root_mean_square_distance(frame.x, points)) {
    matrix.setZero();
    rhs.setZero();
    for (const Vec3& p : points) {
      const Vec3 d = (p - frame.x) / h;
      const auto m = monomials<Terms>(d.dot(frame.t1), d.dot(frame.t2));
      const Eigen::Matrix<double, Terms, 1> wm = m / d.squaredNorm();
      for (int j = 0; j < Terms; ++j) matrix.col(j).tail(Terms - j) += m[j] * wm.tail(Terms - j);
      rhs += d.dot(frame.n) * wm;
    }
  }
};

/// The patch of so many coefficients in units of h.
template <class Solution>
HeightPatch scaled_patch(const HeightPatch& frame, const Solution& solution, double h) {
  HeightPatch patch = frame;
  patch.c.fill(0.0);
  double scale = 1.0;  // h^(1 − degree)
  for (Eigen::Index j = 0; j < solution.size(); ++j) {
    if (j == 2 || j == 5 || j == 9) scale /= h;
    patch.c[static_cast<std::size_t>(j)] = scale * solution[j];
  }
  return patch;
}

template <class Factor>
bool is_regular(const Factor& factor) {
  if (factor.info() != Eigen::Success) return false;
  const auto pivots = factor.matrixLLT().diagonal();
  return pivots.minCoeff() > kSingularPivot * pivots.maxCoeff();
}

template <int Terms>
std::optional<HeightPatch> fit_terms(const HeightPatch& frame, std::span<const Vec3> points) {
  if (points.size() < Terms) return std::nullopt;
  const NormalEquations<Terms> equations(frame, points);
  const Eigen::LLT<Eigen::Matrix<double, Terms, Terms>> factor(equations.matrix);
  if (!is_regular(factor)) return std::nullopt;
  HeightPatch patch = scaled_patch(frame, factor.solve(equations.rhs).eval(), equations.h);
  if constexpr (Terms == 3) patch.c[4] = patch.c[2];
  return patch;
}

/// (Σ (f⁗)²)^½, the same in every frame.
double size_of_quartic_terms(const HeightPatch& patch) {
  const auto& c = patch.c;
  return std::sqrt(c[9] * c[9] + 4.0 * c[10] * c[10] + 6.0 * c[11] * c[11] + 4.0 * c[12] * c[12] +
                   c[13] * c[13]);
}

}  // namespace

HeightPatch::Height HeightPatch::height(double u, double v) const {
  // The terms of each degree as quadratic forms, (p, q, r) = p u² + 2 q u v + r v².
  const double p3 = c[5] * u + c[6] * v, q3 = c[6] * u + c[7] * v, r3 = c[7] * u + c[8] * v;
  const double uu = u * u, uv = 2.0 * u * v, vv = v * v;
  const double p4 = c[9] * uu + c[10] * uv + c[11] * vv, q4 = c[10] * uu + c[11] * uv + c[12] * vv,
               r4 = c[11] * uu + c[12] * uv + c[13] * vv;
  const double p = c[2] + p3 / 3.0 + p4 / 12.0, q = c[3] + q3 / 3.0 + q4 / 12.0,
               r = c[4] + r3 / 3.0 + r4 / 12.0;
  const double q_slope = c[3] + 0.5 * q3 + q4 / 6.0;
  return {.z = c[0] * u + c[1] * v + 0.5 * (p * uu + q * uv + r * vv),
          .z_u = c[0] + (c[2] + 0.5 * p3 + p4 / 6.0) * u + q_slope * v,
          .z_v = c[1] + q_slope * u + (c[4] + 0.5 * r3 + r4 / 6.0) * v};
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

double HeightPatch::z(double u, double v) const {
  const double uu = u * u, uv = 2.0 * u * v, vv = v * v;
  const double p =
      c[2] + (c[5] * u + c[6] * v) / 3.0 + (c[9] * uu + c[10] * uv + c[11] * vv) / 12.0;
  const double q =
      c[3] + (c[6] * u + c[7] * v) / 3.0 + (c[10] * uu + c[11] * uv + c[12] * vv) / 12.0;
  const double r =
      c[4] + (c[7] * u + c[8] * v) / 3.0 + (c[11] * uu + c[12] * uv + c[13] * vv) / 12.0;
  return c[0] * u + c[1] * v + 0.5 * (p * uu + q * uv + r * vv);
}

double HeightPatch::rolled_z(double u, double v) const {
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
    unrolled.push_back(frame.x + d.norm() / flat.norm() * flat + z * frame.n);
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

std::optional<ResolvedPatch> fit_resolved_patch(const HeightPatch& frame,
                                                std::span<const Vec3> points) {
  constexpr int kCubic = 9, kQuartic = 14;
  if (points.size() >= kQuartic) {
    const NormalEquations<kQuartic> equations(frame, points);
    const Eigen::LLT<Eigen::Matrix<double, kQuartic, kQuartic>> factor(equations.matrix);
    if (is_regular(factor)) {
      // The factor of the cubic's equations is the leading block of that of the quartic's.
      Eigen::Matrix<double, kQuartic, 1> solution = equations.rhs;
      factor.matrixL().solveInPlace(solution);
      Eigen::Matrix<double, kCubic, 1> lower = solution.head<kCubic>();
      factor.matrixLLT()
          .topLeftCorner<kCubic, kCubic>()
          .triangularView<Eigen::Lower>()
          .transpose()
          .solveInPlace(lower);
      factor.matrixU().solveInPlace(solution);
      const HeightPatch cubic = scaled_patch(frame, lower, equations.h),
                        quartic = scaled_patch(frame, solution, equations.h);
      const double h = equations.h, turn = h * h * h * size_of_quartic_terms(quartic);
      const double w = 1.0 / (1.0 + std::pow(turn / kResolvedTurn, 4));
      HeightPatch blended = cubic;
      for (std::size_t j = 0; j < blended.c.size(); ++j)
        blended.c[j] += w * (quartic.c[j] - cubic.c[j]);
      return ResolvedPatch{blended, quartic};
    }
  }
  if (const auto cubic = fit_terms<kCubic>(frame, points)) return ResolvedPatch{*cubic, {}};
  return std::nullopt;
}

}  // namespace meniscus
