#include "meniscus/flow/fem/surface_damping.hpp"

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/face_elements.hpp"

namespace meniscus::fem {
namespace {

void add_face(const DampedSurface& surface, const FacePoints& points, std::span<const NodeId> nodes,
              SurfaceDamping& damping) {
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      double integral = 0.0;
      for (const FacePoint& point : points)
        integral += point.area.norm() * (point.gradient[i].dot(point.gradient[j]) +
                                         surface.k * point.value[i] * point.value[j]);
      damping.entries.push_back({nodes[i], nodes[j], surface.strength * integral});
    }
}

}  // namespace

SurfaceDamping surface_damping(std::span<const DampedSurface> surfaces,
                               const NodePositions& positions) {
  SurfaceDamping damping{Field<NodeId, Vec3>(positions.x.size(), Vec3::Zero()),
                         Field<NodeId, double>(positions.x.size(), 0.0),
                         {}};
  for (const DampedSurface& surface : surfaces)
    for (const FaceId f : surface.faces.faces()) {
      const auto nodes = surface.faces.of(f);
      const FacePoints points = face_points(positions.x, nodes);
      for (const FacePoint& point : points)
        for (std::size_t i = 0; i < nodes.size(); ++i)
          damping.normal[nodes[i]] += point.value[i] * point.value[i] * point.area;
      if (surface.strength != 0.0) add_face(surface, points, nodes, damping);
    }
  for (Vec3& n : damping.normal)
    if (!n.isZero(0.0)) n.normalize();
  return damping;
}

Field<NodeId, double> normal_speeds(const SurfaceDamping& damping, const Field<NodeId, Vec3>& v) {
  MENISCUS_ASSERT(damping.normal.size() == v.size(), "{} {}", damping.normal.size(), v.size());
  Field<NodeId, double> speed(v.size(), 0.0);
  for (const NodeId i : v.ids()) speed[i] = damping.normal[i].dot(v[i]);
  return speed;
}

void add_resistance(const SurfaceDamping& damping, const Field<NodeId, Vec3>& v,
                    Field<NodeId, Vec3>& momentum) {
  for (const auto& [row, column, weight] : damping.entries)
    momentum[row] += weight * (damping.normal[column].dot(v[column]) - damping.speed[column]) *
                     damping.normal[row];
}

}  // namespace meniscus::fem
