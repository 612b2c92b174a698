#include "tests/volume/wave_fields.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "meniscus/volume/tetrahedralize.hpp"

namespace meniscus::test {
namespace {

/// Means over the cells by a rule of degree 2.
CellField<double> means(const TetMesh& mesh, const Function& f) {
  constexpr double a = 0.5854101966249685, b = 0.1381966011250105;  // (5 + 3√5)/20 and (5 − √5)/20
  CellField<double> values;
  for (const CellId c : mesh.cells.ids()) {
    double sum = 0.0;
    for (std::size_t k = 0; k < 4; ++k) {
      Vec3 x = Vec3::Zero();
      for (std::size_t j = 0; j < 4; ++j) x += (j == k ? a : b) * mesh.x[mesh.cells[c][j]];
      sum += 0.25 * f(x);
    }
    values.add(sum);
  }
  return values;
}

}  // namespace

double wave(const Vec3& x) { return 1.5 + std::cos(1.3 * x.x() + 0.7 * x.y() - 0.4 * x.z() + 0.3); }

TetMesh meshed(const Scene& scene, double cell_volume) {
  TetMesh mesh;
  EXPECT_TRUE(
      tetrahedralize(scene, {.interior_growth = 0.0, .cell_volume = cell_volume}, mesh).ok());
  return mesh;
}

Scene turned_scene(int vertices, unsigned seed) {
  std::mt19937 random(seed);
  const Mat3 turn = random_rotation(random);
  Scene scene = drop_in_sphere(vertices, 2.0, vertices);
  for (Vec3& x : scene.interfaces[0].mesh.x) x = turn * x;
  return scene;
}

VolumeFields sampled(const TetMesh& mesh, const Function& f) {
  VolumeFields fields;
  fields.on_cells.push_back({"amount", "", FieldTransfer::conserved, means(mesh, f)});
  fields.on_cells.push_back({"level", "", FieldTransfer::interpolated, means(mesh, f)});
  Field<TetVertexId, double> at_vertices;
  for (const Vec3& x : mesh.x) at_vertices.add(f(x));
  fields.on_vertices.push_back({"nodal", "", FieldTransfer::interpolated, at_vertices});
  return fields;
}

std::vector<double> amounts(const TetMesh& mesh, const CellField<double>& values) {
  std::vector<long double> sums;
  for (const CellId c : mesh.cells.ids()) {
    const auto r = static_cast<std::size_t>(mesh.region[c].value);
    if (sums.size() <= r) sums.resize(r + 1, 0.0L);
    sums[r] += static_cast<long double>(values[c]) * signed_volume(mesh, c);
  }
  return {sums.begin(), sums.end()};
}

double cell_error(const TetMesh& mesh, const CellField<double>& values) {
  const CellField<double> exact = means(mesh, wave);
  double sum = 0.0, volume = 0.0;
  for (const CellId c : mesh.cells.ids()) {
    sum += std::pow(values[c] - exact[c], 2) * signed_volume(mesh, c);
    volume += signed_volume(mesh, c);
  }
  return std::sqrt(sum / volume);
}

double vertex_error(const TetMesh& mesh, const Field<TetVertexId, double>& values) {
  double sum = 0.0, volume = 0.0;
  for (const CellId c : mesh.cells.ids())
    for (const TetVertexId v : mesh.cells[c]) {
      if (v.value < mesh.boundary.first_vertex.value + mesh.boundary.num_vertices) continue;
      sum += std::pow(values[v] - wave(mesh.x[v]), 2) * 0.25 * signed_volume(mesh, c);
      volume += 0.25 * signed_volume(mesh, c);
    }
  return std::sqrt(sum / volume);
}

}  // namespace meniscus::test
