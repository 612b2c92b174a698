#pragma once

#include <array>
#include <span>
#include <vector>

#include "meniscus/surface/height_patch.hpp"
#include "meniscus/surface/spline_equations.hpp"

namespace meniscus {

/// The curvature tensor k1 d1d1ᵀ + k2 d2d2ᵀ [1/R0] in the plane normal to the unit vector n, the
/// directions turned with the normal. On spheres and around cylinders it is that of the point whose
/// normal is n.
[[nodiscard]] Mat3 curvature_tensor(const VertexCurvature& curvature, const Vec3& n);

/// The quadric z + ½(uu x² + 2 uv xy + vv y² + zz z²) = 0 in the frame of a point of a surface that
/// curves as the surface does there. Of the quadrics that do, zz = (k1³ + k2³)/(k1² + k2²) takes
/// the sphere where k1 = k2 and the cylinder where k2 = 0.
struct OsculatingQuadric {
  double uu = 0.0, uv = 0.0, vv = 0.0, zz = 0.0;  ///< [1/R0]

  /// The sphere of the half-sum of curvatures. Unrolled coordinates go with it.
  [[nodiscard]] static OsculatingQuadric sphere(double half_sum) {
    return {.uu = half_sum, .vv = half_sum, .zz = half_sum};
  }
  [[nodiscard]] double half_sum() const { return 0.5 * (uu + vv); }
  [[nodiscard]] double level(const Vec3& x) const {
    return x.z() + 0.5 * (uu * x.x() * x.x() + vv * x.y() * x.y() + zz * x.z() * x.z()) +
           uv * x.x() * x.y();
  }
};
/// Of the curvature tensor in the plane of t1 and t2.
[[nodiscard]] OsculatingQuadric osculating_quadric(const HeightPatch& axes, const Mat3& curvature);

/// A spline through the vertices around one place of a surface. In the frame of a point near the
/// surface x and y lie in the tangent plane, z along the normal. With S, the curvature tensor
/// there,
///
///   g = z + ½(S_xx x² + 2 S_xy xy + S_yy y² + S_zz z²),    (u, v) = s (x, y).
///
/// The level g is zero on the osculating quadric (`OsculatingQuadric`). With s² = (1 + (Hz)²)^½ −
/// Hz, H the half-sum of curvatures, the coordinates unroll the surface, as the stereographic
/// projection, s = 1/(1 + Hz/2), does to second order. Then a patch may reach around half of a
/// drop. The function g(u, v) is interpolated from the vertices by polyharmonic splines Σ c_i |(u,
/// v) − (u_i, v_i)|⁷ plus a polynomial of degree four. Exact on the quadric itself, else of an
/// error of about O(h⁶). It needs 15 vertices or more, and takes the 32 nearest.
class SplinePatch {
 public:
  /// Which coordinates a level is a function of: those of the tangent plane, s = 1, or unrolled
  /// ones. These reach farther around a drop. Yet they jump where the set of vertices changes on a
  /// rough surface; there the others have given the spline up already.
  enum class Coordinates { flat, unrolled };
  /// `axes`: the frame; `points`: the vertices around its origin, in the order of `nearest_first`.
  SplinePatch(const HeightPatch& axes, const OsculatingQuadric& quadric,
              std::span<const Vec3> points, Coordinates coordinates);

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

  OsculatingQuadric quadric_;
  Coordinates coordinates_;
  double unit_ = 0.0;      // of length: the distance of the farthest vertex
  std::size_t count_ = 0;  // of the vertices
  std::array<double, kMostPoints> levels_;
  SplineEquations equations_;
};

/// The point above or below the origin of the axes, along their third one, of the spline through
/// the vertices `around` (which are put in order). Where the lift from `flat`, a point of the flat
/// mesh, is high for an edge of length `edge`, the origin itself takes over.
[[nodiscard]] Vec3 point_on_spline(const HeightPatch& axes, const OsculatingQuadric& quadric,
                                   std::vector<Vec3>& around, SplinePatch::Coordinates coordinates,
                                   const Vec3& flat, double edge);

/// Orders points by their distance from `center`, each once.
void nearest_first(const Vec3& center, std::vector<Vec3>& points);

}  // namespace meniscus
