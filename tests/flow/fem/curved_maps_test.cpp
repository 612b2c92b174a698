#include "meniscus/flow/fem/curved_maps.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "meniscus/flow/fem/elements.hpp"
#include "meniscus/volume/tetrahedralize.hpp"
#include "tests/flow/fem/sphere_scene.hpp"
#include "tests/flow/fem/straight_space.hpp"

namespace meniscus::fem {
namespace {

using Barycentric = std::array<double, 4>;

/// A ball in another whose edges are all bent a little.
class BentCells : public testing::Test {
 protected:
  BentCells() {
    const Scene scene = sphere_in_sphere({.num_vertices = 42, .outer_radius = 3.0});
    EXPECT_TRUE(tetrahedralize(scene, {}, mesh_).ok());
    space_ = flow_space(mesh_, Elements::p2_p1);
    positions_ = straight_positions(mesh_, space_);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> bend(-0.01, 0.01);
    for (std::int32_t i = space_.num_vertices(); i < space_.velocity.num_nodes; ++i)
      positions_.x[NodeId{i}] += Vec3(bend(random), bend(random), bend(random));
  }
  [[nodiscard]] Vec3 place(CellId c, const Barycentric& b) const {
    const auto shape = quadratic_tetrahedron_values(b);
    Vec3 x = Vec3::Zero();
    for (std::size_t i = 0; i < shape.size(); ++i)
      x += shape[i] * positions_.x[NodeId{space_.velocity.of(c)[i]}];
    return x;
  }
  /// ∂x/∂b_l by columns, b_0 falling as b_l rises. Central differences of quadratics are exact.
  [[nodiscard]] Mat3 jacobian(CellId c, const Barycentric& b) const {
    constexpr double h = 0.25;
    Mat3 result;
    for (std::size_t l = 1; l < 4; ++l) {
      Barycentric more = b, less = b;
      more[l] += h, more[0] -= h;
      less[l] -= h, less[0] += h;
      result.col(static_cast<Eigen::Index>(l) - 1) = (place(c, more) - place(c, less)) / (2.0 * h);
    }
    return result;
  }
  [[nodiscard]] std::vector<CellId> cells() const {
    std::vector<CellId> result;
    for (const CellId c : mesh_.cells.ids()) result.push_back(c);
    while (result.size() % 4 != 1) result.pop_back();  // the last four are not full
    return result;
  }
  TetMesh mesh_;
  FlowSpace space_;
  NodePositions positions_;
};

TEST_F(BentCells, MapsAreThoseOfDifferences) {
  const std::vector<CellId> cells = this->cells();
  const std::vector<CurvedMaps> maps = curved_maps(positions_.x, space_.velocity, cells);
  ASSERT_EQ(maps.size(), cells.size());
  for (std::size_t n = 0; n < cells.size(); ++n)
    for (std::size_t q = 0; q < maps[n].size(); ++q) {
      const auto& [b, share] = kTetrahedronRule5[q];
      const Mat3 J = jacobian(cells[n], b);
      EXPECT_NEAR(maps[n][q].weight, share * J.determinant() / 6.0, 1e-13);
      for (Eigen::Index l = 0; l < 3; ++l) {
        const Vec3 row = J.transpose() * maps[n][q].gradient[static_cast<std::size_t>(l)];
        EXPECT_LT((row - Vec3::Unit(l)).norm(), 1e-10);
      }
    }
}

TEST_F(BentCells, LeastJacobiansAreTheLeastOfRuleAndNodes) {
  const std::vector<CellId> cells = this->cells();
  const std::vector<double> least = least_jacobians(positions_.x, space_.velocity, cells);
  ASSERT_EQ(least.size(), cells.size());
  for (std::size_t n = 0; n < cells.size(); ++n) {
    double expected = std::numeric_limits<double>::infinity();
    const auto look_at = [&](const Barycentric& b) {
      expected = std::min(expected, jacobian(cells[n], b).determinant());
    };
    for (const auto& point : kTetrahedronRule5) look_at(point.barycentric);
    for (std::size_t i = 0; i < 4; ++i) {
      Barycentric corner{};
      corner[i] = 1.0;
      look_at(corner);
    }
    for (const auto& [p, q] : kCellEdges) {
      Barycentric middle{};
      middle[p] = middle[q] = 0.5;
      look_at(middle);
    }
    EXPECT_NEAR(least[n], expected, 1e-12);
  }
}

TEST_F(BentCells, EachCurvedCellHasItsMaps) {
  for (const CellId c : mesh_.cells.ids()) positions_.is_curved[c] = c.value % 3 == 1;
  const MapsOfCurvedCells maps(space_, positions_);
  for (const CellId c : mesh_.cells.ids()) {
    if (positions_.is_curved[c] == 0) continue;
    const CurvedMaps alone =
        curved_maps(positions_.x, space_.velocity, std::vector<CellId>{c}).front();
    for (std::size_t q = 0; q < alone.size(); ++q) {
      EXPECT_EQ(maps.of(c)[q].weight, alone[q].weight);
      EXPECT_EQ(maps.of(c)[q].gradient, alone[q].gradient);
    }
  }
}

}  // namespace
}  // namespace meniscus::fem
