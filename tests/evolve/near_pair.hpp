#pragma once

#include <numbers>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/scene/scene.hpp"

namespace meniscus::test {

/// Two drops of 200 vertices a tenth of their radius apart, beside a wall of a sphere.
inline Scene near_pair() {
  Scene scene;
  scene.boundary.mesh = sphere(400, 4.0);
  scene.liquids.add(Liquid{});
  for (const int side : {0, 1}) {
    Interface drop;
    drop.drop = side;
    drop.mesh = sphere(200, 1.0, Vec3(side == 0 ? -1.05 : 1.05, 0, 0));
    drop.inside = RegionId{side + 1};
    drop.outside = RegionId{0};
    drop.C0 = 200 / (4.0 * std::numbers::pi);
    drop.volume = drop.initial_volume = enclosed_volume(drop.mesh);
    scene.interfaces.push_back(drop);
    scene.liquids.add(Liquid{});
  }
  return scene;
}

}  // namespace meniscus::test
