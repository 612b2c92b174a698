#include "meniscus/transport/surface_mass.hpp"

#include <Eigen/SparseCholesky>

#include "meniscus/core/error.hpp"
#include "meniscus/transport/vertex_vectors.hpp"

namespace meniscus {

SurfaceMass::SurfaceMass(const CarrierSurface& surface) : M_(surface.assembled(surface.masses())) {}

VertexField<double> SurfaceMass::amounts(const VertexField<double>& concentration) const {
  MENISCUS_ASSERT(concentration.size() == M_.rows(), "{} {}", concentration.size(), M_.rows());
  return field_of(M_ * vector_of(concentration));
}

VertexField<double> SurfaceMass::concentration(const VertexField<double>& amounts) const {
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(M_);
  MENISCUS_ASSERT(factors.info() == Eigen::Success, "a face without area");
  return field_of(factors.solve(vector_of(amounts)));
}

double SurfaceMass::total(const VertexField<double>& concentration) const {
  return vector_of(areas()).dot(vector_of(concentration));
}

VertexField<double> SurfaceMass::areas() const {
  return field_of(M_ * Eigen::VectorXd::Ones(M_.cols()));
}

}  // namespace meniscus
