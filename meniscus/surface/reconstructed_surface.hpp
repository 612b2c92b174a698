#pragma once

#include <optional>
#include <span>
#include <vector>

#include "meniscus/geometry/quadratic_triangle.hpp"
#include "meniscus/surface/edge_middles.hpp"
#include "meniscus/surface/smooth_surface.hpp"

namespace meniscus {

/// The closed surface that an interface's vertices stand for, as made once for a mesh. It has flat
/// faces, or quadratic ones through the vertices and the `edge_middles`. Whoever asks it need not
/// know which. Flat faces enclose too little of a smooth surface by O(h²), quadratic ones by O(h⁴).
class ReconstructedSurface {
 public:
  ReconstructedSurface(const SurfaceMesh& mesh, SurfaceShape shape);
  /// With quadratic faces through the middles given, in the order of the topology.
  ReconstructedSurface(const SurfaceMesh& mesh, SurfaceTopology topology, SmoothSurface smooth,
                       std::vector<Vec3> middles, SurfaceShape shape);

  [[nodiscard]] double volume() const;  ///< enclosed [R0³]
  [[nodiscard]] double area() const;    ///< [R0²]
  [[nodiscard]] Vec3 centroid() const;  ///< of the enclosed volume [R0]
  /// ∫ (x − c)(x − c)ᵀ dV about the centroid c of the enclosed volume [R0⁵].
  [[nodiscard]] Mat3 second_moments() const;
  /// ∫ nn dS [R0²].
  [[nodiscard]] Mat3 normal_moment() const;
  /// ∫ σ(I − nn) dS of a tension given at the vertices [μ_out G R0³], interpolated as velocities.
  [[nodiscard]] Mat3 tension_moment(const VertexField<double>& tension) const;
  /// ∫ un dS of a velocity given at the vertices [G R0³], linear on flat faces and quadratic on
  /// others. There the middles of edges get u from the quadratics that fit it around both ends, to
  /// O(h³).
  [[nodiscard]] Mat3 velocity_moment(const VertexField<Vec3>& u) const;
  /// dS/dt for vertices that move with this velocity, ∫div_s u dS [G R0²]. It is exact for flat
  /// faces, with the velocity between vertices as above for others.
  [[nodiscard]] double area_rate(const VertexField<Vec3>& motion) const;
  /// ∫ σ div_s u dS of a tension and a velocity given at the vertices: the power that the liquid
  /// spends against tension [μ_out G² R0³].
  [[nodiscard]] double tension_power(const VertexField<double>& tension,
                                     const VertexField<Vec3>& u) const;

  /// The least and the largest value of a function given at the vertices, interpolated as
  /// velocities.
  struct ValueRange {
    double least = 0.0, most = 0.0;
  };
  [[nodiscard]] ValueRange range_of(const VertexField<double>& values) const;

  /// The quadratic faces, seen from the mean vertex; none with flat faces.
  [[nodiscard]] const FaceField<TriangleNodes<kQuadraticNodes>>& quadratic_faces() const {
    return faces_;
  }
  /// The smooth surface through the vertices; none with flat faces.
  [[nodiscard]] const std::optional<SmoothSurface>& smooth() const { return smooth_; }
  /// The edges and the points over their middles; none with flat faces.
  [[nodiscard]] const std::optional<SurfaceTopology>& topology() const { return topology_; }
  [[nodiscard]] std::span<const Vec3> middles() const { return middles_; }

  [[nodiscard]] const SurfaceMesh& mesh() const { return mesh_; }

  /// The surface of the scaled vertices, the same to round-off as one made for them.
  [[nodiscard]] ReconstructedSurface scaled(const Dilation& dilation) const;
  [[nodiscard]] SurfaceShape shape() const { return shape_; }

 private:
  [[nodiscard]] bool is_flat() const { return shape_ == SurfaceShape::faceted; }
  [[nodiscard]] Vec3 first_moment() const;
  /// Values at the nodes of every face, from those at the vertices.
  template <class Value>
  [[nodiscard]] FaceField<std::array<Value, kQuadraticNodes>> node_values(
      const VertexField<Value>& values) const;

  void make_faces();

  SurfaceMesh mesh_;
  SurfaceShape shape_;
  // Only with quadratic faces:
  std::optional<SurfaceTopology> topology_;
  std::optional<SmoothSurface> smooth_;
  std::vector<Vec3> middles_;
  FaceField<TriangleNodes<kQuadraticNodes>> faces_;  // seen from the mean vertex, for round-off
};

}  // namespace meniscus
