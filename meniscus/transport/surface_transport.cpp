#include "meniscus/transport/surface_transport.hpp"

#include <array>
#include <numbers>
#include <vector>

#include <Eigen/SparseLU>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/transport/vertex_vectors.hpp"

namespace meniscus {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::SparseMatrix<double>;

/// Where the inner stage of SDIRK2 stands in a step.
constexpr double kInnerStage = 1.0 - std::numbers::sqrt2 / 2.0;

VertexField<Vec3> along_surface(const SurfaceMesh& mesh, VertexField<Vec3> v) {
  const VertexField<Vec3> area = vertex_area_vectors(mesh);
  for (const VertexId i : v.ids()) {
    const Vec3 n = area[i].normalized();
    v[i] -= n * n.dot(v[i]);
  }
  return v;
}

/// A vector field given at the vertices, at all nodes.
Eigen::MatrixX3d at_nodes(const CarrierSurface& surface, const VertexField<Vec3>& v) {
  Eigen::MatrixX3d rows(v.size(), 3);
  for (const VertexId i : v.ids()) rows.row(i.value) = v[i];
  return surface.interpolation() * rows;
}

}  // namespace

SurfaceTransport::SurfaceTransport(const CarrierSurface& surface, const VertexField<Vec3>& slip,
                                   double diffusivity) {
  const SurfaceMesh& mesh = surface.mesh();
  MENISCUS_ASSERT(slip.size() == mesh.num_vertices() && diffusivity >= 0.0, "{} {} {}", slip.size(),
                  mesh.num_vertices(), diffusivity);
  const Eigen::MatrixX3d s = at_nodes(surface, along_surface(mesh, slip));
  FaceField<CarrierSurface::NodeMatrix> of_faces(mesh.num_faces(),
                                                 CarrierSurface::NodeMatrix::Zero());
  for (const FaceId f : mesh.faces.ids())
    for (const CarrierSurface::Point& point : surface.points(f)) {
      const Eigen::Map<const Eigen::Vector<double, kQuadraticNodes>> value(point.value.data());
      Eigen::Matrix<double, kQuadraticNodes, 3> gradient;
      Vec3 here = Vec3::Zero();
      for (std::size_t i = 0; i < kQuadraticNodes; ++i) {
        gradient.row(static_cast<Eigen::Index>(i)) = point.gradient[i];
        here += point.value[i] * s.row(surface.nodes(f)[i]).transpose();
      }
      of_faces[f] +=
          point.area * gradient * (diffusivity * gradient.transpose() - here * value.transpose());
    }
  L_ = surface.assembled(of_faces);
}

SurfaceTransport::SurfaceTransport(double a, const SurfaceTransport& first, double b,
                                   const SurfaceTransport& second)
    : L_(a * first.L_ + b * second.L_) {}

VertexField<double> SurfaceTransport::rates(const VertexField<double>& concentration) const {
  return field_of(-(L_ * vector_of(concentration)));
}

VertexField<double> SurfaceTransport::mean_rates(const VertexField<double>& concentration,
                                                 const Path& path) const {
  MENISCUS_ASSERT(concentration.size() == L_.rows(), "{} values of {}", concentration.size(),
                  L_.rows());
  return field_of(
      mean_rates(path.start.matrix() * vector_of(concentration), Vector::Zero(L_.rows()), path));
}

VertexField<double> SurfaceTransport::rates_of_sources(const VertexField<double>& sources,
                                                       const Path& path) const {
  MENISCUS_ASSERT(sources.size() == L_.rows(), "{} sources at {}", sources.size(), L_.rows());
  return field_of(mean_rates(Vector::Zero(L_.rows()), vector_of(sources), path));
}

VertexField<double> SurfaceTransport::settled(const VertexField<double>& amounts,
                                              const SurfaceMass& mass, double dt) const {
  const Eigen::SparseLU<Matrix> factors(mass.matrix() + kInnerStage * dt * L_);
  MENISCUS_ASSERT(factors.info() == Eigen::Success, "{}", factors.lastErrorMessage());
  const Vector once = factors.solve(vector_of(amounts));
  return field_of(factors.solve(mass.matrix() * once));
}

Vector SurfaceTransport::mean_rates(const Vector& amounts, const Vector& sources,
                                    const Path& path) const {
  Eigen::SparseLU<Matrix> factors;
  // Between the ends of the step masses change linearly, but for the square of its length.
  const auto stage = [&](const Vector& begin, double part) -> Vector {
    const Matrix mass = (1.0 - part) * path.start.matrix() + part * path.end.matrix();
    const Matrix matrix = mass + kInnerStage * path.dt * L_;
    if (part != 1.0) factors.analyzePattern(matrix);  // for both stages: the same entries
    factors.factorize(matrix);
    MENISCUS_ASSERT(factors.info() == Eigen::Success, "{}", factors.lastErrorMessage());
    return sources - L_ * factors.solve(begin + kInnerStage * path.dt * sources);
  };
  const Vector first = stage(amounts, kInnerStage),
               second = stage(amounts + (1.0 - kInnerStage) * path.dt * first, 1.0);
  return (1.0 - kInnerStage) * first + kInnerStage * second;
}

}  // namespace meniscus
