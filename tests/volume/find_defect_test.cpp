#include <algorithm>

#include <gtest/gtest.h>

#include "meniscus/volume/tetrahedralize.hpp"
#include "tests/volume/scenes.hpp"

namespace meniscus {
namespace {

/// A valid mesh that each test spoils in one way.
class FindDefect : public ::testing::Test {
 protected:
  void SetUp() override {
    scene_ = test::scene_within(sphere(80, 4.0));
    test::add_drop(scene_, sphere(80, 1.5));
    test::add_drop(scene_, sphere(60, 0.6), RegionId{1});
    ASSERT_TRUE(tetrahedralize(scene_, {}, mesh_).ok());
    ASSERT_EQ(text_of(find_defect(mesh_, scene_)), "");
  }
  void expect_defect(const std::string& word) const {
    const std::string defect = text_of(find_defect(mesh_, scene_));
    EXPECT_NE(defect.find(word), std::string::npos) << "found: '" << defect << "'";
  }
  /// A cell none of whose vertices lies on a surface.
  CellId free_cell() const {
    const std::int32_t first = mesh_.boundary.first_vertex.value + mesh_.boundary.num_vertices;
    for (const CellId c : mesh_.cells.ids())
      if (std::ranges::all_of(mesh_.cells[c], [&](TetVertexId v) { return v.value >= first; }))
        return c;
    ADD_FAILURE() << "no free cell";
    return {0};
  }
  void drop_cell(CellId c) {
    std::vector<CellVertices> cells(mesh_.cells.begin(), mesh_.cells.end());
    std::vector<RegionId> regions(mesh_.region.begin(), mesh_.region.end());
    cells.erase(cells.begin() + c.value);
    regions.erase(regions.begin() + c.value);
    mesh_.cells = CellField<CellVertices>(std::move(cells));
    mesh_.region = CellField<RegionId>(std::move(regions));
    for (auto* surface : {&mesh_.interfaces[0], &mesh_.interfaces[1], &mesh_.boundary})
      for (auto& sides : surface->sides)
        for (CellId* side : {&sides.inside, &sides.outside})
          if (side->value > c.value) --side->value;
  }
  Scene scene_;
  TetMesh mesh_;
};

TEST_F(FindDefect, FlippedCell) {
  std::swap(mesh_.cells[free_cell()][0], mesh_.cells[free_cell()][1]);
  expect_defect("has volume");
}

TEST_F(FindDefect, FlattenedCell) {
  const CellVertices& v = mesh_.cells[free_cell()];
  mesh_.x[v[0]] = (mesh_.x[v[1]] + mesh_.x[v[2]] + mesh_.x[v[3]]) / 3.0;
  expect_defect("has volume");
}

TEST_F(FindDefect, RelabelledCellInside) {
  mesh_.region[free_cell()] = RegionId{2};
  expect_defect("another region than its neighbour");
}

TEST_F(FindDefect, RelabelledCellAtAnInterface) {
  mesh_.region[mesh_.interfaces[0].sides[FaceId{3}].inside] = RegionId{0};
  expect_defect("wrong region inside");
}

TEST_F(FindDefect, WholeRegionRelabelled) {
  for (const CellId c : mesh_.cells.ids())
    if (mesh_.region[c] == RegionId{2}) mesh_.region[c] = RegionId{1};
  expect_defect("interface 1");
}

TEST_F(FindDefect, RegionThatIsNone) {
  mesh_.region[free_cell()] = RegionId{17};
  EXPECT_NE(text_of(find_defect(mesh_, scene_)), "");
  mesh_.region[free_cell()] = RegionId{};
  EXPECT_NE(text_of(find_defect(mesh_, scene_)), "");
}

TEST_F(FindDefect, MovedSurfaceVertex) {
  mesh_.x[mesh_.interfaces[1].vertex(VertexId{5})].x() += 1e-13;
  expect_defect("interface 1: vertex 5");
}

TEST_F(FindDefect, MovedBoundaryVertex) {
  mesh_.x[mesh_.boundary.vertex(VertexId{5})].x() += 1e-13;
  expect_defect("outer boundary: vertex 5");
}

TEST_F(FindDefect, MissingCell) {
  drop_cell(free_cell());
  expect_defect("open to nothing");
}

TEST_F(FindDefect, MissingCellAtAnInterface) {
  drop_cell(mesh_.interfaces[0].sides[FaceId{7}].outside);
  expect_defect("interface 0: face 7");
}

TEST_F(FindDefect, CellTwice) {
  const CellId c = free_cell();
  const CellVertices copy = mesh_.cells[c];
  const RegionId region = mesh_.region[c];
  mesh_.cells.add(copy);
  mesh_.region.add(region);
  expect_defect("overlaps");
}

TEST_F(FindDefect, WrongSides) {
  auto& sides = mesh_.interfaces[0].sides[FaceId{0}];
  std::swap(sides.inside, sides.outside);
  expect_defect("other cells at its sides");
}

TEST_F(FindDefect, VertexOutOfRange) {
  mesh_.cells[free_cell()][2] = TetVertexId{mesh_.num_vertices()};
  expect_defect("missing vertex");
}

TEST_F(FindDefect, MeshOfAnotherScene) {
  Scene other = scene_;
  other.interfaces.pop_back();
  EXPECT_NE(text_of(find_defect(mesh_, other)), "");
  std::swap(scene_.interfaces[0], scene_.interfaces[1]);
  EXPECT_NE(text_of(find_defect(mesh_, scene_)), "");
}

}  // namespace
}  // namespace meniscus
