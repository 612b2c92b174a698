#include "meniscus/case/concentrations.hpp"

#include <algorithm>
#include <span>

#include <fmt/format.h>

#include "meniscus/core/fault.hpp"

namespace meniscus {
namespace {

/// A linear function has its least value in a region at a vertex of what bounds the region.
void require_positive(const Case& c, double value, const Vec3& gradient,
                      std::span<const Vec3> vertices, const std::string& key) {
  if (gradient.isZero(0.0)) return;  // the reader of the case has looked at the value
  const auto at = [&](const Vec3& x) { return value + gradient.dot(x); };
  const Vec3& lowest = *std::ranges::min_element(vertices, {}, at);
  constexpr double kRoundoff = 1e-12;
  if (at(lowest) < -kRoundoff * (std::abs(value) + gradient.norm() * lowest.norm()))
    c.settings.reject(key, "makes a concentration of {:.4g} at {}: it must be at least 0",
                      at(lowest), text_of(lowest));
}

std::vector<Vec3> vertices_of(const OuterBoundary& boundary, PatchId patch) {
  std::vector<Vec3> vertices;
  for (const FaceId f : boundary.mesh.faces.ids())
    if (boundary.patch[f] == patch)
      for (const VertexId v : boundary.mesh.faces[f]) vertices.push_back(boundary.mesh.x[v]);
  return vertices;
}

/// The key of a condition in the case.
std::string key_of(const ScalarCase& scalar, const ScalarCondition& condition) {
  const auto found = std::ranges::find_if(
      scalar.patches, [&](const ScalarPatchCase& patch) { return patch.condition == condition; });
  return fmt::format("{}.patch[{}].gradient", scalar.path, found - scalar.patches.begin());
}

}  // namespace

void require_concentrations(const Case& c, const Scene& scene) {
  for (std::size_t k = 0; k < c.scalars.size(); ++k) {
    const ScalarCase& scalar = c.scalars[k];
    if (!scalar.scalar.is_species) continue;
    const auto require_initial = [&](const ScalarProfile& initial, std::span<const Vec3> around,
                                     const std::string& table) {
      require_positive(c, initial.value, initial.gradient, around, table + ".initial-gradient");
    };
    require_initial(scene.liquids[RegionId{0}].scalars[k].initial, scene.boundary.mesh.x.span(),
                    scalar.path);
    for (std::size_t i = 0; i < scene.interfaces.size(); ++i)
      require_initial(scene.liquids[scene.interfaces[i].inside].scalars[k].initial,
                      scene.interfaces[i].mesh.x.span(),
                      fmt::format("{}.drop[{}]", scalar.path, i));
    for (const PatchId id : scene.boundary.patches.ids()) {
      const ScalarCondition& condition = scene.boundary.patches[id].scalars[k];
      if (condition.kind == ScalarCondition::Kind::value && !condition.gradient.isZero(0.0))
        require_positive(c, condition.value, condition.gradient, vertices_of(scene.boundary, id),
                         key_of(scalar, condition));
    }
  }
}

}  // namespace meniscus
