#include "meniscus/evolve/evolution.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"
#include "meniscus/core/log.hpp"
#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/volume/tetrahedralize.hpp"
#include "prescribed_flow.hpp"

namespace meniscus {
namespace {

Scene one_drop(int num_vertices, double tension = 0.0) {
  Scene scene;
  scene.is_unbounded = true;
  scene.flow = ImposedFlow(FlowFamily::axial, ImposedFlow::uniaxial_extension());
  scene.liquids.add(Liquid{});
  scene.liquids.add(Liquid{});
  Interface interface;
  interface.mesh = sphere(num_vertices);
  interface.inside = RegionId{1};
  interface.outside = RegionId{0};
  interface.tension = tension;
  interface.C0 = num_vertices / (4.0 * std::numbers::pi);
  interface.volume = interface.initial_volume = enclosed_volume(interface.mesh);
  scene.interfaces.push_back(interface);
  return scene;
}

struct Run {
  PrescribedFlow* flow;
  Evolution evolution;
};

Run make_run(Scene scene, const EvolutionOptions& options, PrescribedFlow::Velocity velocity) {
  auto flow = std::make_unique<PrescribedFlow>(std::move(velocity));
  PrescribedFlow* seen = flow.get();
  return {seen, Evolution(std::move(scene), options, std::move(flow))};
}

Vec3 stretching(const Vec3& x, double) { return ImposedFlow::uniaxial_extension() * x; }

void run_to_end(Evolution& evolution) {
  ASSERT_TRUE(evolution.prepare().ok());
  while (true) {
    ASSERT_TRUE(evolution.solve().ok());
    if (evolution.is_finished()) return;
    const Report advanced = evolution.advance();
    ASSERT_TRUE(advanced.ok()) << advanced.text();
  }
}

/// Vertices at t = 0.4 of a drop that turns and stretches, stepped with dt and never remeshed.
VertexField<Vec3> vertices_after(TimeScheme scheme, double dt) {
  EvolutionOptions options;
  options.scheme = scheme;
  options.end = 0.4 - 1e-9;
  options.max_step = dt;
  options.step_factor = 1e3;  // max_step decides
  options.remesh_every = 1000000;
  auto run = make_run(one_drop(162), options, [](const Vec3& x, double t) {
    return Vec3(std::cos(3.0 * t) * (ImposedFlow::uniaxial_extension() * x) +
                Vec3(0.0, x.z(), 0.0));
  });
  run_to_end(run.evolution);
  return run.evolution.scene().interfaces[0].mesh.x;
}

double largest_difference(const VertexField<Vec3>& a, const VertexField<Vec3>& b) {
  double largest = 0.0;
  for (const VertexId v : a.ids()) largest = std::max(largest, (a[v] - b[v]).norm());
  return largest;
}

TEST(Evolution, EulersStepsAreOfFirstOrderInTimeTheOthersOfSecond) {
  for (const auto& [scheme, order] :
       {std::pair(TimeScheme::rk2, 2.0), std::pair(TimeScheme::rkc, 2.0),
        std::pair(TimeScheme::euler, 1.0)}) {
    const auto coarse = vertices_after(scheme, 0.05), middle = vertices_after(scheme, 0.025),
               fine = vertices_after(scheme, 0.0125);
    const double observed =
        std::log2(largest_difference(coarse, middle) / largest_difference(middle, fine));
    EXPECT_NEAR(observed, order, 0.2);
  }
}

// The mesh holds at most 0.6 to 1.5 of its edges' lengths, so some steps must remesh.
TEST(Evolution, KeepsItsMeshesAsLongAsTheyAreFit) {
  EvolutionOptions options;
  options.end = 0.8;
  options.max_step = 0.02;
  options.step_factor = 1e3;
  options.remesh_every = 0;
  Scene scene = one_drop(110, 1.0);
  scene.is_unbounded = false;
  scene.boundary.mesh = sphere(100, 4.0);
  scene.boundary.patch = FaceField<PatchId>(scene.boundary.mesh.num_faces(), PatchId{0});
  scene.boundary.patches.add({"wall", NoPenetration{}});
  Evolution evolution(
      scene, options, std::make_unique<PrescribedFlow>(stretching),
      MovingMesh(MovingMeshOptions{.tetrahedra = {}, .motion = VolumeMotion::harmonic}));
  ASSERT_TRUE(evolution.prepare().ok());
  int num_kept = 0, num_new = 0;
  while (!evolution.is_finished()) {
    const CellField<CellVertices> cells = evolution.state().mesh->tetrahedra().cells;
    const FaceField<FaceVertices> faces = evolution.scene().interfaces[0].mesh.faces;
    ASSERT_TRUE(evolution.solve().ok());
    const Report advanced = evolution.advance();
    ASSERT_TRUE(advanced.ok()) << advanced.text();
    const TetMesh& mesh = evolution.state().mesh->tetrahedra();
    const bool is_kept = evolution.state().record.is_mesh_kept;
    ++(is_kept ? num_kept : num_new);
    EXPECT_EQ(mesh.cells == cells, is_kept);
    if (is_kept) {
      EXPECT_EQ(evolution.scene().interfaces[0].mesh.faces, faces);
    }
    EXPECT_TRUE(evolution.state().mesh->is_fit());
    EXPECT_EQ(find_defect(mesh, evolution.scene()).value_or(Fault{}).text, "");
    EXPECT_NEAR(enclosed_volume(evolution.scene().interfaces[0].mesh),
                evolution.scene().interfaces[0].volume, 1e-12);
  }
  EXPECT_GT(num_kept, 10);
  EXPECT_GT(num_new, 2);
  const DropRow row = evolution.drop_rows().at(0);
  EXPECT_NEAR(row.shape.L / std::exp(evolution.t()), 1.0, 0.02);
}

/// Σ of the shifts that keep the volume of a drop that stretches to t = 0.4 and is never remeshed.
double sum_of_shifts(TimeScheme scheme, double dt) {
  EvolutionOptions options;
  options.scheme = scheme;
  options.end = 0.4 - 1e-9;
  options.max_step = dt;
  options.step_factor = 1e3;
  options.remesh_every = 1000000;
  auto run = make_run(one_drop(110), options, stretching);
  double sum = 0.0;
  EXPECT_TRUE(run.evolution.prepare().ok());
  while (!run.evolution.is_finished()) {
    EXPECT_TRUE(run.evolution.solve().ok());
    EXPECT_TRUE(run.evolution.advance().ok());
    sum += run.evolution.state().volume_shift.at(0);
  }
  return sum;
}

// The rate of change of the volume is zero to round-off, as the area vectors are its gradient: what
// the steps of a scheme of order p leave of it is O(dt^p).
TEST(Evolution, VolumeCorrectionsAreOfTheOrderOfTheScheme) {
  for (const auto& [scheme, order] :
       {std::pair(TimeScheme::rk2, 2.0), std::pair(TimeScheme::euler, 1.0)}) {
    const double coarse = sum_of_shifts(scheme, 0.05), middle = sum_of_shifts(scheme, 0.025),
                 fine = sum_of_shifts(scheme, 0.0125);
    EXPECT_NEAR(std::log2(coarse / middle), order, 0.2);
    EXPECT_NEAR(std::log2(middle / fine), order, 0.2);
  }
}

TEST(Evolution, DropFollowsTheExactMap) {
  EvolutionOptions options;
  options.end = 0.5;
  auto run = make_run(one_drop(600), options, stretching);
  run_to_end(run.evolution);
  const DropRow row = run.evolution.drop_rows().at(0);
  // Under v = E·x a sphere becomes the ellipsoid of semi-axes exp(t), exp(−t/2); h² ~ 0.025 here.
  EXPECT_NEAR(row.shape.L / std::exp(run.evolution.t()), 1.0, 5e-3);
  EXPECT_NEAR(row.shape.B / std::exp(-0.5 * run.evolution.t()), 1.0, 5e-3);
}

TEST(Evolution, StepLengthObeysTheEdgeTensionAndBounds) {
  for (const double tension : {0.0, 0.5, 4.0}) {
    EvolutionOptions options;
    options.max_step = 10.0;
    options.remesh_every = 1000000;
    auto run = make_run(one_drop(110, tension), options,
                        [](const Vec3&, double) { return Vec3(Vec3::Zero()); });
    ASSERT_TRUE(run.evolution.prepare().ok());
    const double edge = shortest_edge(run.evolution.scene().interfaces[0].mesh);
    ASSERT_TRUE(run.evolution.solve().ok());
    ASSERT_TRUE(run.evolution.advance().ok());
    EXPECT_NEAR(run.evolution.t(), 0.5 * std::min(1.0, 1.0 / std::max(tension, 1e-300)) * edge,
                1e-12);
  }
}

TEST(Evolution, StepLengthStaysBelowItsUpperBound) {
  EvolutionOptions options;
  options.max_step = 1e-3;
  auto run = make_run(one_drop(110, 0.5), options, stretching);
  ASSERT_TRUE(run.evolution.prepare().ok());
  EXPECT_EQ(run.evolution.step_length(), 1e-3);
}

// The lower bound lies above what the edges allow: no step is taken, and the words say why.
TEST(Evolution, StepShorterThanItsLowerBoundIsNotTaken) {
  EvolutionOptions options;
  options.min_step = 10.0;
  options.max_step = 20.0;
  auto run = make_run(one_drop(110, 0.5), options, stretching);
  ASSERT_TRUE(run.evolution.prepare().ok());
  ASSERT_TRUE(run.evolution.solve().ok());
  const Report report = run.evolution.advance();
  EXPECT_FALSE(report.ok());
  EXPECT_NE(report.text().find("edges ask for a shorter one"), std::string::npos) << report.text();
  EXPECT_EQ(run.evolution.t(), 0.0);
}

TEST(Evolution, FailedStepIsUndoneAndHalved) {
  log::set_level(log::Level::off);
  EvolutionOptions options;
  options.max_step = 0.08;
  options.step_factor = 1e3;
  options.remesh_every = 1000000;
  auto run = make_run(one_drop(110), options, stretching);
  ASSERT_TRUE(run.evolution.prepare().ok());
  ASSERT_TRUE(run.evolution.solve().ok());
  run.flow->longest_step = 0.03;
  ASSERT_TRUE(run.evolution.advance().ok());
  EXPECT_NEAR(run.evolution.t(), 0.02, 1e-15);
  EXPECT_EQ(run.evolution.notices().size(), 2u);
  log::set_level(log::Level::warning);
}

/// Steps that were refused for a reason which has `part` in its words.
int count_refusals(const Evolution& evolution, const std::string& part) {
  int count = 0;
  for (const Notice& notice : evolution.notices())
    if (const auto* step = std::get_if<RefusedStep>(&notice.what))
      count += step->why.find(part) != std::string::npos ? 1 : 0;
  return count;
}

// Euler's step scales this drop by 1 − 100 dt: it is turned inside out by one of 0.08, and the
// volume is above half of what it was from (1/8)·0.01 on. Then restoring the volume takes a shift
// of about 100 dt, which is less than 0.01 of an edge of 0.36 from 2^−12·0.08 on.
TEST(Evolution, AStepThatDoesNotKeepTheVolumeIsHalved) {
  log::set_level(log::Level::off);
  EvolutionOptions options;
  options.max_step = 0.08;
  options.step_factor = 1e3;
  options.scheme = TimeScheme::euler;
  auto run =
      make_run(one_drop(110), options, [](const Vec3& x, double) { return Vec3(-100.0 * x); });
  ASSERT_TRUE(run.evolution.prepare().ok());
  ASSERT_TRUE(run.evolution.solve().ok());
  ASSERT_TRUE(run.evolution.advance().ok());
  EXPECT_EQ(count_refusals(run.evolution, "times its volume"), 6);
  EXPECT_EQ(count_refusals(run.evolution, "restoring the volume"), 6);
  EXPECT_NEAR(run.evolution.t(), 0.08 / 4096.0, 1e-15);
  log::set_level(log::Level::warning);
}

template <class What>
int count_of(const Evolution& evolution) {
  int count = 0;
  for (const Notice& notice : evolution.notices())
    count += std::holds_alternative<What>(notice.what) ? 1 : 0;
  return count;
}

// Euler's step stretches the drop to (1 + dt)(1 − dt/2)² of its volume. Making up for the lack of
// 3/4 dt² moves the surface by dt²/4, 0.028 of an edge of 0.36 for dt = 0.2, 0.007 for half of it.
TEST(Evolution, AStepIsHalvedWhenItsVolumeIsRestoredByALargeShift) {
  log::set_level(log::Level::off);
  EvolutionOptions options;
  options.scheme = TimeScheme::euler;
  options.max_step = 0.2;
  options.step_factor = 1e3;
  options.remesh_every = 1000000;
  auto run = make_run(one_drop(110), options, stretching);
  ASSERT_TRUE(run.evolution.prepare().ok());
  ASSERT_TRUE(run.evolution.solve().ok());
  ASSERT_TRUE(run.evolution.advance().ok());
  EXPECT_NEAR(run.evolution.t(), 0.1, 1e-15);
  EXPECT_EQ(count_of<RefusedStep>(run.evolution), 1);
  EXPECT_LT(run.evolution.state().shift_over_edge, kMostShiftOverEdge);
  log::set_level(log::Level::warning);
}

// The midpoint rule moves every vertex of this drop by 0.02 dt/(2 t + dt) of its radius, which is
// 0.02 in the first step, whatever its length: it is halved once, and told of once. Later steps
// move less, until none needs to be tolerated.
TEST(Evolution, AShiftThatAShorterStepDoesNotLowerIsToldOfOnceAndAccepted) {
  log::set_level(log::Level::off);
  EvolutionOptions options;
  options.end = 1.0;
  options.max_step = 0.08;
  options.step_factor = 1e3;
  options.remesh_every = 1000000;
  auto run = make_run(one_drop(110), options, [](const Vec3& x, double t) {
    return t > 0.0 ? Vec3(0.01 / t * x) : Vec3(Vec3::Zero());
  });
  ASSERT_TRUE(run.evolution.prepare().ok());
  ASSERT_TRUE(run.evolution.solve().ok());
  ASSERT_TRUE(run.evolution.advance().ok());
  EXPECT_NEAR(run.evolution.t(), 0.04, 1e-15);
  EXPECT_TRUE(run.evolution.state().tolerates_shift);
  ASSERT_TRUE(run.evolution.solve().ok());
  ASSERT_TRUE(run.evolution.advance().ok());
  EXPECT_NEAR(run.evolution.t(), 0.12, 1e-15);
  EXPECT_GT(run.evolution.state().shift_over_edge, kMostShiftOverEdge);

  Archive archive;
  run.evolution.save(archive);
  auto again = make_run(one_drop(42, 3.0), options, stretching);
  again.evolution.load(archive);
  EXPECT_TRUE(again.evolution.state().tolerates_shift);

  while (!run.evolution.is_finished()) {
    ASSERT_TRUE(run.evolution.solve().ok());
    ASSERT_TRUE(run.evolution.advance().ok());
  }
  EXPECT_EQ(count_of<RefusedStep>(run.evolution), 1);
  EXPECT_EQ(count_of<LargeVolumeShift>(run.evolution), 1);
  EXPECT_FALSE(run.evolution.state().tolerates_shift);
  log::set_level(log::Level::warning);
}

TEST(Evolution, GivesUpBelowTheSmallestStepWithTheStateAsItWas) {
  log::set_level(log::Level::off);
  EvolutionOptions options;
  options.min_step = 1e-3;
  auto run = make_run(one_drop(110), options, stretching);
  ASSERT_TRUE(run.evolution.prepare().ok());
  ASSERT_TRUE(run.evolution.solve().ok());
  const SurfaceMesh before = run.evolution.scene().interfaces[0].mesh;
  run.flow->longest_step = 0.0;
  const Report report = run.evolution.advance();
  EXPECT_FALSE(report.ok());
  EXPECT_NE(report.text().find("moved too far"), std::string::npos) << report.text();
  EXPECT_EQ(run.evolution.scene().interfaces[0].mesh, before);
  EXPECT_EQ(run.evolution.step(), 0);
  run.flow->is_broken = true;
  EXPECT_FALSE(run.evolution.solve().ok());
  log::set_level(log::Level::warning);
}

void expect_same_bits_after_resuming(EvolutionOptions options) {
  options.end = 0.3;
  auto whole = make_run(one_drop(110, 1.0), options, stretching);
  run_to_end(whole.evolution);

  auto first = make_run(one_drop(110, 1.0), options, stretching);
  ASSERT_TRUE(first.evolution.prepare().ok());
  for (int k = 0; k < 2; ++k) {
    ASSERT_TRUE(first.evolution.solve().ok());
    ASSERT_TRUE(first.evolution.advance().ok());
  }
  Archive archive;
  first.evolution.save(archive);
  auto second = make_run(one_drop(42, 3.0), options, stretching);
  second.evolution.load(archive);
  while (!second.evolution.is_finished()) {
    ASSERT_TRUE(second.evolution.solve().ok());
    ASSERT_TRUE(second.evolution.advance().ok());
  }
  EXPECT_EQ(second.evolution.step(), whole.evolution.step());
  EXPECT_EQ(second.evolution.t(), whole.evolution.t());
  EXPECT_EQ(second.evolution.state().record.error, whole.evolution.state().record.error);
  EXPECT_EQ(second.evolution.scene().interfaces[0].mesh,
            whole.evolution.scene().interfaces[0].mesh);
}

TEST(Evolution, RefusesACheckpointWhoseSurfaceIsNone) {
  Archive archive;
  make_run(one_drop(42, 1.0), {}, stretching).evolution.save(archive);
  const auto complaint = [](const Archive& damaged) -> std::string {
    auto run = make_run(one_drop(42, 1.0), {}, stretching);
    try {
      run.evolution.load(damaged);
    } catch (const InvalidInput& fault) {
      return fault.what();
    }
    return "";
  };
  EXPECT_EQ(complaint(archive), "");
  Archive far = archive, open = archive;
  far.reals["interfaces/0/x"][0] = 1e66;
  EXPECT_TRUE(complaint(far).starts_with("checkpoint: drop 0 encloses ")) << complaint(far);
  std::vector<std::int64_t>& faces = open.integers["interfaces/0/faces"];
  faces.resize(faces.size() - 3);
  EXPECT_TRUE(complaint(open).starts_with("checkpoint: drop 0: surface is not closed at the edge "))
      << complaint(open);
}

TEST(Evolution, SavedStateGoesOnToTheSameBits) {
  expect_same_bits_after_resuming({});
  EvolutionOptions options;
  options.control = StepControl::error;
  for (const TimeScheme scheme : {TimeScheme::rk2, TimeScheme::rkc}) {
    options.scheme = scheme;
    expect_same_bits_after_resuming(options);
  }
  options.remesh_every = 0;
  expect_same_bits_after_resuming(options);
}

TEST(Evolution, SavedLiquidsKeepTheirLaws) {
  Scene scene = one_drop(42, 1.0);
  scene.liquids[RegionId{0}].law = PowerLaw{0.4, 1e-2, 50.0};
  scene.liquids[RegionId{1}].law = CarreauYasuda{2.0, 0.3, 1.5, 0.1};
  Archive archive;
  make_run(scene, {}, stretching).evolution.save(archive);
  auto again = make_run(one_drop(42, 3.0), {}, stretching);
  again.evolution.load(archive);
  EXPECT_EQ(again.evolution.scene().liquids[RegionId{0}].law, scene.liquids[RegionId{0}].law);
  EXPECT_EQ(again.evolution.scene().liquids[RegionId{1}].law, scene.liquids[RegionId{1}].law);
}

/// The flow about the origin carries a centre at x0 to x0 eᵗ; held where it was, the drop only
/// stretches, to the same half-length as a drop at the origin.
TEST(Evolution, HoldsTheDropsWhereTheyWereWhenTheFrameMovesWithThem) {
  const auto end_of = [](bool follows_drops, double x0, int remesh_every) -> DropRow {
    Scene scene = one_drop(200);
    translate_interfaces(scene, Vec3(x0, 0.0, 0.0));
    EvolutionOptions options;
    options.end = 0.5 - 1e-9;
    options.max_step = 0.05;
    options.follows_drops = follows_drops;
    options.remesh_every = remesh_every;
    auto run = make_run(std::move(scene), options, stretching);
    run_to_end(run.evolution);
    // Steps are as long as the mesh allows, and the last one may pass the end by any part of it:
    // what the flow does by then, eᵗ along the axis, is taken out.
    DropRow row = run.evolution.drop_rows().front();
    const double stretch = std::exp(run.evolution.t());
    row.shape.L /= stretch;
    if (!follows_drops) row.shape.centroid.x() /= stretch;
    return row;
  };
  EXPECT_NEAR(end_of(false, 0.3, 1).shape.centroid.x(), 0.3, 1.2e-3);  // of x0 eᵗ
  for (const int remesh_every : {1, 3}) {
    const DropRow held = end_of(true, 0.3, remesh_every),
                  central = end_of(false, 0.0, remesh_every);
    // What a remeshing moves stays until the next step: the last of every third does not remesh.
    const double left = remesh_every == 1 ? 1e-3 : 1e-6;
    const Vec3 start = Vec3(0.3, 0.0, 0.0) + enclosed_centroid(sphere(200));
    EXPECT_NEAR((held.shape.centroid - start).norm(), 0.0, left);
    EXPECT_NEAR(held.shape.L, central.shape.L, 1.2e-3);
  }
}

// A resumed run is made without drops: where they were held is the checkpoint's to say.
TEST(Evolution, GoesOnHoldingTheDropsWhereTheyWere) {
  Scene scene = one_drop(200);
  translate_interfaces(scene, Vec3(0.3, 0.0, 0.0));
  EvolutionOptions options;
  options.end = 0.1 - 1e-9;
  options.max_step = 0.05;
  options.follows_drops = true;
  auto run = make_run(scene, options, stretching);
  run_to_end(run.evolution);
  Archive archive;
  run.evolution.save(archive);
  scene.interfaces.clear();
  auto again = make_run(scene, options, stretching);
  again.evolution.load(archive);
  for (Evolution* each : {&run.evolution, &again.evolution}) {
    ASSERT_TRUE(each->solve().ok());
    ASSERT_TRUE(each->advance().ok());
  }
  const VertexField<Vec3>&x = run.evolution.scene().interfaces[0].mesh.x,
        &y = again.evolution.scene().interfaces[0].mesh.x;
  ASSERT_EQ(x.size(), y.size());
  for (const VertexId v : x.ids()) EXPECT_EQ(x[v], y[v]);
}

TEST(InterfaceMotion, CentroidOfDropsLeavesOutDropsWithinDrops) {
  Scene scene = one_drop(200);
  Interface other = scene.interfaces.front();
  for (Vec3& x : other.mesh.x) x += Vec3(4.0, 0.0, 0.0);
  Interface inner = scene.interfaces.front();
  for (Vec3& x : inner.mesh.x) x *= 0.5;
  inner.outside = RegionId{1};
  scene.interfaces.push_back(other);
  scene.interfaces.push_back(inner);
  const Vec3 between =
      0.5 * (enclosed_centroid(scene.interfaces[0].mesh) + enclosed_centroid(other.mesh));
  EXPECT_NEAR((centroid_of_drops(scene) - between).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace meniscus
