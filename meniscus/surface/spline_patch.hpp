#pragma once

#include <array>
#include <span>
#include <vector>

#include "meniscus/surface/height_patch.hpp"
#include "meniscus/surface/spline_equations.hpp"

namespace meniscus {

/// A spline through the vertices around one place of a surface. In the frame of a point near the
/// surface x and y lie in the tangent plane, z along the normal. With H, the half-sum of curvatures
/// there,
///
///   g = z + ½H (x² + y² + z²),    (u, v) = s (x, y).
///
/// The level g is zero on the osculating sphere. With s² = (1 + (Hz)²)^½ − Hz the coordinates
/// unroll the surface, as the stereographic projection, s = 1/(1 + Hz/2), does to second order.
/// Then a patch may reach around half of a drop. The function g(u, v) is interpolated from the
/// vertices by polyharmonic splines Σ c_i |(u, v) − (u_i, v_i)|⁷ plus a polynomial of degree four.
/// Exact on spheres, else of an error of about O(h⁶). It needs 15 vertices or more, and takes the
/// 32 nearest.
class SplinePatch {
 public:
  /// Which coordinates a level is a function of: those of the tangent plane, s = 1, or unrolled
  /// ones. These reach farther around a drop. Yet they jump where the set of vertices changes on a
  /// rough surface; there the others have given the spline up already.
  enum class Coordinates { flat, unrolled };
  /// `axes`: the frame; `points`: the vertices around its origin, in the order of `nearest_first`.
  SplinePatch(const HeightPatch& axes, double half_sum, std::span<const Vec3> points,
              Coordinates coordinates);

  struct Level {
    double g = 0.0;  ///< [R0]
    /// How far the spline is to be trusted, 0 to 1. It is less where it amplifies the vertices'
    /// noise, not at all where they do not determine it.
    double trust = 0.0;
  };
  /// Of the spline at coordinates u, v [R0].
  [[nodiscard]] Level level(double u, double v) const;
  /// The point of level g at coordinates u, v, in the frame.
  [[nodiscard]] Vec3 point(double g, double u, double v) const;
  /// Coordinates and level of a point in the frame: (u, v, g).
  [[nodiscard]] Vec3 coordinates(const Vec3& point) const;

 private:
  // Vertices are taken in the order of their distance; more cost time and add nothing.
  static constexpr std::size_t kMostPoints = SplineEquations::kMost;

  [[nodiscard]] double scale(double z) const;
  [[nodiscard]] bool can_see(const Vec3& point) const;

  double half_sum_;
  Coordinates coordinates_;
  double unit_ = 0.0;      // of length: the distance of the farthest vertex
  std::size_t count_ = 0;  // of the vertices
  std::array<double, kMostPoints> levels_;
  SplineEquations equations_;
};

/// The point above or below x, along the unit normal n there, of the spline through the vertices
/// `around` (which are put in order). H is `half_sum`. Where the lift from `flat`, a point of the
/// flat mesh, is high for an edge of length `edge`, x itself takes over.
[[nodiscard]] Vec3 point_on_spline(const Vec3& x, const Vec3& n, double half_sum,
                                   std::vector<Vec3>& around, SplinePatch::Coordinates coordinates,
                                   const Vec3& flat, double edge);

/// Orders points by their distance from `center`, each once.
void nearest_first(const Vec3& center, std::vector<Vec3>& points);

}  // namespace meniscus
