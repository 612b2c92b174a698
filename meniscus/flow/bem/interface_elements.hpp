#pragma once

#include <array>
#include <vector>

#include "meniscus/geometry/quadratic_triangle.hpp"
#include "meniscus/geometry/quadrature.hpp"
#include "meniscus/mesh/surface_mesh.hpp"
#include "meniscus/surface/edge_interpolation.hpp"

namespace meniscus::bem {

/// An interface as its integrals see it: parabolic triangles through the vertices and through the
/// middles of the edges of the smooth surface. Functions on them are quadratic too. Their values at
/// the middles are interpolated from the vertices around. The unknowns remain values at vertices.
struct InterfaceElements {
  /// How a face reads vertex values: value at node a = Σ_c to_nodes(a, c) value[columns[c]].
  struct Face {
    TriangleNodes<kQuadraticNodes> nodes;
    std::vector<VertexId> columns;
    Eigen::Matrix<double, kQuadraticNodes, Eigen::Dynamic> to_nodes;
    /// The points of kTriangleRule5 on the face, and their vector areas n dS.
    struct Point {
      Vec3 x, area;
    };
    std::array<Point, kTriangleRule5.size()> points;
    std::vector<double> share;  ///< ∫_face f dS ≈ Σ_c share[c] f(x of columns[c])
    double size = 0.0;          ///< longest edge
  };
  FaceField<Face> faces;
  FaceField<FaceVertices> corners;
  FaceField<std::array<std::size_t, 3>> edges;  ///< by face, as its nodes 3 to 5
  std::vector<Stencil> middles;                 ///< by edge: a function's value there
  VertexField<Vec3> x, n;
  VertexField<double> kappa;   ///< k1 + k2
  VertexField<double> weight;  ///< Σ of the faces' shares: ∮ f dS ≈ Σ_j weight_j f_j
};

/// O(N): about 20 µs per vertex.
[[nodiscard]] InterfaceElements make_elements(const SurfaceMesh& mesh);

/// A function's values at the six nodes of a face.
using NodeValues = std::array<double, kQuadraticNodes>;
/// Those of a function with these values at the vertices.
[[nodiscard]] NodeValues node_values(const InterfaceElements::Face& face,
                                     const VertexField<double>& at_vertices);

/// Weights of the vertices columns[c] in the value at barycentric b of a face.
[[nodiscard]] std::vector<double> value_weights(const InterfaceElements::Face& face, const Vec3& b);

}  // namespace meniscus::bem
