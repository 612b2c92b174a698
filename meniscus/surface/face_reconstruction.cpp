#include "meniscus/surface/face_reconstruction.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/QR>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {
namespace {

/// The three faces across the edges of each face.
FaceField<std::array<FaceId, 3>> neighbours(const SurfaceMesh& mesh,
                                            const SurfaceTopology& topology) {
  FaceField<std::array<FaceId, 3>> result(mesh.num_faces());
  FaceField<std::size_t> count(mesh.num_faces(), 0);
  const auto add = [&](FaceId f, FaceId g) {
    MENISCUS_ASSERT(count[f] < 3, "face {} has more than three neighbours", f.value);
    result[f][count[f]++] = g;
  };
  for (const SurfaceEdge& e : topology.edges()) {
    add(e.left, e.right);
    add(e.right, e.left);
  }
  return result;
}

Vec3 face_center(const SurfaceMesh& mesh, FaceId f) {
  const FaceVertices& v = mesh.faces[f];
  return (mesh.x[v[0]] + mesh.x[v[1]] + mesh.x[v[2]]) / 3.0;
}

/// g in the plane of a face minimising Σ_k w_k (g·d_k − u_k + u)², w_k = 1/|d_k|², and d_k the way
/// to the centre of neighbour k. That is turned into the plane of the face nearly about the common
/// edge, at its own length.
Vec3 fitted_gradient(const SurfaceMesh& mesh, FaceId f, const std::array<FaceId, 3>& beside,
                     const FaceField<double>& values) {
  const Vec3 here = face_center(mesh, f), normal = face_area_vector(mesh, f).normalized();
  Eigen::Matrix<double, 4, 3> rows;
  Eigen::Vector4d right;
  for (int k = 0; k < 3; ++k) {
    const FaceId g = beside[static_cast<std::size_t>(k)];
    const Vec3 d = face_center(mesh, g) - here;
    const Vec3 flat = d - d.dot(normal) * normal;
    rows.row(k) = flat.normalized();
    right[k] = (values[g] - values[f]) / d.norm();
  }
  rows.row(3) = normal;  // no slope along it
  right[3] = 0.0;
  return rows.completeOrthogonalDecomposition().solve(right);
}

}  // namespace

FaceReconstruction::FaceReconstruction(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                                       const FaceField<double>& values)
    : faces_(values.size()) {
  MENISCUS_ASSERT(values.size() == mesh.num_faces(), "{} values for {} faces", values.size(),
                  mesh.num_faces());
  const auto beside = neighbours(mesh, topology);
  for (const FaceId f : values.ids()) {
    Linear& face = faces_[f];
    face = {values[f], values[f], values[f], Vec3::Zero(), face_center(mesh, f)};
    for (const VertexId v : mesh.faces[f])
      for (const FaceId g : topology.faces_around(v)) {
        face.low = std::min(face.low, values[g]);
        face.high = std::max(face.high, values[g]);
      }
    const Vec3 gradient = fitted_gradient(mesh, f, beside[f], values);
    // Cut off at the range instead, the function would no longer have the mean.
    double factor = 1.0;
    for (const VertexId v : mesh.faces[f]) {
      const double rise = gradient.dot(mesh.x[v] - face.center);
      const double room = rise > 0.0 ? face.high - face.mean : face.low - face.mean;
      if (std::abs(rise) > std::abs(room)) factor = std::min(factor, room / rise);
    }
    face.gradient = factor * gradient;
  }
}

double FaceReconstruction::value(FaceId f, const Vec3& x) const {
  return std::clamp(unclamped_value(f, x), faces_[f].low, faces_[f].high);
}

}  // namespace meniscus
