#pragma once

#include <array>
#include <vector>

#include "meniscus/geometry/quadrature.hpp"
#include "meniscus/surface/reconstructed_surface.hpp"

namespace meniscus {

/// A surface that carries what is linear between its vertices, on flat faces or on quadratic ones:
/// the points at which its integrals are taken.
class CarrierSurface {
 public:
  /// The mesh has to outlive it and to stay as it is.
  CarrierSurface(const SurfaceMesh& mesh, SurfaceShape shape);

  struct Point {
    std::array<double, 3> value{};   ///< φ of the three corners
    std::array<Vec3, 3> gradient{};  ///< ∇_s φ [1/R0]
    double area = 0.0;               ///< dS [R0²]
  };
  using Points = std::array<Point, kTriangleRule4.size()>;
  [[nodiscard]] Points points(FaceId f) const;
  [[nodiscard]] const SurfaceMesh& mesh() const { return mesh_; }

 private:
  const SurfaceMesh& mesh_;
  ReconstructedSurface surface_;
};

}  // namespace meniscus
