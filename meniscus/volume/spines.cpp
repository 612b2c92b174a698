#include "meniscus/volume/spines.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

#include "meniscus/core/error.hpp"
#include "meniscus/geometry/predicates.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {
namespace {

/// Whether every face shows its inner side to the centre.
bool is_star_shaped(const SurfaceMesh& mesh, const Vec3& center) {
  return std::ranges::all_of(mesh.faces, [&](const FaceVertices& v) {
    return orientation(center, mesh.x[v[0]], mesh.x[v[1]], mesh.x[v[2]]) > 0;
  });
}

}  // namespace

StarSurface::StarSurface(const SurfaceMesh& mesh, const Vec3& center)
    : mesh_(mesh), center_(center), is_star_shaped_(meniscus::is_star_shaped(mesh, center)) {
  if (!is_star_shaped_) return;
  for (const FaceVertices& v : mesh.faces) {
    Cone cone;
    for (std::size_t k = 0; k < 3; ++k)
      cone.normals[k] = (mesh.x[v[k]] - center).cross(mesh.x[v[(k + 1) % 3]] - center);
    cones_.add(cone);
  }
  const auto set_across = [&](FaceId f, VertexId from, FaceId other) {
    for (std::size_t k = 0; k < 3; ++k)
      if (mesh.faces[f][k] == from) cones_[f].across[k] = other;
  };
  const SurfaceTopology topology(mesh);
  for (const SurfaceEdge& edge : topology.edges()) {
    set_across(edge.left, edge.a, edge.right);
    set_across(edge.right, edge.b, edge.left);
  }
}

/// Walks may go round in circles on some triangulations: then all faces are looked at.
FaceId StarSurface::face_on_ray(const Vec3& direction) const {
  const auto lowest_side = [&](FaceId f) {
    const std::array<Vec3, 3>& n = cones_[f].normals;
    const Vec3 sides(direction.dot(n[0]), direction.dot(n[1]), direction.dot(n[2]));
    Eigen::Index k = 0;
    const double side = sides.minCoeff(&k);
    return std::pair(side, static_cast<std::size_t>(k));
  };
  FaceId face = last_;
  for (std::int32_t step = 0; step < mesh_.num_faces(); ++step) {
    const auto [side, k] = lowest_side(face);
    if (side >= 0.0) return face;
    face = cones_[face].across[k];
  }
  double best = -std::numeric_limits<double>::infinity();
  for (const FaceId f : mesh_.faces.ids())
    if (const double side = lowest_side(f).first; side > best) {
      best = side;
      face = f;
    }
  return face;
}

std::optional<StarSurface::Hit> StarSurface::hit(const Vec3& direction) const {
  MENISCUS_ASSERT(is_star_shaped_, "rays that meet a surface more than once");
  last_ = face_on_ray(direction);
  const FaceVertices& v = mesh_.faces[last_];
  const auto at = intersect_ray({mesh_.x[v[0]], mesh_.x[v[1]], mesh_.x[v[2]]}, center_, direction);
  if (!at) return {};  // an edge seen from the centre, within roundoff
  return Hit{v, at->weights, at->t};
}

Spines::Spines(const SurfaceMesh& drop, const SurfaceMesh& boundary)
    : center_(enclosed_centroid(drop)), drop_(drop, center_), boundary_(boundary, center_) {}

Spine Spines::through(const Vec3& x) const {
  MENISCUS_ASSERT(exist(), "a surface that is not star-shaped");
  const Spine at_rest{{VertexId{0}, VertexId{0}, VertexId{0}}};
  const double r = (x - center_).norm();
  if (r == 0.0) return at_rest;
  const Vec3 direction = (x - center_) / r;
  const auto at_drop = drop_.hit(direction);
  if (!at_drop) return at_rest;
  const double a = at_drop->distance;
  if (r <= a) return {at_drop->corners, r / a * at_drop->weights};
  const auto at_boundary = boundary_.hit(direction);
  if (!at_boundary || r >= at_boundary->distance) return at_rest;
  return {at_drop->corners,
          (at_boundary->distance - r) / (at_boundary->distance - a) * at_drop->weights};
}

}  // namespace meniscus
