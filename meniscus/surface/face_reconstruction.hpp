#pragma once

#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus {

/// A field of means over faces as a linear function on each face, which keeps the mean [barth1989].
/// It is fitted to the three faces across its edges. It is flattened until the corners of the face
/// lie in the range of all faces that share a vertex with it. Exact to second order.
class FaceReconstruction {
 public:
  FaceReconstruction(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                     const FaceField<double>& values);

  /// The value of the function of a face at a point near it.
  [[nodiscard]] double unclamped_value(FaceId f, const Vec3& x) const {
    return faces_[f].mean + faces_[f].gradient.dot(x - faces_[f].center);
  }
  /// The value at x, kept in the range of the face.
  [[nodiscard]] double value(FaceId f, const Vec3& x) const;

 private:
  struct Linear {
    double mean = 0.0, low = 0.0, high = 0.0;
    Vec3 gradient = Vec3::Zero(), center = Vec3::Zero();
  };
  FaceField<Linear> faces_;
};

}  // namespace meniscus
