#include "meniscus/transport/surface_mass.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>

#include "meniscus/core/error.hpp"
#include "meniscus/transport/vertex_vectors.hpp"

namespace meniscus {

namespace {

/// Iterates from a guess, as masses are well conditioned; factors serve where that comes to no end.
Eigen::VectorXd solved(const Eigen::SparseMatrix<double>& M, const Eigen::VectorXd& right,
                       const Eigen::VectorXd& guess) {
  constexpr double kTolerance = 1e-15;
  constexpr int kMostIterations = 150;
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> iteration(M);
  iteration.setTolerance(kTolerance);
  iteration.setMaxIterations(kMostIterations);
  Eigen::VectorXd solution = iteration.solveWithGuess(right, guess);
  if (iteration.info() == Eigen::Success && solution.allFinite()) return solution;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(M);
  MENISCUS_ASSERT(factors.info() == Eigen::Success, "a face without area");
  return factors.solve(right);
}

}  // namespace

SurfaceMass::SurfaceMass(const CarrierSurface& surface) : M_(surface.assembled(surface.masses())) {}

VertexField<double> SurfaceMass::amounts(const VertexField<double>& concentration) const {
  MENISCUS_ASSERT(concentration.size() == M_.rows(), "{} {}", concentration.size(), M_.rows());
  return field_of(M_ * vector_of(concentration));
}

VertexField<double> SurfaceMass::concentration(const VertexField<double>& amounts) const {
  MENISCUS_ASSERT(amounts.size() == M_.rows(), "{} {}", amounts.size(), M_.rows());
  const Eigen::VectorXd wanted = vector_of(amounts), areas = vector_of(this->areas());
  Eigen::VectorXd found = solved(M_, wanted, wanted.cwiseQuotient(areas));
  // What iterations leave of the sum of the amounts.
  found.array() += (wanted.sum() - areas.dot(found)) / areas.sum();
  return field_of(found);
}

double SurfaceMass::total(const VertexField<double>& concentration) const {
  return vector_of(areas()).dot(vector_of(concentration));
}

VertexField<double> SurfaceMass::areas() const {
  return field_of(M_ * Eigen::VectorXd::Ones(M_.cols()));
}

}  // namespace meniscus
