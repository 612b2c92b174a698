#pragma once

#include <functional>
#include <random>
#include <vector>

#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus::test {

/// A smooth closed surface known twice over: as the zero level of a function, negative inside, and
/// as a fine triangulation with its vertices on it.
struct SmoothShape {
  std::function<double(const Vec3& x)> level;
  SurfaceMesh mesh;
};

/// r = 1 + Σ_k a_k P_lk(d_k · x/|x|): spherical harmonics of degrees 2 to 5, each a Legendre
/// polynomial about a random axis; the sum of all |a_k| is `amplitude`.
[[nodiscard]] SmoothShape random_star(std::mt19937& random, int num_vertices, double amplitude);
/// Two to four capsules end to end in random directions, of random radii, joined by the smooth
/// least −log Σ exp(−b d_k)/b of their distances d_k.
[[nodiscard]] SmoothShape random_chain(std::mt19937& random, int num_vertices);
/// The shape with every face of its mesh parted into four, the new vertices on the level.
[[nodiscard]] SmoothShape refined(const SmoothShape& shape);
/// The shape under x → map·x + shift.
[[nodiscard]] SmoothShape affine_image(const SmoothShape& shape, const Mat3& map,
                                       const Vec3& shift);

/// ⟨κ⟩² = (k1² + k2²)/2 at the vertices of the shape's mesh, from the gradient and the second
/// derivatives of the level (central differences, relative error about 1e-6).
class LevelCurvature {
 public:
  explicit LevelCurvature(const SmoothShape& shape);
  /// ⟨κ⟩² at the vertices when the surface has undergone the linear map.
  [[nodiscard]] VertexField<double> squared_rms(const Mat3& map) const;

 private:
  VertexField<Vec3> gradient_;
  VertexField<Mat3> hessian_;
};

/// Area of the smooth surface at each vertex, a third of each face's, which is that of the flat
/// face times 1 + Σ|Δn|²/24 (the sum over its edges; a sphere to fourth order).
[[nodiscard]] VertexField<double> smooth_vertex_areas(const SurfaceMesh& mesh);

}  // namespace meniscus::test
