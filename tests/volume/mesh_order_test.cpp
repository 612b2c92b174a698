#include "meniscus/volume/mesh_order.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "meniscus/volume/tetrahedralize.hpp"
#include "tests/volume/scenes.hpp"

namespace meniscus {
namespace {

/// A cell by where its corners are, in their order.
using Corners = std::array<std::array<double, 3>, 4>;

std::map<Corners, int> corners(const Field<TetVertexId, Vec3>& x,
                               const CellField<CellVertices>& cells) {
  std::map<Corners, int> result;
  for (const CellVertices& cell : cells) {
    Corners key;
    for (std::size_t k = 0; k < 4; ++k) key[k] = {x[cell[k]].x(), x[cell[k]].y(), x[cell[k]].z()};
    ++result[key];
  }
  return result;
}

/// Mean distance in memory of the vertices of a cell.
double spread(const CellField<CellVertices>& cells) {
  double sum = 0.0;
  for (const CellVertices& cell : cells) {
    const auto [low, high] = std::ranges::minmax(cell);
    sum += high.value - low.value;
  }
  return sum / cells.size();
}

/// A mesh whose vertices and cells lie in any order.
struct Shuffled {
  Field<TetVertexId, Vec3> x;
  CellField<CellVertices> cells;
  explicit Shuffled(const TetMesh& mesh) : x(mesh.num_vertices()) {
    std::mt19937 random(20013);
    std::vector<std::int32_t> number(static_cast<std::size_t>(mesh.num_vertices()));
    std::vector<std::int32_t> order(static_cast<std::size_t>(mesh.num_cells()));
    std::iota(number.begin(), number.end(), 0);
    std::iota(order.begin(), order.end(), 0);
    std::ranges::shuffle(number, random);
    std::ranges::shuffle(order, random);
    const auto renamed = [&](TetVertexId v) {
      return TetVertexId{number[static_cast<std::size_t>(v.value)]};
    };
    for (const TetVertexId v : mesh.x.ids()) x[renamed(v)] = mesh.x[v];
    for (const std::int32_t c : order) {
      CellVertices cell = mesh.cells[CellId{c}];
      for (TetVertexId& v : cell) v = renamed(v);
      cells.add(cell);
    }
  }
};

TEST(MeshOrder, IsTheSameMeshWithNeighboursTogether) {
  TetMesh mesh;
  ASSERT_TRUE(tetrahedralize(test::drop_in_sphere(400, 6.0, 400), {}, mesh).ok());
  const Shuffled before(mesh);
  Shuffled after = before;
  constexpr std::int32_t num_fixed = 50;
  order_by_neighbourhood(num_fixed, after.x, after.cells);
  EXPECT_EQ(corners(after.x, after.cells), corners(before.x, before.cells));
  for (const TetVertexId v : ids<TetVertexId>(num_fixed)) EXPECT_EQ(after.x[v], before.x[v]);
  // A breadth-first search keeps neighbours within two of its fronts of each other, some
  // 3 n^(2/3) vertices; in any order they are 0.6 n apart.
  const double n = mesh.num_vertices();
  EXPECT_LT(spread(after.cells), 2.0 * 3.0 * std::cbrt(n * n));
  EXPECT_LT(spread(after.cells), 0.5 * spread(before.cells));
}

}  // namespace
}  // namespace meniscus
