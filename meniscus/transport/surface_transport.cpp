#include "meniscus/transport/surface_transport.hpp"

#include <array>
#include <numbers>
#include <vector>

#include <Eigen/IterativeLinearSolvers>
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

/// Solves equations of a stage, in which masses mostly outweigh what is carried and spread. It
/// iterates from a guess; factors serve where iterations do not come to an end.
Vector solved(const Matrix& matrix, const Vector& right, const Vector& guess) {
  constexpr double kTolerance = 1e-13;
  constexpr int kMostIterations = 40;
  Eigen::BiCGSTAB<Eigen::SparseMatrix<double, Eigen::RowMajor>> iteration(matrix);
  iteration.setTolerance(kTolerance);
  iteration.setMaxIterations(kMostIterations);
  Vector solution = iteration.solveWithGuess(right, guess);
  if (iteration.info() == Eigen::Success && solution.allFinite()) return solution;
  const Eigen::SparseLU<Matrix> factors(matrix);
  MENISCUS_ASSERT(factors.info() == Eigen::Success, "{}", factors.lastErrorMessage());
  return factors.solve(right);
}

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
  const Matrix matrix = mass.matrix() + kInnerStage * dt * L_;
  const Vector once = solved(matrix, vector_of(amounts), Vector::Zero(L_.rows()));
  return field_of(solved(matrix, mass.matrix() * once, once));
}

Vector SurfaceTransport::mean_rates(const Vector& amounts, const Vector& sources,
                                    const Path& path) const {
  Vector reached = amounts.cwiseQuotient(vector_of(path.start.areas()));
  // Between the ends of the step masses change linearly, but for the square of its length.
  const auto stage = [&](const Vector& begin, double part) -> Vector {
    const Matrix mass = (1.0 - part) * path.start.matrix() + part * path.end.matrix();
    reached =
        solved(mass + kInnerStage * path.dt * L_, begin + kInnerStage * path.dt * sources, reached);
    return sources - L_ * reached;
  };
  const Vector first = stage(amounts, kInnerStage),
               second = stage(amounts + (1.0 - kInnerStage) * path.dt * first, 1.0);
  return (1.0 - kInnerStage) * first + kInnerStage * second;
}

}  // namespace meniscus
