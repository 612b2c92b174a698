#include "meniscus/flow/fem/vertex_velocity.hpp"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus::fem {
namespace {

constexpr int kTerms = 6;
using Matrix = Eigen::Matrix<double, kTerms, kTerms>;
using Row = Eigen::Matrix<double, kTerms, 1>;

/// Smallest pivot of the scaled normal equations over the largest below which points are too few or
/// lie on a conic.
constexpr double kSingularPivot = 1e-3;

/// The running sums of one vertex's fit.
struct QuadraticFit {
  Vec3 t1, t2;
  double scale = 0.0;  ///< of an edge, so that the equations are well scaled
  Matrix normal = Matrix::Zero();
  Eigen::Matrix<double, kTerms, 3> side = Eigen::Matrix<double, kTerms, 3>::Zero();

  void add(const Vec3& d, const Vec3& value) {
    const double u = d.dot(t1) / scale, v = d.dot(t2) / scale;
    Row row;
    row << 1.0, u, v, u * u, u * v, v * v;
    const Row weighted = scale * scale / d.squaredNorm() * row;
    normal += weighted * row.transpose();
    side += weighted * value.transpose();
  }
  [[nodiscard]] Vec3 value_or(const Vec3& fallback) const {
    const Eigen::LLT<Matrix> factor(normal);
    const auto pivots = factor.matrixLLT().diagonal();
    if (factor.info() != Eigen::Success ||
        !(pivots.minCoeff() > kSingularPivot * pivots.maxCoeff()))
      return fallback;
    return factor.solve(side).row(0).transpose();
  }
};

}  // namespace

VertexField<Vec3> vertex_velocity(const SurfaceMesh& surface, const FaceNodeTable& faces,
                                  const NodePositions& positions, const Field<NodeId, Vec3>& v) {
  VertexField<Vec3> result(surface.num_vertices());
  for (const FaceId f : surface.faces.ids())
    for (std::size_t k = 0; k < 3; ++k) result[surface.faces[f][k]] = v[faces.of(f)[k]];
  if (faces.nodes_per_face < 6) return result;

  VertexField<QuadraticFit> fits(surface.num_vertices());
  const VertexField<Vec3> area = vertex_area_vectors(surface);
  for (const VertexId at : area.ids()) {
    fits[at].t1 = area[at].unitOrthogonal();
    fits[at].t2 = area[at].normalized().cross(fits[at].t1);
    fits[at].scale = std::sqrt(area[at].norm());
  }
  // Of each face the middle of the edge that leaves a corner (the next face brings the one that
  // arrives) and that of the edge opposite to it.
  for (const FaceId f : surface.faces.ids())
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId at = surface.faces[f][k];
      for (const std::size_t edge : {k, (k + 1) % 3}) {
        const NodeId middle = faces.of(f)[3 + edge];
        MENISCUS_ASSERT(positions.x[middle] != surface.x[at], "vertex {}", at.value);
        fits[at].add(positions.x[middle] - surface.x[at], v[middle]);
      }
    }
  for (const VertexId at : result.ids()) result[at] = fits[at].value_or(result[at]);
  return result;
}

}  // namespace meniscus::fem
