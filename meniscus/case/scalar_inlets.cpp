#include "meniscus/case/scalar_inlets.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {
namespace {

using Shape = DomainCase::Shape;

/// The vertices of a face and the middles of its edges.
std::array<Vec3, 6> nodes_of(const SurfaceMesh& mesh, FaceId f) {
  const FaceVertices& v = mesh.faces[f];
  const Vec3 &a = mesh.x[v[0]], &b = mesh.x[v[1]], &c = mesh.x[v[2]];
  return {a, b, c, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)};
}

/// The outward normal at a point of a face: of the smooth wall, where the shape has one.
Vec3 wall_normal(Shape shape, const Patch& patch, const Vec3& x, const Vec3& face_normal) {
  if (!patch.on_smooth_wall) return face_normal;
  return shape == Shape::cylinder ? Vec3(0.0, x.y(), x.z()).normalized() : x.normalized();
}

/// The patches through which the imposed velocity enters at t = 0.
std::vector<PatchId> inlets(const Case& c, const OuterBoundary& boundary) {
  Field<PatchId, double> inflow(boundary.patches.size(), 0.0);  // largest −v·n
  double fastest = 0.0;
  for (const FaceId f : boundary.mesh.faces.ids()) {
    const PatchId id = boundary.patch[f];
    const Patch& patch = boundary.patches[id];
    const auto* imposed = std::get_if<ImposedVelocity>(&patch.condition);
    if (imposed == nullptr) continue;
    const Vec3 face_normal = face_area_vector(boundary.mesh, f).normalized();
    for (const Vec3& x : nodes_of(boundary.mesh, f)) {
      const Vec3 v = imposed->velocity(x, 0.0);
      const Vec3 n = wall_normal(c.domain.shape, patch, x, face_normal);
      inflow[id] = std::max(inflow[id], -v.dot(n));
      fastest = std::max(fastest, v.norm());
    }
  }
  // Roundoff of doubles, and of single-precision coordinates in a file.
  const double roundoff = c.domain.shape == Shape::file ? 1e-6 : 1e-12;
  std::vector<PatchId> result;
  for (const PatchId id : boundary.patches.ids())
    if (inflow[id] > roundoff * fastest) result.push_back(id);
  return result;
}

}  // namespace

void require_values_at_inlets(const Case& c, const OuterBoundary& boundary) {
  if (c.scalars.empty()) return;
  const std::vector<PatchId> entered = inlets(c, boundary);
  for (std::size_t i = 0; i < c.scalars.size(); ++i) {
    if (!c.scalars[i].scalar.is_convected) continue;
    for (const PatchId id : entered)
      if (boundary.patches[id].scalars[i].kind != ScalarCondition::Kind::value)
        reject_input("{}: scalar \"{}\": patch \"{}\" needs a value: liquid enters there",
                     c.settings.source(c.scalars[i].path), c.scalars[i].scalar.name,
                     boundary.patches[id].name);
  }
}

}  // namespace meniscus
