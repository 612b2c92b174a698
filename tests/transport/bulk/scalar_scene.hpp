#pragma once

#include <memory>

#include <gtest/gtest.h>

#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/transport/bulk/finite_element_scalars.hpp"
#include "meniscus/transport/bulk/scalar_space.hpp"
#include "meniscus/volume/tetrahedralize.hpp"
#include "tests/flow/fem/sphere_scene.hpp"

namespace meniscus::bulk {

/// A sphere in a sphere with its tetrahedra and one scalar.
class ScalarScene {
 public:
  struct Options {
    fem::SphereScene spheres;
    fem::Elements elements = fem::Elements::p2_p1;
    double cell_volume = 0.0;  ///< of the volume mesh; 0: what suits the elements
    /// Whether cells grow from interfaces inwards, to a size in the middle that does not depend on
    /// N0; else they stay as long as the interface's edges.
    bool grows_inwards = true;
    Scalar scalar = {.name = "T"};
    ScalarLiquid matrix = {}, drop = {};
    ScalarCondition wall = {};
  };
  explicit ScalarScene(const Options& options)
      : scene(fem::sphere_in_sphere(options.spheres)),
        known(std::make_shared<fem::KnownElements>(options.elements)),
        solver(make_finite_element_scalars(known)) {
    scene.interfaces[0].volume = 4.0 / 3.0 * std::numbers::pi;
    scene.scalars = {options.scalar};
    scene.liquids[RegionId{0}].scalars = {options.matrix};
    scene.liquids[RegionId{1}].scalars = {options.drop};
    scene.boundary.patches[PatchId{0}].scalars = {options.wall};
    VolumeMeshOptions volume = fem::suited_volume_mesh(options.elements);
    if (options.cell_volume > 0.0) volume.cell_volume = options.cell_volume;
    if (!options.grows_inwards) volume.interior_growth = 0.0;
    const VolumeMeshReport report = tetrahedralize(scene, volume, mesh);
    EXPECT_TRUE(report.ok()) << report.text();
  }

  [[nodiscard]] FlowDomain domain(std::int64_t connectivity = 1) const {
    return {scene, &mesh, connectivity};
  }
  /// Where the nodes are.
  [[nodiscard]] NodePositions positions(fem::Elements elements) const {
    return fem::node_positions(scene, mesh, fem::flow_space(mesh, elements));
  }

  Scene scene;
  TetMesh mesh;
  std::shared_ptr<fem::KnownElements> known;
  std::unique_ptr<ScalarSolver> solver;
};

}  // namespace meniscus::bulk
