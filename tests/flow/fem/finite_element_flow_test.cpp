#include "meniscus/flow/fem/finite_element_flow.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "tests/flow/fem/sphere_scene.hpp"

namespace meniscus::fem {
namespace {

Scene shear_scene(double outer_radius = 4.0) {
  Mat3 gradient = ImposedFlow::simple_shear();
  Scene scene = sphere_in_sphere(
      {.num_vertices = 110,
       .outer_radius = outer_radius,
       .viscosity_ratio = 2.0,
       .Ca = 0.4,
       .outer_velocity = [gradient](const Vec3& x, double) { return Vec3(gradient * x); },
       .is_linear_flow = true});
  scene.flow = ImposedFlow(FlowFamily::planar, gradient);
  return scene;
}

std::vector<VertexField<Vec3>> motion_of(const FlowSolver& flow) {
  return {flow.velocity().begin(), flow.velocity().end()};
}

void move(Scene& scene, const std::vector<VertexField<Vec3>>& motion, double dt) {
  for (std::size_t i = 0; i < motion.size(); ++i)
    for (const VertexId v : motion[i].ids()) scene.interfaces[i].mesh.x[v] += dt * motion[i][v];
}

TEST(FiniteElementFlow, WarmSecondStageTakesFewerIterations) {
  Scene scene = shear_scene();
  const auto flow = make_finite_element_flow({});
  ASSERT_TRUE(flow->rebuild(scene).ok);
  const FlowReport first = flow->solve(scene, 0.0);
  ASSERT_TRUE(first.ok) << first.failure;
  flow->mark(scene);
  const Scene start = scene;
  const auto motion = motion_of(*flow);
  move(scene, motion, 0.02);
  ASSERT_TRUE(flow->move_from_mark(start, motion, 0.02).ok);
  const FlowReport second = flow->solve(scene, 0.02);
  ASSERT_TRUE(second.ok) << second.failure;
  EXPECT_GT(second.iterations, 0);
  EXPECT_LT(second.iterations, first.iterations);
  for (const char* phase : {"tetrahedralize", "assemble", "solve", "move mesh"})
    EXPECT_GT(flow->times()[phase], 0.0) << phase;
}

/// The drop's velocity in an outer sphere, solved to a tolerance.
VertexField<Vec3> drop_velocity(const Scene& scene, double rtol) {
  Options options;
  options.rtol = rtol;
  const auto flow = make_finite_element_flow(options);
  EXPECT_TRUE(flow->rebuild(scene).ok);
  EXPECT_TRUE(flow->solve(scene, 0.0).ok);
  return flow->velocity()[0];
}

// The forces on a boundary far away, which grow with its distance squared, must not loosen it.
TEST(FiniteElementFlow, ToleranceDoesNotHangOnHowFarTheBoundaryIs) {
  for (const double outer_radius : {10.0, 100.0}) {
    const Scene scene = shear_scene(outer_radius);
    const VertexField<Vec3> loose = drop_velocity(scene, 1e-6), tight = drop_velocity(scene, 1e-11);
    double largest = 0.0;
    for (const VertexId v : tight.ids()) largest = std::max(largest, (loose[v] - tight[v]).norm());
    // Velocities near one. Relative to the residual at rest it would be 0.006 at 100 R0.
    EXPECT_LT(largest, 3e-4) << outer_radius;
  }
}

TEST(FiniteElementFlow, EnergyInIsDissipatedOrStoredInTheSurface) {
  const Scene scene = shear_scene();
  Options options;
  options.rtol = 1e-10;
  const auto flow = make_finite_element_flow(options);
  ASSERT_TRUE(flow->rebuild(scene).ok);
  ASSERT_TRUE(flow->solve(scene, 0.0).ok);
  const VertexField<Vec3> gradient = area_gradient(scene.interfaces[0].mesh);
  double growth = 0.0;
  for (const VertexId v : gradient.ids()) growth += gradient[v].dot(flow->velocity()[0][v]) / 0.4;
  const Power power = flow->power().value();
  EXPECT_NEAR(power.in - power.dissipation, growth, 1e-7 * power.in);
}

// A run that goes on and one that is restored from a checkpoint do the same arithmetic, whether the
// checkpoint falls between steps that make a preconditioner or keep one.
TEST(FiniteElementFlow, ARestoredSolverDoesTheSameArithmetic) {
  for (const auto& [elements, which] : {std::pair(Elements::p1_p1, LinearSolver::block),
                                        std::pair(Elements::p1_p1, LinearSolver::mumps),
                                        std::pair(Elements::p2_p1, LinearSolver::block)}) {
    Options options;
    options.elements = elements;
    options.linear = which;
    Scene scene = shear_scene();
    const auto flow = make_finite_element_flow(options);
    ASSERT_TRUE(flow->rebuild(scene).ok);
    ASSERT_TRUE(flow->solve(scene, 0.0).ok);
    for (int step = 1; step <= 3; ++step) {
      flow->mark(scene);
      const Scene start = scene;
      const auto motion = motion_of(*flow);
      move(scene, motion, 0.01);
      ASSERT_TRUE(flow->move_from_mark(start, motion, 0.01).ok);
      Archive archive;
      flow->save(archive);
      const auto restored = make_finite_element_flow(options);
      restored->load(archive, scene);
      const FlowReport straight = flow->solve(scene, 0.01 * step);
      const FlowReport resumed = restored->solve(scene, 0.01 * step);
      ASSERT_TRUE(straight.ok && resumed.ok);
      EXPECT_GT(straight.iterations, 0);
      EXPECT_EQ(straight.iterations, resumed.iterations);
      EXPECT_EQ(flow->velocity()[0], restored->velocity()[0]) << step;
      Archive a, b;
      flow->save(a);
      restored->save(b);
      EXPECT_EQ(a.reals, b.reals) << step;
      EXPECT_EQ(a.integers, b.integers) << step;
    }
  }
}

// One hierarchy and the guess serve all solves while the topology stands and nothing has moved far;
// both go into the checkpoint, and with the topology.
TEST(FiniteElementFlow, KeepsItsPreconditionerAndItsGuessWhileTheTopologyStands) {
  const Scene scene = shear_scene();
  const auto flow = make_finite_element_flow({});
  const auto saved = [&] {
    Archive archive;
    flow->save(archive);
    return archive;
  };
  for (int topology = 0; topology < 2; ++topology) {
    ASSERT_TRUE(flow->rebuild(scene).ok);
    EXPECT_FALSE(saved().reals.contains("flow/preconditioner/x"));
    EXPECT_FALSE(saved().reals.contains("flow/guess/velocity"));
    Scene moved = scene;
    ASSERT_TRUE(flow->solve(moved, 0.0).ok);
    const Archive first = saved();
    for (int stage = 0; stage < 4; ++stage) {
      for (Vec3& x : moved.interfaces[0].mesh.x) x[0] *= 1.001;
      ASSERT_TRUE(flow->solve(moved, 0.0).ok);
      EXPECT_EQ(saved().reals.at("flow/preconditioner/x"), first.reals.at("flow/preconditioner/x"));
      EXPECT_NE(saved().reals.at("flow/guess/velocity"), first.reals.at("flow/guess/velocity"));
    }
  }
}

// A factorisation of what is no longer there soon costs more iterations than it is worth.
TEST(FiniteElementFlow, APreconditionerThatNoLongerFitsIsGivenUp) {
  Scene scene = shear_scene();
  Options options;
  options.linear = LinearSolver::mumps;
  const auto flow = make_finite_element_flow(options);
  ASSERT_TRUE(flow->rebuild(scene).ok);
  ASSERT_TRUE(flow->solve(scene, 0.0).ok);
  scene.liquids[RegionId{1}].viscosity *= 10.0;
  const FlowReport kept = flow->solve(scene, 0.0);
  ASSERT_TRUE(kept.ok);
  EXPECT_GT(kept.iterations, 4);
  Archive archive;
  flow->save(archive);
  EXPECT_FALSE(archive.reals.contains("flow/preconditioner/x"));
  for (Vec3& x : scene.interfaces[0].mesh.x) x[0] *= 1.001;
  const FlowReport fresh = flow->solve(scene, 0.0);
  ASSERT_TRUE(fresh.ok);
  EXPECT_LE(fresh.iterations, 2);
}

TEST(FiniteElementFlow, ADamagedCheckpointIsRefused) {
  const Scene scene = shear_scene();
  const auto flow = make_finite_element_flow({});
  ASSERT_TRUE(flow->rebuild(scene).ok);
  Archive archive;
  flow->save(archive);
  const auto restored = make_finite_element_flow({});
  Archive missing = archive;
  missing.reals.erase("flow/mesh/x");
  EXPECT_THROW(restored->load(missing, scene), InvalidInput);
  Archive wild = archive;
  wild.integers["flow/mesh/cells"][7] = 1000000;
  EXPECT_THROW(restored->load(wild, scene), InvalidInput);
  Archive short_preconditioner = archive;
  short_preconditioner.reals["flow/preconditioner/x"] = {0.0, 0.0, 0.0};
  EXPECT_THROW(restored->load(short_preconditioner, scene), InvalidInput);
  Archive short_guess = archive;
  short_guess.reals["flow/guess/velocity"] = {0.0, 0.0, 0.0};
  short_guess.reals["flow/guess/pressure"] = {0.0};
  EXPECT_THROW(restored->load(short_guess, scene), InvalidInput);
}

TEST(FiniteElementFlow, InversionIsReportedAndTheMeshIsAsMarked) {
  const Scene scene = shear_scene();
  const auto flow = make_finite_element_flow({});
  ASSERT_TRUE(flow->rebuild(scene).ok);
  ASSERT_TRUE(flow->solve(scene, 0.0).ok);
  flow->mark(scene);
  const auto before = flow->volume_mesh()->x;
  std::vector<VertexField<Vec3>> motion = motion_of(*flow);
  for (Vec3& v : motion[0]) v = Vec3(100.0, 0.0, 0.0);
  const FlowReport report = flow->move_from_mark(scene, motion, 1.0);
  EXPECT_FALSE(report.ok);
  EXPECT_FALSE(report.failure.empty());
  EXPECT_EQ(flow->volume_mesh()->x, before);
}

TEST(FiniteElementFlow, TwoDropsEachKeepTheirVolume) {
  Scene scene = shear_scene();
  scene.liquids.add({0.5, Vec3::Zero()});
  scene.boundary.mesh = sphere(300, 6.0);
  scene.boundary.patch = FaceField<PatchId>(scene.boundary.mesh.num_faces(), PatchId{0});
  Interface other = scene.interfaces[0];
  other.drop = 1;
  other.inside = RegionId{2};
  scene.interfaces.push_back(other);
  for (Vec3& x : scene.interfaces[0].mesh.x) x += Vec3(-1.5, 0.4, 0.0);
  for (Vec3& x : scene.interfaces[1].mesh.x) x += Vec3(1.5, -0.4, 0.0);
  Options options;
  options.rtol = 1e-9;
  const auto flow = make_finite_element_flow(options);
  ASSERT_TRUE(flow->rebuild(scene).ok);
  const FlowReport report = flow->solve(scene, 0.0);
  ASSERT_TRUE(report.ok) << report.failure;
  ASSERT_EQ(flow->velocity().size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const VertexField<Vec3> area = vertex_area_vectors(scene.interfaces[i].mesh);
    double flux = 0.0;
    for (const VertexId v : area.ids()) flux += area[v].dot(flow->velocity()[i][v]);
    EXPECT_NEAR(flux, 0.0, 1e-7);
  }
}

}  // namespace
}  // namespace meniscus::fem
