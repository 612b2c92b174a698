// A field held still through two hundred transfers between two meshes.
#include <array>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "meniscus/volume/field_transfer.hpp"
#include "tests/volume/wave_fields.hpp"

namespace meniscus {
namespace {

using test::cell_error, test::meshed, test::sampled, test::turned_scene, test::vertex_error,
    test::wave;

/// Errors of what is conserved in cells, interpolated in cells, and interpolated at vertices.
using Errors = std::array<double, 3>;

struct Level {
  double h = 0.0;
  Errors error = {};
};
Level after_transfers(int vertices, std::size_t count) {
  const TetMesh meshes[] = {meshed(turned_scene(vertices, 1)),
                            meshed(turned_scene(vertices, 2), 1.6)};
  VolumeFields fields = sampled(meshes[0], wave);
  FieldExcess excess;
  for (std::size_t k = 1; k <= count; ++k)
    fields = transfer_fields(fields, meshes[(k - 1) % 2], meshes[k % 2], excess);
  const TetMesh& last = meshes[count % 2];
  const Level level{
      1.0 / std::cbrt(last.num_cells()),
      {cell_error(last, fields.on_cells[0].values), cell_error(last, fields.on_cells[1].values),
       vertex_error(last, fields.on_vertices[0].values)}};
  std::printf("%d cells, %zu transfers: %.3e conserved, %.3e interpolated, %.3e at vertices\n",
              last.num_cells(), count, level.error[0], level.error[1], level.error[2]);
  std::fflush(stdout);
  return level;
}

// The root mean square of the wave about its mean is 0.6.
TEST(FieldTransfer, KeepsAHeldFieldBetterOnFinerMeshes) {
  for (const std::size_t count : {2U, 20U, 200U}) {
    std::array<Level, 3> levels;
    for (std::size_t i = 0; i < 3; ++i)
      levels[i] = after_transfers(std::array{60, 150, 400}[i], count);
    for (std::size_t field = 0; field < 3; ++field) {
      const double order = std::log(levels[0].error[field] / levels[2].error[field]) /
                           std::log(levels[0].h / levels[2].h);
      std::printf("order %.2f\n", order);
      if (field < 2) {
        EXPECT_GT(order, count < 200 ? 1.8 : 1.5);
      }
    }
  }
}

}  // namespace
}  // namespace meniscus
