#pragma once

#include <span>
#include <vector>

#include <Eigen/LU>

#include "meniscus/surface/height_patch.hpp"
#include "meniscus/surface/polynomial_fit.hpp"

namespace meniscus {

/// A spline through the vertices around one place of a surface. In the frame of a point near the
/// surface, z along its normal and H the half-sum of curvatures there, the function
///
///   g(u, v) = z + ½H (u² + v² + z²),
///
/// zero on the osculating sphere, is interpolated from the vertices by polyharmonic splines
/// Σ c_i |(u, v) − (u_i, v_i)|⁷ plus a polynomial of degree four. Exact on spheres, else of an
/// error of about O(h⁶). It needs 15 vertices or more, and takes the 32 nearest.
class SplinePatch {
 public:
  /// `axes`: the frame; `points`: the vertices around its origin, in the order of `nearest_first`.
  SplinePatch(const HeightPatch& axes, double half_sum, std::span<const Vec3> points);

  struct Height {
    double level = 0.0;  ///< g [R0]
    double z = 0.0;      ///< [R0]
    /// How far the spline is to be trusted, 0 to 1. It is less where it amplifies the vertices'
    /// noise, not at all where they do not determine it.
    double trust = 0.0;
  };
  /// At the point (u, v) of the frame's plane [R0].
  [[nodiscard]] Height height(double u, double v) const;
  /// z where the level g counts by a part of it, 0 to 1.
  [[nodiscard]] double z(double level, double u, double v) const;

 private:
  // Vertices are taken in the order of their distance; more cost time and add nothing.
  static constexpr std::size_t kMostPoints = 32;
  static constexpr Eigen::Index kTerms = 1 + num_monomials(4);
  // Of a spline's equations: of bounded size, so that no memory is allocated for each place.
  static constexpr int kMostUnknowns = static_cast<int>(kMostPoints + kTerms);
  using Matrix =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostUnknowns, kMostUnknowns>;
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostUnknowns, 1>;
  using Vec2 = Eigen::Vector2d;

  double half_sum_;
  double unit_ = 0.0;  // of length: the distance of the farthest vertex
  std::vector<Vec2> at_;
  Vector levels_;
  Eigen::PartialPivLU<Matrix> equations_;
};

/// Orders points by their distance from `center`, each once.
void nearest_first(const Vec3& center, std::vector<Vec3>& points);

}  // namespace meniscus
