#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "meniscus/surface/curvature.hpp"
#include "meniscus/surface/dilation.hpp"

namespace meniscus {

/// A polynomial height above a plane through a vertex:
///   f(u, v) = c0 u + c1 v + ½(c2 u² + 2 c3 u v + c4 v²) + ⅙(c5 u³ + 3 c6 u² v + 3 c7 u v² + c8
///   v³),
/// with u, v, z along the right-handed unit frame t1, t2, n. It passes through its vertex.
struct HeightPatch {
  Vec3 x = Vec3::Zero();  ///< the vertex [R0]
  Vec3 t1 = Vec3::UnitX(), t2 = Vec3::UnitY(), n = Vec3::UnitZ();
  std::array<double, 9> c{};

  struct Height {
    double z, z_u, z_v;
  };
  /// f and its gradient: the surface of a patch fitted to points as they are.
  [[nodiscard]] Height height(double u, double v) const;
  /// z = f(su, sv), s² = 1 + f(u, v)²/(u² + v²), and its gradient: the surface of a patch fitted to
  /// unrolled points. Second-order terms alone make a sphere to O(u⁶).
  [[nodiscard]] Height rolled_height(double u, double v) const;
  [[nodiscard]] double rolled_z(double u, double v) const;  ///< z of `rolled_height` alone
  /// Normal and principal curvatures at the vertex, exact for the polynomial.
  [[nodiscard]] VertexCurvature curvature() const;
};

/// Which terms of a patch are fitted; the others are zero. Umbilic: c2 = c4, a sphere.
enum class PatchDegree { umbilic, quadratic, cubic };

/// The patch of the scaled surface: its terms of degree d are divided by s^(d − 1), s the factor.
[[nodiscard]] HeightPatch scaled(const HeightPatch& patch, const Dilation& dilation);

/// Orthonormal frame with third axis n; continuous but for a half-line of n.
[[nodiscard]] HeightPatch flat_patch(const Vec3& x, const Vec3& n);

/// Least-squares patch of the points around the vertex of `frame`, weighted by 1/(squared
/// distance). So what counts is the slope each point is missed by. (Steeper weights lower the
/// truncation error a little, but fits then amplify the noise of coarse surfaces.) Empty when the
/// points do not determine it: fewer than unknowns, or near singular.
[[nodiscard]] std::optional<HeightPatch> fit_patch(const HeightPatch& frame,
                                                   std::span<const Vec3> points,
                                                   PatchDegree degree);

/// Points d = p − x moved away from the axis of the frame to the distance |d| at equal height. A
/// circle of curvature k has z = −½k|d|² exactly, so that it becomes a parabola. Fits of unrolled
/// points are free of the error O(h²) that a paraboloid makes on a sphere.
void unroll(std::span<const Vec3> points, const HeightPatch& frame, std::vector<Vec3>& unrolled);

}  // namespace meniscus
