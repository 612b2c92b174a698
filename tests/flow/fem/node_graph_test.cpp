#include "meniscus/flow/fem/node_graph.hpp"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"
#include "tests/flow/fem/box_mesh.hpp"

namespace meniscus::fem {
namespace {

TEST(NodeGraph, PositionsNameTheColumnsOfEveryCell) {
  const BoxMesh box = box_mesh({.n = 3});
  const NodeTable nodes = flow_space(box.mesh, Elements::p1_p1).velocity;
  const NodeGraph graph = node_graph(nodes, nodes);
  ASSERT_EQ(graph.num_rows(), box.mesh.num_vertices());
  for (const CellId c : box.mesh.cells.ids())
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < 4; ++b) {
        const auto row = static_cast<std::size_t>(nodes.of(c)[a]);
        const std::size_t k =
            graph.entry(nodes.of(c)[a], 16 * static_cast<std::size_t>(c.value) + 4 * a + b);
        EXPECT_GE(k, static_cast<std::size_t>(graph.row_start[row]));
        EXPECT_LT(k, static_cast<std::size_t>(graph.row_start[row + 1]));
        EXPECT_EQ(graph.columns[k], nodes.of(c)[b]);
      }
}

TEST(NodeGraph, RowsAreTheNeighboursInOrder) {
  const BoxMesh box = box_mesh({.n = 2});
  const NodeTable nodes = flow_space(box.mesh, Elements::p1_p1).velocity;
  std::vector<std::set<std::int32_t>> neighbours(std::size_t(nodes.num_nodes));
  for (const CellId c : box.mesh.cells.ids())
    for (const std::int32_t i : nodes.of(c))
      for (const std::int32_t j : nodes.of(c)) neighbours[std::size_t(i)].insert(j);
  const NodeGraph graph = node_graph(nodes, nodes);
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    const std::vector<std::int32_t> row(graph.columns.begin() + graph.row_start[i],
                                        graph.columns.begin() + graph.row_start[i + 1]);
    EXPECT_EQ(row, std::vector<std::int32_t>(neighbours[i].begin(), neighbours[i].end()));
  }
}

TEST(NodeGraph, BlocksAreDenseAndSideBySide) {
  NodeGraph graph;
  graph.num_columns = 3;
  graph.row_start = {0, 2, 3};
  graph.columns = {0, 2, 1};
  const ScalarPattern pattern = scalar_pattern(graph, 2, 3);
  EXPECT_EQ(pattern.row_start, (std::vector<std::int32_t>{0, 6, 12, 15, 18}));
  EXPECT_EQ(pattern.columns,
            (std::vector<std::int32_t>{0, 1, 2, 6, 7, 8, 0, 1, 2, 6, 7, 8, 3, 4, 5, 3, 4, 5}));
}

TEST(NodeGraph, MoreEntriesThan32BitsNumberAreRefused) {
  NodeGraph graph;
  graph.num_columns = 1;
  graph.row_start = {0, 1};
  graph.columns = {0};
  try {
    (void)scalar_pattern(graph, 1 << 16, 1 << 16);
    FAIL() << "2^32 entries were accepted";
  } catch (const RunFailure& failure) {
    EXPECT_NE(std::string(failure.what()).find("has 4294967296 matrix entries"), std::string::npos)
        << failure.what();
  }
}

TEST(PressureSpace, IsDoubledOnTheInterfaceAlone) {
  const BoxMesh box =
      box_mesh({.n = 4, .region = [](const Vec3& x) { return x.z() < 0.0 ? 1 : 0; }});
  const PressureSpace space = pressure_space(box.mesh);
  EXPECT_EQ(space.nodes.num_nodes, box.mesh.num_vertices() + 25);  // the plane z = 0 has 5 × 5
  EXPECT_TRUE(std::ranges::is_sorted(space.vertex));
  for (const CellId c : box.mesh.cells.ids())
    for (std::size_t i = 0; i < 4; ++i) {
      const auto node = static_cast<std::size_t>(space.nodes.of(c)[i]);
      EXPECT_EQ(space.vertex[node], box.mesh.cells[c][i]);
      EXPECT_EQ(space.region[node], box.mesh.region[c]);
    }
}

}  // namespace
}  // namespace meniscus::fem
