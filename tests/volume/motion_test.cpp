#include "meniscus/volume/motion.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/volume/tetrahedralize.hpp"
#include "tests/volume/scenes.hpp"

namespace meniscus {
namespace {

struct Meshed {
  Scene scene;
  TetMesh mesh;
};

Meshed meshed(Scene scene) {
  Meshed result{std::move(scene), {}};
  const VolumeMeshReport report = tetrahedralize(result.scene, {}, result.mesh);
  EXPECT_TRUE(report.ok()) << report.text();
  return result;
}

std::vector<VertexField<Vec3>> motion_of(const Scene& scene, auto&& velocity) {
  std::vector<VertexField<Vec3>> motion;
  for (const Interface& interface : scene.interfaces) {
    VertexField<Vec3> w;
    for (const Vec3& x : interface.mesh.x) w.add(velocity(x));
    motion.push_back(std::move(w));
  }
  return motion;
}

Field<TetVertexId, Vec3> fluid_of(const TetMesh& mesh, auto&& velocity) {
  Field<TetVertexId, Vec3> fluid;
  for (const Vec3& x : mesh.x) fluid.add(velocity(x));
  return fluid;
}

/// Interface vertices move as told, those of the outer boundary not at all: exactly.
void expect_exact_on_surfaces(const Meshed& m, const std::vector<VertexField<Vec3>>& motion,
                              const Field<TetVertexId, Vec3>& velocity) {
  for (std::size_t i = 0; i < motion.size(); ++i)
    for (const VertexId v : motion[i].ids())
      EXPECT_EQ(velocity[m.mesh.interfaces[i].vertex(v)], motion[i][v]);
  for (std::int32_t v = 0; v < m.mesh.boundary.num_vertices; ++v)
    EXPECT_EQ(velocity[m.mesh.boundary.vertex(VertexId{v})], Vec3(Vec3::Zero()));
}

Field<TetVertexId, Vec3> volume_velocity(const Scene& scene, const TetMesh& mesh,
                                         const std::vector<VertexField<Vec3>>& interface_motion,
                                         const Field<TetVertexId, Vec3>& fluid,
                                         VolumeMotion motion) {
  return VolumeMover(motion).velocity(scene, mesh, interface_motion, fluid);
}

double smallest_volume_after(const TetMesh& mesh, const Field<TetVertexId, Vec3>& velocity,
                             double dt) {
  TetMesh moved = mesh;
  for (const TetVertexId v : moved.x.ids()) moved.x[v] += dt * velocity[v];
  double least = 1.0;
  for (const CellId c : moved.cells.ids()) least = std::min(least, signed_volume(moved, c));
  return least;
}

TEST(Spines, DecayLinearlyAlongRays) {
  const Meshed m = meshed(test::drop_in_sphere(200, 5.0, 150));
  const auto radial = [](const Vec3& x) -> Vec3 { return x; };
  const auto motion = motion_of(m.scene, radial);
  const Field<TetVertexId, Vec3> velocity =
      volume_velocity(m.scene, m.mesh, motion, fluid_of(m.mesh, radial), VolumeMotion::spines);
  expect_exact_on_surfaces(m, motion, velocity);
  // The drop's motion is x on its flat faces too, so w is x inside, to the offset of the centroid
  // (~1e-3 on this drop); outside, along a ray that leaves the drop at a and ends at b,
  // (b − r)/(b − a) a, where a and b are those of the facets, a little below 1 and 5.
  const Vec3 center = enclosed_centroid(m.scene.interfaces[0].mesh);
  const std::int32_t first = m.mesh.boundary.first_vertex.value + m.mesh.boundary.num_vertices;
  int outside = 0;
  for (std::int32_t i = first; i < m.mesh.num_vertices(); ++i) {
    const TetVertexId v{i};
    const double r = (m.mesh.x[v] - center).norm(), w = velocity[v].norm();
    if (r < 0.9) {
      EXPECT_NEAR((velocity[v] - m.mesh.x[v]).norm(), 0.0, 2.0 * center.norm() + 1e-12);
      continue;
    }
    // Facets: the drop's lie within 2 % of its radius, the boundary's within 4 % of its.
    EXPECT_NEAR(w, (5.0 - r) / 4.0, 0.06);
    ++outside;
  }
  EXPECT_GT(outside, 100);
}

TEST(Spines, AreExactForATranslationBetweenBoxes) {
  // Between a small box and a box of twice its size about the same centre, the ray's ends are at
  // a = r/m and b = 2 r/m, m the largest coordinate of x over the small box's half-width: the
  // fraction is (2 − m) outside and m inside.
  Scene scene = test::scene_within(box(150, Vec3::Constant(2.0)).mesh);
  test::add_drop(scene, box(98, Vec3::Constant(1.0)).mesh);
  const Meshed m = meshed(std::move(scene));
  const Vec3 u(0.3, -1.0, 2.0);
  const auto motion = motion_of(m.scene, [&](const Vec3&) { return u; });
  const Field<TetVertexId, Vec3> velocity =
      volume_velocity(m.scene, m.mesh, motion, {}, VolumeMotion::spines);
  expect_exact_on_surfaces(m, motion, velocity);
  for (const TetVertexId v : m.mesh.x.ids()) {
    const double reach = m.mesh.x[v].cwiseAbs().maxCoeff();
    const Vec3 expected = (reach < 1.0 ? reach : 2.0 - reach) * u;
    EXPECT_LT((velocity[v] - expected).norm(), 1e-12);
  }
}

TEST(VolumeMotion, KeepsCellsPositiveUnderExpansionAndTranslation) {
  std::mt19937 random(3);
  Scene ellipsoid = test::scene_within(box(150, Vec3(5.0, 4.0, 4.0)).mesh);
  test::add_drop(ellipsoid, test::random_ellipsoid(random, 150, Vec3(0.3, 0.0, 0.0)));
  const Meshed m = meshed(std::move(ellipsoid));
  const double step = 0.5 * shortest_edge(m.scene.interfaces[0].mesh);
  for (const VolumeMotion kind : {VolumeMotion::spines, VolumeMotion::harmonic})
    for (const bool translate : {false, true}) {
      const auto motion = motion_of(m.scene, [&](const Vec3& x) -> Vec3 {
        return translate ? Vec3(0.6, 0.8, 0.0) : Vec3(x.normalized());
      });
      const Field<TetVertexId, Vec3> velocity = volume_velocity(m.scene, m.mesh, motion, {}, kind);
      expect_exact_on_surfaces(m, motion, velocity);
      EXPECT_GT(smallest_volume_after(m.mesh, velocity, step), 0.0);
    }
}

TEST(VolumeMotion, KeepsHarmonicExtensionsBetweenTheirData) {
  // Data u on the drop and zero on the boundary: the extension is a part between 0 and 1 of u, and
  // u itself inside the drop, where the surface is all the boundary there is.
  const Meshed m = meshed(test::drop_in_sphere(150, 4.0, 120));
  const Vec3 u(1.0, 0.0, -2.0);
  const auto motion = motion_of(m.scene, [&](const Vec3&) { return u; });
  const Field<TetVertexId, Vec3> velocity =
      volume_velocity(m.scene, m.mesh, motion, {}, VolumeMotion::harmonic);
  expect_exact_on_surfaces(m, motion, velocity);
  for (const TetVertexId v : m.mesh.x.ids()) {
    const double part = velocity[v].dot(u) / u.squaredNorm();
    // A discrete maximum principle can fail at obtuse cells; 2 % is ample for these.
    EXPECT_GT(part, -0.02);
    EXPECT_LT(part, 1.02);
    EXPECT_LT((velocity[v] - part * u).norm(), 1e-4);
    if (m.mesh.x[v].norm() < 0.9) {
      EXPECT_NEAR(part, 1.0, 1e-4);
    }
  }
}

/// Σ_K |K|⁻¹ ∫_K |∇w|² over the cells around a vertex, the gradient from differences along edges.
double energy_around(const TetMesh& mesh, const Field<TetVertexId, Vec3>& w, TetVertexId v) {
  double energy = 0.0;
  for (const CellVertices& cell : mesh.cells) {
    if (std::ranges::find(cell, v) == cell.end()) continue;
    Mat3 edges, differences;
    for (int k = 0; k < 3; ++k) {
      const TetVertexId end = cell[static_cast<std::size_t>(k) + 1];
      edges.row(k) = mesh.x[end] - mesh.x[cell[0]];
      differences.row(k) = w[end] - w[cell[0]];
    }
    energy += (edges.inverse() * differences).squaredNorm();
  }
  return energy;
}

TEST(VolumeMotion, MinimisesTheWeightedEnergy) {
  const Meshed m = meshed(test::drop_in_sphere(100, 4.0, 80));
  const auto motion = motion_of(m.scene, [](const Vec3& x) { return Vec3(x.y(), 0.0, x.x()); });
  Field<TetVertexId, Vec3> velocity =
      volume_velocity(m.scene, m.mesh, motion, {}, VolumeMotion::harmonic);
  const std::int32_t first = m.mesh.boundary.first_vertex.value + m.mesh.boundary.num_vertices;
  for (std::int32_t i = first; i < m.mesh.num_vertices(); i += 37) {
    Vec3& w = velocity[TetVertexId{i}];
    const double least = energy_around(m.mesh, velocity, TetVertexId{i});
    // A quadratic's minimum is half-way between two points of equal energy.
    w.x() += 0.5;
    const double more = energy_around(m.mesh, velocity, TetVertexId{i});
    w.x() -= 1.0;
    const double less = energy_around(m.mesh, velocity, TetVertexId{i});
    w.x() += 0.5;
    EXPECT_GT(std::min(more, less), least);
    // Its distance from the minimum, in units of the drop's motion: the solver's tolerance 1e-6
    // times the square root of the conditioning, some hundreds.
    EXPECT_NEAR(0.25 * (more - less) / (more + less - 2.0 * least), 0.0, 1e-3);
  }
}

TEST(VolumeMotion, ReplacesSpinesWhereTheyDoNotExist) {
  Scene dumbbell = test::scene_within(box(150, Vec3(6.0, 4.0, 4.0)).mesh);
  test::add_drop(dumbbell, test::dumbbell(300));
  Scene two = test::scene_within(sphere(120, 5.0));
  test::add_drop(two, sphere(80, 1.0, Vec3(1.5, 0.0, 0.0)));
  test::add_drop(two, sphere(80, 1.0, Vec3(-1.5, 0.0, 0.0)));
  for (Scene* scene : {&dumbbell, &two}) {
    const Meshed m = meshed(*scene);
    const auto motion = motion_of(m.scene, [](const Vec3& x) { return Vec3(x.y(), 0.0, 0.0); });
    const Field<TetVertexId, Vec3> velocity =
        volume_velocity(m.scene, m.mesh, motion, {}, VolumeMotion::spines);
    EXPECT_EQ(velocity, volume_velocity(m.scene, m.mesh, motion, {}, VolumeMotion::harmonic));
    expect_exact_on_surfaces(m, motion, velocity);
    EXPECT_GT(smallest_volume_after(m.mesh, velocity, 0.02), 0.0);
  }
}

TEST(VolumeMotion, FollowsTheFluidButForTheSurfaces) {
  const Meshed m = meshed(test::drop_in_sphere(80, 4.0, 80));
  const auto flow = [](const Vec3& x) { return Vec3(x.y(), 0.0, 1.0); };
  const auto motion = motion_of(m.scene, [](const Vec3& x) -> Vec3 { return 0.5 * x; });
  const Field<TetVertexId, Vec3> velocity =
      volume_velocity(m.scene, m.mesh, motion, fluid_of(m.mesh, flow), VolumeMotion::lagrangian);
  expect_exact_on_surfaces(m, motion, velocity);
  const std::int32_t first = m.mesh.boundary.first_vertex.value + m.mesh.boundary.num_vertices;
  for (std::int32_t v = first; v < m.mesh.num_vertices(); ++v)
    EXPECT_EQ(velocity[TetVertexId{v}], flow(m.mesh.x[TetVertexId{v}]));
}

}  // namespace
}  // namespace meniscus
