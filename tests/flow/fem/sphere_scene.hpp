#pragma once

#include <functional>
#include <numbers>
#include <string>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/tet_mesh.hpp"
#include "meniscus/scene/scene.hpp"
#include "meniscus/volume/tetrahedralize.hpp"

namespace meniscus::fem {

struct SphereScene {
  int num_vertices = 400;  ///< N0 on the drop
  double outer_radius = 10.0;
  double viscosity_ratio = 1.0;
  double Ca = 1.0;  ///< infinite: no tension
  /// Vertices on the outer sphere per vertex of the drop. 0.95 at a radius of 10 gives 5.4 thousand
  /// vertices in all at N0 = 400 and 15 thousand at 800.
  double outer_per_inner = 0.95;
  std::function<Vec3(const Vec3&, double)> outer_velocity = [](const Vec3&, double) {
    return Vec3(Vec3::Zero());
  };
  bool is_linear_flow = false;
  Vec3 drop_force = Vec3::Zero();
};

/// A drop of radius 1 at the centre of a spherical container.
inline Scene sphere_in_sphere(const SphereScene& options) {
  Scene scene;
  scene.Ca = options.Ca;
  scene.liquids = Field<RegionId, Liquid>(2, Liquid{});
  scene.liquids[RegionId{1}] = {.viscosity = options.viscosity_ratio,
                                .body_force = options.drop_force};
  Interface drop;
  drop.mesh = sphere(options.num_vertices);
  drop.inside = RegionId{1};
  drop.outside = RegionId{0};
  drop.tension = 1.0 / options.Ca;
  drop.C0 = options.num_vertices / (4.0 * std::numbers::pi);
  scene.interfaces.push_back(std::move(drop));
  scene.boundary.mesh = sphere(static_cast<int>(options.outer_per_inner * options.num_vertices),
                               options.outer_radius);
  scene.boundary.patch = FaceField<PatchId>(scene.boundary.mesh.num_faces(), PatchId{0});
  scene.boundary.patches.add(
      {"wall", ImposedVelocity{options.outer_velocity, options.is_linear_flow},
       [radius = options.outer_radius](const Vec3& x) { return Vec3(radius * x.normalized()); }});
  return scene;
}

}  // namespace meniscus::fem
