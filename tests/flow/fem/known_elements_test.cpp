#include "meniscus/flow/fem/known_elements.hpp"

#include <memory>

#include <gtest/gtest.h>

#include "meniscus/volume/tetrahedralize.hpp"
#include "tests/flow/fem/sphere_scene.hpp"

namespace meniscus::fem {
namespace {

class KnownElementsOfABall : public testing::Test {
 protected:
  KnownElementsOfABall()
      : scene_(sphere_in_sphere({.num_vertices = 42, .outer_radius = 3.0})),
        known_(Elements::p2_p1) {
    EXPECT_TRUE(tetrahedralize(scene_, {}, mesh_).ok());
  }
  [[nodiscard]] FlowDomain domain(std::int64_t connectivity) const {
    return {scene_, &mesh_, connectivity};
  }
  /// Moves a vertex off the surfaces.
  void move() { mesh_.x[TetVertexId{mesh_.num_vertices() - 1}] += Vec3(1e-3, 0.0, 0.0); }
  Scene scene_;
  TetMesh mesh_;
  KnownElements known_;
};

TEST_F(KnownElementsOfABall, AreMadeOnce) {
  const auto space = known_.space(domain(1));
  const auto positions = known_.positions(domain(1));
  EXPECT_EQ(known_.space(domain(1)), space);
  EXPECT_EQ(known_.positions(domain(1)), positions);
  EXPECT_EQ(space->velocity_graph(), space->velocity_graph());
  const FlowSpace alone = flow_space(mesh_, Elements::p2_p1);
  EXPECT_EQ(space->velocity.cell_nodes, alone.velocity.cell_nodes);
  EXPECT_EQ(positions->x, node_positions(scene_, mesh_, alone).x);
}

TEST_F(KnownElementsOfABall, FollowTheVertices) {
  const auto space = known_.space(domain(1));
  const auto before = known_.positions(domain(1));
  move();
  const auto after = known_.positions(domain(1));
  EXPECT_EQ(known_.space(domain(1)), space);
  EXPECT_NE(after->x, before->x);
  EXPECT_EQ(after->x, node_positions(scene_, mesh_, *space).x);
}

// A mesh in the place of itself: each node lies where it is.
TEST_F(KnownElementsOfABall, SayWhereNodesLieInTheMeshBefore) {
  MeshChange change;
  change.before = mesh_;
  EXPECT_EQ(known_.sources(change, domain(2)), nullptr);  // no positions were asked for
  const auto space = known_.space(domain(1));
  const auto positions = known_.positions(domain(1));
  const auto sources = known_.sources(change, domain(2));
  ASSERT_NE(sources, nullptr);
  EXPECT_EQ(known_.sources(change, domain(2)), sources);
  const std::span<const Vec3> x = positions->x.span();
  const std::vector<Vec3> found = interpolated_values<Vec3>(x, *space, *sources);
  ASSERT_EQ(found.size(), x.size());
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_LT((found[i] - x[i]).norm(), 1e-12);
}

// What is asked for again is not the oldest.
TEST_F(KnownElementsOfABall, KeepWhatIsAskedFor) {
  const std::weak_ptr<const NodePositions> positions = known_.positions(domain(1));
  for (const std::int64_t connectivity : {2, 3, 4, 5, 6, 7}) {
    (void)known_.positions(domain(connectivity));
    EXPECT_EQ(known_.positions(domain(1)), positions.lock());
  }
}

// The last few are kept, no more.
TEST_F(KnownElementsOfABall, ForgetOldMeshes) {
  const std::weak_ptr<const FlowSpace> space = known_.space(domain(1));
  const std::weak_ptr<const NodePositions> positions = known_.positions(domain(1));
  EXPECT_NE(known_.space(domain(2)), space.lock());
  EXPECT_FALSE(space.expired());
  for (const std::int64_t connectivity : {3, 4, 5, 6, 7})
    (void)known_.positions(domain(connectivity));
  EXPECT_TRUE(space.expired());
  EXPECT_TRUE(positions.expired());
}

}  // namespace
}  // namespace meniscus::fem
