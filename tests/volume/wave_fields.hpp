#pragma once

#include <functional>

#include "meniscus/mesh/carried_fields.hpp"
#include "tests/volume/scenes.hpp"

namespace meniscus::test {

using Function = std::function<double(const Vec3&)>;

/// 1.5 + a cosine.
[[nodiscard]] double wave(const Vec3& x);

/// Tetrahedra of one size everywhere.
[[nodiscard]] TetMesh meshed(const Scene& scene, double cell_volume = 2.0);
/// A drop in a sphere of radius 2, turned, so that its interface has other triangles.
[[nodiscard]] Scene turned_scene(int vertices, unsigned seed);

/// A function in the cells, conserved ("amount") and interpolated ("level"), and at vertices
/// ("nodal").
[[nodiscard]] VolumeFields sampled(const TetMesh& mesh, const Function& f);
/// Σ value |c| of each region.
[[nodiscard]] std::vector<double> amounts(const TetMesh& mesh, const CellField<double>& values);

/// √(∫ (v − wave)² dV / V), of means over the cells.
[[nodiscard]] double cell_error(const TetMesh& mesh, const CellField<double>& values);
/// Over the vertices between the surfaces: those on unchanged surfaces have no error, and their
/// share falls with refinement.
[[nodiscard]] double vertex_error(const TetMesh& mesh, const Field<TetVertexId, double>& values);

}  // namespace meniscus::test
