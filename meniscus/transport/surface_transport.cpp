#include "meniscus/transport/surface_transport.hpp"

#include <array>
#include <numbers>
#include <vector>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>

#include "meniscus/core/error.hpp"
#include "meniscus/geometry/quadratic_triangle.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::SparseMatrix<double>;

/// Where the inner stage of SDIRK2 stands in a step.
constexpr double kInnerStage = 1.0 - std::numbers::sqrt2 / 2.0;

Vector vector_of(const VertexField<double>& values) {
  return Eigen::Map<const Vector>(values.span().data(), values.size());
}

VertexField<double> field_of(const Vector& values) {
  return VertexField<double>(std::vector<double>(values.begin(), values.end()));
}

VertexField<Vec3> along_surface(const SurfaceMesh& mesh, VertexField<Vec3> v) {
  const VertexField<Vec3> area = vertex_area_vectors(mesh);
  for (const VertexId i : v.ids()) {
    const Vec3 n = area[i].normalized();
    v[i] -= n * n.dot(v[i]);
  }
  return v;
}

Matrix matrix_of(const SurfaceMesh& mesh, const std::vector<Eigen::Triplet<double>>& entries) {
  Matrix matrix(mesh.num_vertices(), mesh.num_vertices());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// M with M_vw = ∫φ_v φ_w dS.
Matrix mass_matrix(const SurfaceMesh& mesh) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(9 * static_cast<std::size_t>(mesh.num_faces()));
  for (const FaceId f : mesh.faces.ids()) {
    const double share = face_area_vector(mesh, f).norm() / 12.0;
    for (const VertexId a : mesh.faces[f])
      for (const VertexId b : mesh.faces[f])
        entries.emplace_back(a.value, b.value, a == b ? 2.0 * share : share);
  }
  return matrix_of(mesh, entries);
}

/// (I + S⁻¹M)/2.
Matrix half_averages(const SurfaceMesh& mesh) {
  const VertexField<double> area = vertex_areas(mesh);
  Matrix identity(mesh.num_vertices(), mesh.num_vertices());
  identity.setIdentity();
  return 0.5 * (identity + Matrix(vector_of(area).cwiseInverse().asDiagonal() * mass_matrix(mesh)));
}

SurfaceMesh moved(SurfaceMesh mesh, const VertexField<Vec3>& motion, double dt) {
  for (const VertexId v : mesh.x.ids()) mesh.x[v] += dt * motion[v];
  return mesh;
}

/// The gradients of the three functions of a flat face.
std::array<Vec3, 3> gradients(const SurfaceMesh& mesh, const FaceVertices& v) {
  const TriangleGradients g =
      surface_gradients({mesh.x[v[1]] - mesh.x[v[0]], mesh.x[v[2]] - mesh.x[v[0]]});
  return {-g.g1 - g.g2, g.g1, g.g2};
}

}  // namespace

VertexField<double> vertex_amounts(const SurfaceMesh& mesh,
                                   const VertexField<double>& concentration) {
  return field_of(mass_matrix(mesh) * vector_of(concentration));
}

VertexField<double> concentration_of(const SurfaceMesh& mesh, const VertexField<double>& amounts) {
  const Eigen::SimplicialLDLT<Matrix> factors(mass_matrix(mesh));
  MENISCUS_ASSERT(factors.info() == Eigen::Success, "a face without area");
  return field_of(factors.solve(vector_of(amounts)));
}

SurfaceTransport::SurfaceTransport(const SurfaceMesh& mesh, const VertexField<Vec3>& slip,
                                   double diffusivity) {
  MENISCUS_ASSERT(slip.size() == mesh.num_vertices() && diffusivity >= 0.0, "{} {} {}", slip.size(),
                  mesh.num_vertices(), diffusivity);
  const VertexField<Vec3> s = along_surface(mesh, slip);
  std::vector<Eigen::Triplet<double>> stiffness, convection;
  for (const FaceId f : mesh.faces.ids()) {
    const FaceVertices& v = mesh.faces[f];
    const double area = face_area_vector(mesh, f).norm();
    const std::array<Vec3, 3> gradient = gradients(mesh, v);
    const Vec3 sum = s[v[0]] + s[v[1]] + s[v[2]];
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b) {
        const Vec3 carried = area / 12.0 * (sum + s[v[b]]);  // ∫φ_b s dS
        stiffness.emplace_back(v[a].value, v[b].value, area * gradient[a].dot(gradient[b]));
        convection.emplace_back(v[a].value, v[b].value, carried.dot(gradient[a]));
      }
  }
  const Matrix K = matrix_of(mesh, stiffness), C = matrix_of(mesh, convection);
  L_ = diffusivity * (K * half_averages(mesh)) - C;
}

VertexField<double> SurfaceTransport::rates(const VertexField<double>& concentration) const {
  return field_of(-(L_ * vector_of(concentration)));
}

VertexField<double> SurfaceTransport::mean_rates(const VertexField<double>& concentration,
                                                 const Path& path) const {
  MENISCUS_ASSERT(concentration.size() == L_.rows(), "{} values of {}", concentration.size(),
                  L_.rows());
  Eigen::SparseLU<Matrix> factors;
  const auto stage = [&](const Vector& amounts, double part) -> Vector {
    const Matrix matrix =
        mass_matrix(moved(path.start, path.motion, part * path.dt)) + kInnerStage * path.dt * L_;
    factors.compute(matrix);
    MENISCUS_ASSERT(factors.info() == Eigen::Success, "{}", factors.lastErrorMessage());
    return -(L_ * factors.solve(amounts));
  };
  const Vector amounts = mass_matrix(path.start) * vector_of(concentration),
               first = stage(amounts, kInnerStage),
               second = stage(amounts + (1.0 - kInnerStage) * path.dt * first, 1.0);
  return field_of((1.0 - kInnerStage) * first + kInnerStage * second);
}

}  // namespace meniscus
