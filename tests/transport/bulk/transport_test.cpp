#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "meniscus/transport/bulk/transport_matrices.hpp"
#include "tests/transport/bulk/scalar_scene.hpp"

namespace meniscus::bulk {
namespace {

/// A drop that is stretched at constant volume within a step, by a flow that knows nothing of it:
/// its velocities are random, and zero on the wall.
class RandomStep {
 public:
  RandomStep(fem::Elements elements, double capacity, double peclet)
      : before(options(elements, capacity, peclet)), after(options(elements, capacity, peclet)) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> one(-1.0, 1.0);
    const double stretch = 1.02;
    const Vec3 factor(stretch, 1.0 / std::sqrt(stretch), 1.0 / std::sqrt(stretch));
    Interface& drop = after.scene.interfaces[0];
    for (Vec3& x : drop.mesh.x) x = x.cwiseProduct(factor);
    const EmbeddedSurface& embedded = after.mesh.interfaces[0];
    for (const VertexId v : drop.mesh.x.ids()) after.mesh.x[embedded.vertex(v)] = drop.mesh.x[v];
    const std::int32_t first =
        after.mesh.boundary.first_vertex.value + after.mesh.boundary.num_vertices;
    for (const TetVertexId v : after.mesh.x.ids())
      if (v.value >= first) after.mesh.x[v] += 2e-3 * Vec3(one(random), one(random), one(random));
    for (const CellId c : after.mesh.cells.ids()) EXPECT_GT(signed_volume(after.mesh, c), 0.0);
    BulkFlow bulk;
    const ScalarSpace space = scalar_space(
        before.domain(),
        std::make_shared<const fem::FlowSpace>(fem::flow_space(before.mesh, elements)));
    std::vector<char> is_wall(static_cast<std::size_t>(space.num_nodes()), 0);
    for (const NodeId i : space.boundary.face_nodes) is_wall[static_cast<std::size_t>(i.value)] = 1;
    for (std::int32_t i = 0; i < space.num_nodes(); ++i) {
      Vec3 v = Vec3(one(random), one(random), one(random));
      if (is_wall[static_cast<std::size_t>(i)] != 0) v.setZero();
      if (i < space.elements.num_vertices())
        bulk.v.add(v);
      else
        bulk.v_at_edges.push_back(v);
    }
    flow.bulk = std::move(bulk);
  }

  Report take(BulkScalars& scalars) const {
    return before.solver->advance({before.domain(), after.domain(), 0.1, flow}, scalars);
  }
  [[nodiscard]] static double total(const ScalarScene& at, const BulkScalars& scalars) {
    double sum = 0.0;
    const ScalarMeasures measures = at.solver->measures(at.domain(), scalars)[0];
    for (const ScalarContent& region : measures.regions) sum += region.amount;
    return sum;
  }

  ScalarScene before, after;
  FlowSolution flow;

 private:
  static ScalarScene::Options options(fem::Elements elements, double capacity, double peclet) {
    ScalarScene::Options result;
    result.elements = elements;
    result.spheres.num_vertices = 60;
    result.spheres.outer_radius = 3.0;
    result.scalar.peclet = peclet;
    result.drop.capacity = capacity;
    return result;
  }
};

class EveryElement : public testing::TestWithParam<fem::Elements> {};
INSTANTIATE_TEST_SUITE_P(Transport, EveryElement,
                         testing::Values(fem::Elements::p1_p1, fem::Elements::p2_p1),
                         [](const auto& tested) {
                           return tested.param == fem::Elements::p1_p1 ? "P1" : "P2";
                         });

TEST_P(EveryElement, KeepsConstantsOnAMovingMesh) {
  const RandomStep step(GetParam(), 3.0, 50.0);
  BulkScalars scalars;
  ASSERT_TRUE(step.before.solver->initial(step.before.domain(), scalars).ok());
  std::ranges::fill(scalars[0].values, 2.5);
  const Report moved = step.take(scalars);
  ASSERT_TRUE(moved.ok()) << moved.text();
  for (const double T : scalars[0].values) EXPECT_NEAR(T, 2.5, 1e-8);
}

TEST_P(EveryElement, KeepsTotalsOnAMovingMesh) {
  const RandomStep step(GetParam(), 3.0, 50.0);
  BulkScalars scalars;
  ASSERT_TRUE(step.before.solver->initial(step.before.domain(), scalars).ok());
  std::mt19937 random(7);
  std::uniform_real_distribution<double> one(0.0, 1.0);
  for (double& T : scalars[0].values) T = one(random);
  const double before = RandomStep::total(step.before, scalars);
  const Report moved = step.take(scalars);
  ASSERT_TRUE(moved.ok()) << moved.text();
  EXPECT_NEAR(RandomStep::total(step.after, scalars), before, 1e-12 * before);
}

// A sink takes more than there is; of heat that is allowed.
// The flow may ask for so many positions that those before the change are forgotten.
TEST(BulkScalars, FollowAMeshWhosePositionsTheFlowHasForgotten) {
  ScalarScene drop({.spheres = {.num_vertices = 60},
                    .scalar = {.name = "T", .peclet = 1.0},
                    .drop = {.initial = {.value = 1.0}}});
  BulkScalars scalars;
  ASSERT_TRUE(drop.solver->initial(drop.domain(1), scalars).ok());
  MeshChange change;
  change.before = drop.mesh;
  const auto followed = [&](std::int64_t connectivity) {
    return drop.solver->follow(change, drop.scene, drop.domain(connectivity), scalars)[0].values;
  };
  ASSERT_NE(drop.known->sources(change, drop.domain(2)), nullptr);
  const std::vector<double> known = followed(2);
  drop.mesh.x[TetVertexId{drop.mesh.num_vertices() - 1}].x() += 1e-12;  // other positions
  for (std::int64_t other = 20; other < 30; ++other)
    (void)drop.known->positions(drop.domain(other));
  ASSERT_EQ(drop.known->sources(change, drop.domain(3)), nullptr);
  const std::vector<double> forgotten = followed(3);
  ASSERT_EQ(known.size(), scalars[0].values.size());
  for (std::size_t i = 0; i < known.size(); ++i) {
    EXPECT_NEAR(known[i], scalars[0].values[i], 1e-9);
    EXPECT_NEAR(forgotten[i], known[i], 1e-9);
  }
}

TEST(BulkSpecies, RefuseAStepBelowZero) {
  const auto step = [](bool is_species, double dt) {
    ScalarScene::Options options;
    options.spheres.num_vertices = 60;
    options.spheres.outer_radius = 3.0;
    options.scalar.is_species = is_species;
    options.matrix.initial.value = options.drop.initial.value = 1.0;
    options.drop.source = -20.0;
    const ScalarScene drop(options);
    BulkScalars scalars;
    EXPECT_TRUE(drop.solver->initial(drop.domain(), scalars).ok());
    return Report(
        drop.solver->advance({drop.domain(), drop.domain(), dt, FlowSolution()}, scalars));
  };
  EXPECT_TRUE(step(true, 0.01).ok());
  EXPECT_TRUE(step(false, 0.2).ok());
  const Report refused = step(true, 0.2);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.text().find("must be at least 0"), std::string::npos) << refused.text();
  ASSERT_TRUE(refused.fault->position);
  EXPECT_LT(refused.fault->position->norm(), 1.5);
}

}  // namespace
}  // namespace meniscus::bulk
