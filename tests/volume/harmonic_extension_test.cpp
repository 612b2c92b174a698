#include "meniscus/volume/harmonic_extension.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "meniscus/volume/motion.hpp"
#include "meniscus/volume/tetrahedralize.hpp"
#include "tests/volume/scenes.hpp"

namespace meniscus {
namespace {

Scene two_drops(int vertices) {
  Scene scene = test::scene_within(sphere(vertices, 6.0));
  for (const double side : {-1.3, 1.3})
    test::add_drop(scene, sphere(vertices, 1.0, Vec3(side, 0, 0)));
  return scene;
}

TetMesh mesh_of(const Scene& scene) {
  TetMesh mesh;
  const VolumeMeshReport made = tetrahedralize(scene, {}, mesh);
  EXPECT_TRUE(made.ok()) << made.text();
  return mesh;
}

TetVertexId first_free(const TetMesh& mesh) {
  return {mesh.boundary.first_vertex.value + mesh.boundary.num_vertices};
}

/// A smooth field on the surfaces, zero between.
Field<TetVertexId, Vec3> data_on_surfaces(const TetMesh& mesh) {
  Field<TetVertexId, Vec3> w(mesh.num_vertices(), Vec3::Zero());
  for (TetVertexId v{0}; v < first_free(mesh); ++v.value)
    w[v] = Vec3(mesh.x[v].y(), std::sin(3.0 * mesh.x[v].x()), 1.0);
  return w;
}

int iterations(int vertices) {
  const TetMesh mesh = mesh_of(two_drops(vertices));
  Field<TetVertexId, Vec3> w = data_on_surfaces(mesh);
  return HarmonicExtension(HarmonicPattern(mesh, first_free(mesh)), mesh).extend(w);
}

TEST(HarmonicExtension, TakesAsManyIterationsOnFineMeshesAsOnCoarse) {
  // Twenty times the vertices. Jacobi's preconditioner would take 2.7 times the iterations.
  EXPECT_LT(iterations(1500), 1.6 * iterations(75));
}

TEST(HarmonicExtension, IsTheDataWhereTheyAreUniform) {
  const TetMesh mesh = mesh_of(two_drops(100));
  Field<TetVertexId, Vec3> w = data_on_surfaces(mesh);
  const Vec3 u(0.5, -2.0, 3.0);
  for (TetVertexId v{0}; v < first_free(mesh); ++v.value) w[v] = u;
  HarmonicExtension(HarmonicPattern(mesh, first_free(mesh)), mesh).extend(w);
  // The solver's tolerance times the square root of the conditioning, some hundreds.
  for (const Vec3& each : w) EXPECT_LT((each - u).norm(), 1e-3);
}

/// Two moves of a step, of which the first leaves matrix and multigrid to the second, and the next
/// step's, to which the first's entries are left.
TEST(HarmonicExtension, KeptFromMoveToMoveGivesTheSameBits) {
  const Scene scene = two_drops(80);
  TetMesh mesh = mesh_of(scene);
  const auto motion = [&](double frequency) {
    std::vector<VertexField<Vec3>> result;
    for (const Interface& interface : scene.interfaces) {
      result.emplace_back(interface.mesh.num_vertices());
      for (const VertexId v : interface.mesh.x.ids())
        result.back()[v] = Vec3(std::sin(frequency * interface.mesh.x[v].y()), 0.2, 0.0);
    }
    return result;
  };
  VolumeMover kept(VolumeMotion::harmonic);
  for (const int step : {0, 1}) {
    for (const double frequency : {1.0, 2.0}) {
      VolumeMover fresh(VolumeMotion::harmonic);
      EXPECT_EQ(kept.velocity(scene, mesh, motion(frequency), {}),
                fresh.velocity(scene, mesh, motion(frequency), {}))
          << "step " << step;
    }
    const Field<TetVertexId, Vec3> w = kept.velocity(scene, mesh, motion(1.0), {});
    for (const TetVertexId v : mesh.x.ids()) mesh.x[v] += 1e-2 * w[v];
    kept.forget_positions();
  }
}

}  // namespace
}  // namespace meniscus
