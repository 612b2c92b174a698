#include "meniscus/volume/harmonic_extension.hpp"

#include <vector>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include "meniscus/geometry/tetrahedron.hpp"

namespace meniscus {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3>;

struct LinearSystem {
  Matrix matrix;
  Columns right;
};

LinearSystem assemble(const TetMesh& mesh, std::int32_t first_free,
                      const Field<TetVertexId, Vec3>& w) {
  const std::int32_t n = mesh.num_vertices() - first_free;
  LinearSystem system{Matrix(n, n), Columns::Zero(n, 3)};
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(16 * static_cast<std::size_t>(mesh.num_cells()));
  for (const CellId c : mesh.cells.ids()) {
    const CellVertices& v = mesh.cells[c];
    const std::array<Vec3, 4> gradients =
        linear_tetrahedron({mesh.x[v[0]], mesh.x[v[1]], mesh.x[v[2]], mesh.x[v[3]]}).gradient;
    for (std::size_t i = 0; i < 4; ++i) {
      const std::int32_t row = v[i].value - first_free;
      if (row < 0) continue;
      for (std::size_t j = 0; j < 4; ++j) {
        // ∫_K |K|⁻¹ ∇φ_i·∇φ_j
        const double entry = gradients[i].dot(gradients[j]);
        const std::int32_t column = v[j].value - first_free;
        if (column >= 0)
          entries.emplace_back(row, column, entry);
        else
          system.right.row(row) -= entry * w[v[j]];
      }
    }
  }
  system.matrix.setFromTriplets(entries.begin(), entries.end());
  return system;
}

}  // namespace

void extend_harmonically(const TetMesh& mesh, TetVertexId first_free, Field<TetVertexId, Vec3>& w) {
  if (first_free.value >= mesh.num_vertices()) return;
  const LinearSystem system = assemble(mesh, first_free.value, w);
  Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper> solver;
  // Any smooth extension will do, so the residual need not be small, and an iterate cut short after
  // a thousand steps (never seen; a hundred are usual) would do as well.
  solver.setTolerance(1e-6);
  solver.setMaxIterations(1000);
  solver.compute(system.matrix);
  const Columns solution = solver.solve(system.right);
  for (std::int32_t i = 0; i < solution.rows(); ++i)
    w[TetVertexId{first_free.value + i}] = solution.row(i);
}

}  // namespace meniscus
