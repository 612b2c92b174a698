#pragma once

#include <array>
#include <vector>

#include <Eigen/SparseCore>

#include "meniscus/geometry/quadrature.hpp"
#include "meniscus/surface/reconstructed_surface.hpp"

namespace meniscus {

/// A closed surface that carries functions given at its vertices, and the points at which their
/// integrals are taken. A face, flat or quadratic, has six nodes, its corners and the middles of
/// its edges, between which a function is quadratic. At a middle it has the value of
/// `edge_stencils`, a sum over the vertices around both ends. A smooth function is met to O(h³) at
/// least, a constant to round-off.
class CarrierSurface {
 public:
  /// The mesh has to outlive it and to stay as it is.
  CarrierSurface(const SurfaceMesh& mesh, SurfaceShape shape);

  struct Point {
    std::array<double, kQuadraticNodes> value{};   ///< ψ of the nodes
    std::array<Vec3, kQuadraticNodes> gradient{};  ///< ∇_s ψ [1/R0]
    double area = 0.0;                             ///< dS [R0²]
  };
  using Points = std::array<Point, kTriangleRule4.size()>;
  [[nodiscard]] Points points(FaceId f) const;
  [[nodiscard]] const SurfaceMesh& mesh() const { return mesh_; }

  using NodeMatrix = Eigen::Matrix<double, kQuadraticNodes, kQuadraticNodes>;
  /// ∫ψ_a ψ_b dS of every face [R0²].
  [[nodiscard]] FaceField<NodeMatrix> masses() const;
  /// The matrix over the vertices that sums those of the faces over their nodes: EᵀAE. Ef are the
  /// values at all nodes of a function with the values f at the vertices.
  [[nodiscard]] Eigen::SparseMatrix<double> assembled(const FaceField<NodeMatrix>& of_faces) const;
  /// The nodes of a face: its corners, then the middles of its edges 01, 12, 20. Vertices come
  /// first, in their order, then the edges in that of the topology.
  using FaceNodes = std::array<int, kQuadraticNodes>;
  [[nodiscard]] const FaceNodes& nodes(FaceId f) const { return nodes_[f]; }
  /// E.
  using Interpolation = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  [[nodiscard]] const Interpolation& interpolation() const { return at_nodes_; }

 private:
  [[nodiscard]] TriangleTangents tangents_at(FaceId f,
                                             const TriangleShape<kQuadraticNodes>& shape) const;
  /// dS at a point of the rule.
  [[nodiscard]] double area_at(FaceId f, std::size_t q) const;

  const SurfaceMesh& mesh_;
  ReconstructedSurface surface_;
  FaceField<FaceNodes> nodes_;
  Interpolation at_nodes_;
};

}  // namespace meniscus
