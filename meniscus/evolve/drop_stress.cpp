#include "meniscus/evolve/drop_stress.hpp"

#include "meniscus/core/error.hpp"
#include "meniscus/scene/interface_tension.hpp"

namespace meniscus {
namespace {

/// ∫ σ(I − nn − 2/3 I) dS.
Mat3 capillary_stress(const Interface& interface, const ReconstructedSurface& faces) {
  if (has_varying_tension(interface)) {
    const Mat3 moment = faces.tension_moment(vertex_tension(interface));
    return moment - moment.trace() / 3.0 * Mat3::Identity();
  }
  // With ∫ dS = tr ∫ nn dS.
  const Mat3 normals = faces.normal_moment();
  const Mat3 capillary = normals.trace() / 3.0 * Mat3::Identity() - normals;
  return interface.tension * capillary;
}

}  // namespace

Mat3 drop_stress(const Scene& scene, std::span<const VertexField<Vec3>> velocity,
                 const InterfaceSurfaces& faces, std::span<const Mat3> excess) {
  MENISCUS_ASSERT(velocity.size() == scene.interfaces.size(), "{} velocities of {} interfaces",
                  velocity.size(), scene.interfaces.size());
  Mat3 total = Mat3::Zero();
  double volume = 0.0;
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
    const Interface& interface = scene.interfaces[i];
    const double contrast =
        scene.liquids[interface.inside].viscosity - scene.liquids[interface.outside].viscosity;
    const Mat3 rates = faces[i]->velocity_moment(velocity[i]);
    total += capillary_stress(interface, *faces[i]) + contrast * (rates + rates.transpose());
    if (interface.outside == RegionId{0}) volume += faces[i]->volume();
  }
  for (std::size_t region = 1; region < excess.size(); ++region) total += excess[region];
  return volume > 0.0 ? Mat3(total / volume) : total;
}

}  // namespace meniscus
