#include "meniscus/flow/fem/slow_modes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include <gtest/gtest.h>

#include "meniscus/flow/fem/drop_sections.hpp"
#include "tests/flow/fem/stage_from_rest.hpp"
#include "tests/flow/fem/straight_space.hpp"
#include "tests/flow/fem/stretched_drop.hpp"

namespace meniscus::fem {
namespace {

constexpr RegionId kDrop{1};

class DropSections : public testing::TestWithParam<DropShape> {
 protected:
  DropSections() : scene_(stretched_drop(GetParam(), 110, 100.0)) {
    EXPECT_TRUE(tetrahedralize(scene_, {}, mesh_).ok());
  }
  [[nodiscard]] std::vector<char> touches_drop() const {
    std::vector<char> touches(static_cast<std::size_t>(mesh_.num_vertices()), 0);
    for (const CellId c : mesh_.cells.ids())
      for (const TetVertexId v : mesh_.cells[c])
        if (mesh_.region[c] == kDrop) touches[static_cast<std::size_t>(v.value)] = 1;
    return touches;
  }
  Scene scene_;
  TetMesh mesh_;
};
INSTANTIATE_TEST_SUITE_P(Shapes, DropSections,
                         testing::Values(DropShape::sphere, DropShape::prolate,
                                         DropShape::dumbbell));

TEST_P(DropSections, AddUpToTheDropAndFade) {
  const std::vector<VertexWeights> all = sections(mesh_, kDrop, 8);
  EXPECT_EQ(all.size() == 1, GetParam() == DropShape::sphere);
  const std::vector<char> in_drop = touches_drop();
  double farthest = 0.0;
  for (const TetVertexId v : mesh_.x.ids()) {
    double sum = 0.0;
    for (const VertexWeights& section : all) {
      EXPECT_GE(section[v], 0.0);
      sum += section[v];
    }
    if (in_drop[static_cast<std::size_t>(v.value)] != 0) {
      EXPECT_NEAR(sum, 1.0, 1e-12);
    } else if (sum > 0.0) {
      EXPECT_LT(sum, 1.0);
      double distance = 1e9;
      for (const TetVertexId w : mesh_.x.ids())
        if (in_drop[static_cast<std::size_t>(w.value)] != 0)
          distance = std::min(distance, (mesh_.x[v] - mesh_.x[w]).norm());
      EXPECT_LE(sum, 1.0 - distance + 1e-12);  // a path is no shorter than the straight line
      farthest = std::max(farthest, distance);
    }
  }
  EXPECT_GT(farthest, 0.2);
}

// Each end of a long drop is another section's.
TEST_P(DropSections, DivideItsLength) {
  const std::vector<VertexWeights> all = sections(mesh_, kDrop, 8);
  const EmbeddedSurface& surface = mesh_.interfaces[0];
  TetVertexId left = surface.first_vertex, right = left;
  for (std::int32_t v = 0; v < surface.num_vertices; ++v) {
    const TetVertexId here = surface.vertex(VertexId{v});
    if (mesh_.x[here].x() < mesh_.x[left].x()) left = here;
    if (mesh_.x[here].x() > mesh_.x[right].x()) right = here;
  }
  for (const VertexWeights& section : all)
    if (all.size() > 1) {
      EXPECT_EQ(section[left] * section[right], 0.0);
    }
}

TEST(SlowModes, AreOfDropsMuchStifferOrThinner) {
  const auto modes = [](DropShape shape, double lambda) {
    const Scene scene = stretched_drop(shape, 60, lambda);
    TetMesh mesh;
    EXPECT_TRUE(tetrahedralize(scene, {}, mesh).ok());
    const FlowSpace space = flow_space(mesh, Elements::p2_p1);
    const SlowModes found = slow_modes(instant(scene, mesh, space));
    EXPECT_EQ(found.velocities.num_columns, 3 * space.velocity.num_nodes);
    EXPECT_EQ(found.pressures.num_columns, static_cast<int>(space.pressure.vertex.size()));
    return std::array{found.velocities.view().num_rows, found.pressures.view().num_rows};
  };
  EXPECT_EQ(modes(DropShape::sphere, 1.0), (std::array{0, 0}));
  EXPECT_EQ(modes(DropShape::sphere, 100.0), (std::array{6, 0}));
  EXPECT_EQ(modes(DropShape::sphere, 0.01), (std::array{0, 0}));
  const auto [stiff, none] = modes(DropShape::dumbbell, 100.0);
  EXPECT_GE(stiff, 18);
  EXPECT_EQ(stiff % 6, 0);
  EXPECT_EQ(none, 0);
  EXPECT_EQ(modes(DropShape::dumbbell, 0.01), (std::array{0, stiff / 6}));
}

// A thin drop's sections have their weights w. Where a stage is long, w (x − x̄) along each axis
// comes to each, x̄ being the mean of the vertices by w.
TEST(SlowModes, OfThinDropsInLongStagesVaryAlongAxes) {
  StageFromRest stage(pushed_drop(42), DropShape::dumbbell, Elements::p2_p1);
  const auto pressures = [&](double duration) {
    return slow_modes(stage.problem({.viscosity_ratio = 0.01}, duration)).pressures;
  };
  const std::int32_t sections = pressures(std::numeric_limits<double>::infinity()).view().num_rows;
  ASSERT_GT(sections, 1);
  EXPECT_EQ(pressures(0.01).view().num_rows, sections);
  const linear::CsrMatrix all = pressures(10.0);
  ASSERT_EQ(all.view().num_rows, 4 * sections);
  const auto entries = [&](std::int32_t row) {
    const auto begin = static_cast<std::size_t>(all.row_start[static_cast<std::size_t>(row)]),
               end = static_cast<std::size_t>(all.row_start[static_cast<std::size_t>(row) + 1]);
    return std::pair(std::span(all.columns).subspan(begin, end - begin),
                     std::span(all.values).subspan(begin, end - begin));
  };
  for (std::int32_t section = 0; section < sections; ++section) {
    const auto [columns, weights] = entries(4 * section);
    for (int k = 0; k < 3; ++k) {
      const auto [same, products] = entries(4 * section + 1 + k);
      ASSERT_TRUE(std::ranges::equal(same, columns));
      const auto x = [&](std::size_t n) {
        return stage.mesh()
            .x[stage.space().pressure.vertex[static_cast<std::size_t>(columns[n])]][k];
      };
      double sum = 0.0;
      for (std::size_t n = 0; n < columns.size(); ++n) {
        sum += products[n];
        EXPECT_NEAR(products[n] / weights[n] - products[0] / weights[0], x(n) - x(0), 1e-11);
      }
      EXPECT_NEAR(sum, 0.0, 1e-10);
    }
  }
}

// On straight cells the velocities of a sphere's single section are rigid motions: in the drop
// their rate of strain is zero.
TEST(SlowModes, OfASphereAreItsRigidMotions) {
  const Scene scene = stretched_drop(DropShape::sphere, 60, 100.0);
  TetMesh mesh;
  ASSERT_TRUE(tetrahedralize(scene, {}, mesh).ok());
  const FlowSpace space = flow_space(mesh, Elements::p1_p1);
  const SlowModes modes = slow_modes(instant(scene, mesh, space));
  for (std::size_t row = 0; row < 6; ++row) {
    Field<NodeId, Vec3> v(space.velocity.num_nodes, Vec3::Zero());
    for (auto n = modes.velocities.row_start[row]; n < modes.velocities.row_start[row + 1]; ++n) {
      const std::int32_t column = modes.velocities.columns[static_cast<std::size_t>(n)];
      v[NodeId{column / 3}][column % 3] = modes.velocities.values[static_cast<std::size_t>(n)];
    }
    double largest = 0.0;
    for (const CellId c : mesh.cells.ids()) {
      if (mesh.region[c] != kDrop) continue;
      // Distances do not change where the motion is rigid.
      for (const TetVertexId a : mesh.cells[c])
        for (const TetVertexId b : mesh.cells[c]) {
          EXPECT_NEAR((v[node_at(a)] - v[node_at(b)]).dot(mesh.x[a] - mesh.x[b]), 0.0, 1e-12);
          largest = std::max(largest, v[node_at(a)].norm());
        }
    }
    EXPECT_GT(largest, 0.5);
  }
}

}  // namespace
}  // namespace meniscus::fem
