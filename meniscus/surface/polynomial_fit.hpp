#pragma once

#include <optional>

#include <Eigen/Cholesky>

namespace meniscus {

/// Number of the monomials of degree 1 to `degree` in two variables.
[[nodiscard]] constexpr int num_monomials(int degree) {
  return (degree + 1) * (degree + 2) / 2 - 1;
}

/// u^i v^j/(i! j!) in the order u, v, u², uv, v², u³, u²v, …, without the constant: the
/// coefficients of a function are its derivatives at the origin.
template <int Degree>
[[nodiscard]] Eigen::Matrix<double, num_monomials(Degree), 1> monomials(double u, double v) {
  static_assert(1 <= Degree && Degree <= 4);
  Eigen::Matrix<double, num_monomials(Degree), 1> m;
  m[0] = u;
  m[1] = v;
  if constexpr (Degree >= 2) {
    m[2] = 0.5 * u * u;
    m[3] = u * v;
    m[4] = 0.5 * v * v;
  }
  if constexpr (Degree >= 3) {
    m[5] = u * m[2] / 3.0;
    m[6] = m[2] * v;
    m[7] = u * m[4];
    m[8] = v * m[4] / 3.0;
  }
  if constexpr (Degree >= 4) {
    m[9] = u * m[5] / 4.0;
    m[10] = m[5] * v;
    m[11] = m[2] * m[4];
    m[12] = u * m[8];
    m[13] = v * m[8] / 4.0;
  }
  return m;
}

/// Least ratio of the smallest to the largest entry on the diagonal of the Cholesky factor of a
/// fit's normal equations. These are the roots of its pivots; lengths are in units of the points'
/// distance. Below it the points do not determine the fit. It would amplify the
/// noise of the vertices more than the truncation of a lower degree is worth. What asks for another
/// value says why (docs/surfaces-and-curvature.md).
inline constexpr double kLeastPivot = 1e-3;

/// Weighted least squares of a function c·m about a vertex by its normal equations,
///   (Σ w m mᵀ) c = Σ w m f,
/// m being the monomials at a point, f the value there and w its weight. All fits of this program
/// take 1/distance², so that what counts is the slope by which a point is missed.
template <int Terms>
class PolynomialFit {
 public:
  using Monomials = Eigen::Matrix<double, Terms, 1>;
  using Factor = Eigen::LLT<Eigen::Matrix<double, Terms, Terms>>;

  /// Takes in a point. Returns w m, which its value multiplies in the right side.
  Monomials add(const Monomials& m, double weight) {
    Monomials weighted = weight * m;
    // The lower triangle, in loops of constant bounds.
    for (int j = 0; j < Terms; ++j)
      for (int i = j; i < Terms; ++i) normal_(i, j) += m[j] * weighted[i];
    return weighted;
  }

  /// Solves for coefficients; empty where the points do not determine them.
  [[nodiscard]] std::optional<Factor> factor(double least_pivot = kLeastPivot) const {
    std::optional<Factor> factor(normal_);
    const auto pivots = factor->matrixLLT().diagonal();
    if (factor->info() != Eigen::Success || !(pivots.minCoeff() > least_pivot * pivots.maxCoeff()))
      factor.reset();
    return factor;
  }

 private:
  Eigen::Matrix<double, Terms, Terms> normal_ = Eigen::Matrix<double, Terms, Terms>::Zero();
};

}  // namespace meniscus
