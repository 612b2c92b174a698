#include "meniscus/flow/bem/marangoni_layer.hpp"

#include "meniscus/core/error.hpp"
#include "meniscus/flow/bem/face_moments.hpp"
#include "meniscus/flow/bem/face_rules.hpp"
#include "meniscus/flow/bem/near_faces.hpp"

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

/// ∫φ_a ∇_s σ dS at the nodes of a face.
NodeVectors node_forces(const Face& face, const NodeValues& tension) {
  NodeVectors forces;
  forces.fill(Vec3::Zero());
  for (std::size_t q = 0; q < face.points.size(); ++q) {
    const std::array<double, 3>& b = kTriangleRule5[q].barycentric;
    const Vec3 force = face.points[q].area.norm() * tension_gradient(face, tension, b);
    const NodeValues values = quadratic_values(b);
    for (std::size_t a = 0; a < forces.size(); ++a) forces[a] += values[a] * force;
  }
  return forces;
}

}  // namespace

MarangoniLayer::MarangoniLayer(const Scene& scene, const BoundaryGeometry& geometry)
    : geometry_(geometry), loads_(geometry.surfaces.size()), ones_(geometry.nodes.x.size(), 1.0) {
  SourceVectors sums(geometry.num_nodes());
  const std::vector<double> tension = geometry.at_nodes(tension_at_points(scene));
  for (std::size_t m = 0; m < loads_.size(); ++m) {
    if (!scene.interfaces[m].surfactant) continue;
    const InterfaceElements& elements = geometry.surfaces[m].elements;
    for (const FaceId f : elements.faces.ids()) {
      FaceLoad load{.tension = geometry.on_face(m, f, tension), .forces = {}};
      load.forces = node_forces(elements.faces[f], load.tension);
      const auto nodes = geometry.nodes_of(m, f);
      for (std::size_t a = 0; a < nodes.size(); ++a)
        sums.set(nodes[a], sums.at(nodes[a]) + load.forces[a]);
      loads_[m].add(load);
    }
  }
  for (std::int32_t j = 0; j < geometry.num_nodes(); ++j)
    forces_.add(geometry.nodes.point(j), sums.at(j));
}

Vec3 MarangoniLayer::operator()(std::int32_t i) const {
  Vec3 sum = single_layer_sum(forces_, ones_, geometry_.nodes.point(i));
  std::vector<FaceId> near;
  for (std::size_t m = 0; m < loads_.size(); ++m) {
    if (loads_[m].empty()) continue;
    find_near_faces(geometry_, m, i, near);
    for (const FaceId f : near) sum += near_part(m, f, i);
  }
  return sum;
}

/// The integral over a near face less what its forces gave.
Vec3 MarangoniLayer::near_part(std::size_t m, FaceId f, std::int32_t i) const {
  const Face& face = geometry_.surfaces[m].elements.faces[f];
  const FaceLoad& load = loads_[m][f];
  const Vec3 x = geometry_.nodes.point(i);
  Vec3 sum = Vec3::Zero();
  const auto add = [&](const std::array<double, 3>& b, const Vec3& y, const Vec3& area) {
    sum += single_layer_kernel(y - x, area.norm() * tension_gradient(face, load.tension, b));
  };
  visit_points(face, corner_at(geometry_, m, f, i), x, add);
  const auto nodes = geometry_.nodes_of(m, f);
  for (std::size_t a = 0; a < nodes.size(); ++a)
    if (nodes[a] != i)
      sum -= single_layer_kernel(geometry_.nodes.point(nodes[a]) - x, load.forces[a]);
  return sum;
}

}  // namespace meniscus::bem
