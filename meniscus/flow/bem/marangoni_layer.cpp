#include "meniscus/flow/bem/marangoni_layer.hpp"

#include "meniscus/core/error.hpp"
#include "meniscus/flow/bem/face_moments.hpp"
#include "meniscus/flow/bem/face_rules.hpp"
#include "meniscus/flow/bem/near_faces.hpp"
#include "meniscus/scene/interface_tension.hpp"

namespace meniscus::bem {
namespace {

using Face = InterfaceElements::Face;

/// ∇_s σ at a point of a face.
Vec3 tension_gradient(const Face& face, const NodeValues& tension, const std::array<double, 3>& b) {
  const TriangleShape<kQuadraticNodes> shape = quadratic_shape(b);
  const TriangleGradients gradients = surface_gradients(tangents(shape, face.nodes));
  double by_1 = 0.0, by_2 = 0.0;
  for (std::size_t a = 0; a < tension.size(); ++a) {
    by_1 += shape.by_1[a] * tension[a];
    by_2 += shape.by_2[a] * tension[a];
  }
  return by_1 * gradients.g1 + by_2 * gradients.g2;
}

/// ∫∇_s σ dS of a face, shared out to its columns by the weights with which they give a function's
/// values on it.
std::vector<Vec3> column_forces(const Face& face, const NodeValues& tension) {
  std::vector<Vec3> forces(face.columns.size(), Vec3::Zero());
  for (std::size_t q = 0; q < face.points.size(); ++q) {
    const std::array<double, 3>& b = kTriangleRule5[q].barycentric;
    const Vec3 force = face.points[q].area.norm() * tension_gradient(face, tension, b);
    const std::vector<double> weights = value_weights(face, Vec3(b[0], b[1], b[2]));
    for (std::size_t c = 0; c < forces.size(); ++c) forces[c] += weights[c] * force;
  }
  return forces;
}

}  // namespace

MarangoniLayer::MarangoniLayer(const Scene& scene, const BoundaryGeometry& geometry)
    : geometry_(geometry),
      loads_(geometry.surfaces.size()),
      ones_(static_cast<std::size_t>(geometry.size()), 1.0) {
  SourceVectors sums(geometry.size());
  for (std::size_t m = 0; m < loads_.size(); ++m) {
    if (!scene.interfaces[m].surfactant) continue;
    const VertexField<double> tension = vertex_tension(scene.interfaces[m]);
    for (const Face& face : geometry.surfaces[m].elements.faces) {
      FaceLoad load{.tension = node_values(face, tension), .forces = {}};
      load.forces = column_forces(face, load.tension);
      for (std::size_t c = 0; c < face.columns.size(); ++c) {
        const std::int32_t j = geometry.index(m, face.columns[c]);
        sums.set(j, sums.at(j) + load.forces[c]);
      }
      loads_[m].add(std::move(load));
    }
  }
  for (std::int32_t j = 0; j < geometry.size(); ++j)
    forces_.add(geometry.points.point(j), sums.at(j));
}

Vec3 MarangoniLayer::operator()(std::int32_t i) const {
  Vec3 sum = single_layer_sum(forces_, ones_, geometry_.points.point(i));
  std::vector<FaceId> near;
  for (std::size_t m = 0; m < loads_.size(); ++m) {
    if (loads_[m].empty()) continue;
    find_near_faces(geometry_, m, i, near, NearReach::whole);
    for (const FaceId f : near) sum += near_part(m, f, i);
  }
  return sum;
}

/// The integral over a near face less what its forces gave.
Vec3 MarangoniLayer::near_part(std::size_t m, FaceId f, std::int32_t i) const {
  const Face& face = geometry_.surfaces[m].elements.faces[f];
  const FaceLoad& load = loads_[m][f];
  MENISCUS_ASSERT(load.forces.size() == face.columns.size(), "face {}", f.value);
  const Vec3 x = geometry_.points.point(i);
  Vec3 sum = Vec3::Zero();
  const auto add = [&](const std::array<double, 3>& b, const Vec3& y, const Vec3& area) {
    sum += single_layer_kernel(y - x, area.norm() * tension_gradient(face, load.tension, b));
  };
  visit_points(face, corner_at(geometry_, m, f, i), x, add);
  for (std::size_t c = 0; c < load.forces.size(); ++c) {
    const std::int32_t j = geometry_.index(m, face.columns[c]);
    if (j != i) sum -= single_layer_kernel(geometry_.points.point(j) - x, load.forces[c]);
  }
  return sum;
}

}  // namespace meniscus::bem
