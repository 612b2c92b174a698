#include "meniscus/transport/surface_mass.hpp"

#include <vector>

#include <Eigen/SparseCholesky>

#include "meniscus/core/error.hpp"
#include "meniscus/transport/vertex_vectors.hpp"

namespace meniscus {

SurfaceMass::SurfaceMass(const CarrierSurface& surface)
    : M_(surface.mesh().num_vertices(), surface.mesh().num_vertices()) {
  const SurfaceMesh& mesh = surface.mesh();
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(9 * static_cast<std::size_t>(mesh.num_faces()));
  for (const FaceId f : mesh.faces.ids()) {
    Eigen::Matrix3d mass = Eigen::Matrix3d::Zero();
    for (const CarrierSurface::Point& point : surface.points(f)) {
      const Eigen::Map<const Vec3> value(point.value.data());
      mass += 0.5 * point.area * (value * value.transpose() + Mat3(value.asDiagonal()));
    }
    for (Eigen::Index a = 0; a < 3; ++a)
      for (Eigen::Index b = 0; b < 3; ++b)
        entries.emplace_back(mesh.faces[f][static_cast<std::size_t>(a)].value,
                             mesh.faces[f][static_cast<std::size_t>(b)].value, mass(a, b));
  }
  M_.setFromTriplets(entries.begin(), entries.end());
}

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
