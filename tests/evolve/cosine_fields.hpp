#pragma once

#include <vector>

#include "meniscus/evolve/evolution.hpp"

namespace meniscus::test {

/// 2 + cos(2x + y − z/2) on vertices, conserved ("gamma") and interpolated ("label"), and conserved
/// on faces ("load"). It runs from 1 to 3.
[[nodiscard]] SurfaceFields cosines(const SurfaceMesh& mesh);
/// Interpolated at vertices ("temperature") and conserved in cells ("species").
[[nodiscard]] VolumeFields cosines(const TetMesh& mesh);
/// Puts them on every interface and on the mesh, if there is one.
void put_cosines(Evolution& evolution);

/// Σ value · measure of what is conserved, on the interfaces and by region.
struct Amounts {
  double on_vertices = 0.0, on_faces = 0.0;
  std::vector<double> in_cells;
};
[[nodiscard]] Amounts amounts(const State& state);
void expect_kept(const Amounts& now, const Amounts& before, double tolerance);

/// Solves and advances; both must succeed.
void step(Evolution& evolution);

}  // namespace meniscus::test
