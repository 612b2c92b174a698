#include "meniscus/flow/fem/boundary_conditions.hpp"

#include <cmath>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "meniscus/flow/fem/face_elements.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "tests/flow/fem/straight_space.hpp"

namespace meniscus::fem {
namespace {

TEST(Constraints, FramesAreOrthonormalAndHoldTheNormals) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  const auto direction = [&] {
    return Vec3(normal(random), normal(random), normal(random)).normalized();
  };
  for (int trial = 0; trial < 200; ++trial) {
    Constraints constraints(1);
    std::vector<Vec3> normals;
    for (int k = 0; k <= trial % 3; ++k) normals.push_back(direction());
    normals.push_back(normals.front());  // a repeated one adds nothing
    constraints.forbid_penetration(NodeId{0}, normals);
    const NodeConstraint& constraint = *constraints.find(NodeId{0});
    EXPECT_LT((constraint.frame.transpose() * constraint.frame - Mat3::Identity()).norm(), 1e-13);
    EXPECT_EQ(std::ranges::count(constraint.is_fixed, true), trial % 3 + 1);
    Field<NodeId, Vec3> v(1, direction());
    constraints.impose(v);
    for (const Vec3& n : normals) EXPECT_NEAR(n.dot(v[NodeId{0}]), 0.0, 1e-12);
  }
}

TEST(Constraints, AxesStayCartesian) {
  Constraints constraints(1);
  constraints.forbid_penetration(NodeId{0}, std::vector<Vec3>{-Vec3::UnitZ(), Vec3::UnitX()});
  const NodeConstraint& constraint = *constraints.find(NodeId{0});
  EXPECT_FALSE(constraint.is_rotated());
  EXPECT_EQ(constraint.is_fixed, (std::array<bool, 3>{true, false, true}));
}

TEST(Constraints, TheLastConditionOfAVertexHolds) {
  Constraints constraints(2);
  constraints.forbid_penetration(NodeId{1}, std::vector<Vec3>{Vec3(1, 1, 0).normalized()});
  constraints.fix(NodeId{1}, Vec3(1, 2, 3));
  EXPECT_EQ(constraints.find(NodeId{0}), nullptr);
  Field<NodeId, Vec3> v(2, Vec3::Zero());
  constraints.impose(v);
  EXPECT_EQ(v[NodeId{0}], Vec3(0, 0, 0));
  EXPECT_EQ(v[NodeId{1}], Vec3(1, 2, 3));
}

Vec3 shear(const Vec3& x) { return {x.y(), 0.0, 0.0}; }

TEST(BoundaryConditions, ImposedVelocityWinsThenEveryWall) {
  BoxMesh box = box_mesh({.n = 4});
  impose_everywhere(box.boundary, shear, true);
  for (const int wall : {2, 4, 5}) box.boundary.patches[PatchId{wall}].condition = NoPenetration{};
  const BoundaryConditions conditions = TestSpace(box.mesh).conditions(box.boundary);
  EXPECT_EQ(text_of(conditions.fault), "");
  EXPECT_FALSE(conditions.has_open_patch);
  for (const VertexId v : box.boundary.mesh.x.ids()) {
    const Vec3& x = box.boundary.mesh.x[v];
    const NodeConstraint* constraint =
        conditions.constraints.find(node_at(box.mesh.boundary.vertex(v)));
    ASSERT_NE(constraint, nullptr);
    const bool is_imposed = std::abs(x.x()) == 1.0 || x.y() == 1.0;
    const bool is_on_y = x.y() == -1.0, is_on_z = std::abs(x.z()) == 1.0;
    EXPECT_EQ(constraint->is_fixed,
              (std::array<bool, 3>{is_imposed, is_imposed || is_on_y, is_imposed || is_on_z}));
    if (is_imposed) {
      EXPECT_EQ(constraint->value, shear(x));
    }
  }
}

TEST(BoundaryConditions, InterpolatedFluxIsRemoved) {
  BoxMesh box = box_mesh({.n = 5});
  // Free of divergence, but not its interpolation on the faces.
  impose_everywhere(
      box.boundary,
      [](const Vec3& x) {
        return Vec3(std::sin(x[0] + 0.3) * std::cos(x[1]), -std::cos(x[0] + 0.3) * std::sin(x[1]),
                    x[0]);
      },
      false);
  const BoundaryConditions conditions = TestSpace(box.mesh).conditions(box.boundary);
  EXPECT_EQ(text_of(conditions.fault), "");
  const VertexField<Vec3> area = vertex_area_vectors(box.boundary.mesh);
  double flux = 0.0;
  for (const VertexId v : area.ids())
    flux += area[v].dot(conditions.constraints.find(node_at(box.mesh.boundary.vertex(v)))->value);
  EXPECT_NEAR(flux, 0.0, 1e-13);
}

/// A closed channel along x: in by a parabola and out by a flatter profile of the same flux, two
/// walls at rest and two that slide along x, their edges at rest.
BoxMesh closed_channel(int n) {
  const auto parabola = [](double s) { return 1.0 - s * s; };
  BoxMesh box = box_mesh({.n = n});
  impose_everywhere(
      box.boundary, [](const Vec3&) { return Vec3(0, 0, 0); }, false);
  const auto impose = [&](int patch, const std::function<Vec3(const Vec3&)>& velocity) {
    box.boundary.patches[PatchId{patch}].condition =
        ImposedVelocity{[velocity](const Vec3& x, double) { return velocity(x); }, false};
  };
  impose(0, [=](const Vec3& x) { return Vec3(parabola(x[1]) * parabola(x[2]), 0, 0); });
  // 5/6: ∫(1 − s²) ds over ∫(1 − s⁴) ds, both from −1 to 1.
  impose(1, [=](const Vec3& x) {
    return Vec3(5.0 / 6.0 * (1.0 - std::pow(x[1], 4)) * parabola(x[2]), 0, 0);
  });
  for (const int wall : {2, 3})
    impose(wall, [=](const Vec3& x) { return Vec3(parabola(x[0]) * parabola(x[2]), 0, 0); });
  return box;
}

TEST(BoundaryConditions, WallsDoNotCarryTheInterpolatedFlux) {
  for (const Elements elements : {Elements::p1_p1, Elements::p2_p1}) {
    const BoxMesh box = closed_channel(5);
    const TestSpace test(box.mesh, elements);
    const BoundaryConditions conditions = test.conditions(box.boundary);
    ASSERT_EQ(text_of(conditions.fault), "");
    double flux = 0.0, largest_change = 0.0;
    const Field<NodeId, Vec3> area = node_area_vectors(
        face_nodes(test.space, box.mesh, box.boundary.mesh, box.mesh.boundary), test.positions.x);
    for (const NodeConstraint& constraint : conditions.constraints.all()) {
      const Vec3& x = test.positions.x[constraint.node];
      flux += area[constraint.node].dot(constraint.value);
      if (x.cwiseAbs()[1] == 1.0 || x.cwiseAbs()[2] == 1.0) {
        const bool slides = x.cwiseAbs()[1] == 1.0;
        const double speed = slides ? (1.0 - x[0] * x[0]) * (1.0 - x[2] * x[2]) : 0.0;
        EXPECT_EQ(constraint.value, Vec3(speed, 0, 0)) << x.transpose();
      } else if (x[0] == -1.0) {
        const double imposed = (1.0 - x[1] * x[1]) * (1.0 - x[2] * x[2]);
        largest_change = std::max(largest_change, std::abs(constraint.value[0] / imposed - 1.0));
      }
    }
    EXPECT_NEAR(flux, 0.0, 1e-14);
    // Linear functions miss h²/4 and 5h²/12 of the two fluxes, 4 % and 6.7 %; each end is given
    // half of the difference. Quadratic ones miss less.
    EXPECT_GT(largest_change, 0.0);
    EXPECT_LT(largest_change, 0.02);
  }
}

// No-slip walls all around but a sliding lid leak where the lid's edges meet walls, and there
// alone.
TEST(BoundaryConditions, SlidingLidKeepsItsVelocityButAtItsEdges) {
  BoxMesh box = box_mesh({.n = 4});
  impose_everywhere(
      box.boundary, [](const Vec3&) { return Vec3(0, 0, 0); }, false);
  box.boundary.patches[PatchId{0}].condition =
      ImposedVelocity{[](const Vec3& x, double) { return Vec3(0, 1.0 + 0.1 * x.y(), 0); }, false};
  const TestSpace test(box.mesh);
  const BoundaryConditions conditions = test.conditions(box.boundary);
  ASSERT_EQ(text_of(conditions.fault), "");
  for (const NodeConstraint& constraint : conditions.constraints.all()) {
    const Vec3& x = test.positions.x[constraint.node];
    const bool is_lid = x.x() == -1.0, leaks = is_lid && std::abs(x.y()) == 1.0;
    if (leaks) continue;
    EXPECT_EQ(constraint.value, Vec3(0, is_lid ? 1.0 + 0.1 * x.y() : 0.0, 0)) << x.transpose();
  }
}

TEST(BoundaryConditions, NetInflowNeedsAnOpenPatch) {
  BoxMesh box = box_mesh({.n = 3});
  impose_everywhere(box.boundary, shear, true);
  box.boundary.patches[PatchId{0}].condition =
      ImposedVelocity{[](const Vec3&, double) { return Vec3(2.0, 0.0, 0.0); }, false};
  EXPECT_NE(text_of(TestSpace(box.mesh).conditions(box.boundary).fault).find("net flux"),
            std::string::npos);
  box.boundary.patches[PatchId{1}].condition = ImposedTraction{Vec3(-1.0, 0.0, 0.0)};
  const BoundaryConditions open = TestSpace(box.mesh).conditions(box.boundary);
  EXPECT_EQ(text_of(open.fault), "");
  EXPECT_TRUE(open.has_open_patch);
  Vec3 sum = Vec3::Zero();
  for (const Vec3& traction : open.traction) sum += traction;
  EXPECT_LT((sum - Vec3(-4.0, 0.0, 0.0)).norm(), 1e-13);  // area 4
}

TEST(BoundaryConditions, OnePatchMayHaveSeveralWalls) {
  // All six sides in one patch without penetration: a corner has three normals, an edge two.
  BoxMesh box = box_mesh({.n = 3});
  for (PatchId& patch : box.boundary.patch) patch = PatchId{0};
  for (const Elements elements : {Elements::p1_p1, Elements::p2_p1}) {
    const TestSpace test(box.mesh, elements);
    const FaceNodeTable walls =
        face_nodes(test.space, box.mesh, box.boundary.mesh, box.mesh.boundary);
    const PieceNormals normals =
        piece_normals(box.boundary, {PatchId{0}}, walls, test.space.velocity.num_nodes);
    for (const NodeId i : test.positions.x.ids()) {
      const Vec3 at = test.positions.x[i].cwiseAbs();
      EXPECT_EQ(static_cast<int>(normals.of(i).size()), (at.array() == 1.0).count());
    }
  }
}

}  // namespace
}  // namespace meniscus::fem
