#pragma once

#include <array>
#include <vector>

#include "meniscus/geometry/quadratic_triangle.hpp"
#include "meniscus/geometry/quadrature.hpp"
#include "meniscus/mesh/surface_mesh.hpp"
#include "meniscus/surface/edge_interpolation.hpp"

namespace meniscus::bem {

/// A function's values at the six nodes of a face.
using NodeValues = std::array<double, kQuadraticNodes>;
using NodeVectors = std::array<Vec3, kQuadraticNodes>;

/// An interface as its integrals see it: parabolic triangles through the vertices and through the
/// middles of the edges of the smooth surface. Functions on them are quadratic too. Their values at
/// the middles are interpolated from the vertices around. The unknowns remain values at vertices.
struct InterfaceElements {
  struct Face {
    TriangleNodes<kQuadraticNodes> nodes;
    /// The points of kTriangleRule5 on the face, and their vector areas n dS.
    struct Point {
      Vec3 x, area;
    };
    std::array<Point, kTriangleRule5.size()> points;
    NodeVectors area;  ///< ∫φ_a n dS of the six functions: ∫f n dS ≈ Σ_a area[a] f(x of node a)
    double size = 0.0;  ///< longest edge
  };
  FaceField<Face> faces;
  FaceField<FaceVertices> corners;
  FaceField<std::array<std::size_t, 3>> edges;  ///< by face, as its nodes 3 to 5
  std::vector<Stencil> middles;                 ///< by edge: a function's value there
  VertexField<Vec3> x, n;
  VertexField<double> kappa;   ///< k1 + k2
  VertexField<double> weight;  ///< ∮ f dS ≈ Σ_j weight_j f_j, the middles being interpolated
};

/// O(N): about 20 µs per vertex.
[[nodiscard]] InterfaceElements make_elements(const SurfaceMesh& mesh);

}  // namespace meniscus::bem
