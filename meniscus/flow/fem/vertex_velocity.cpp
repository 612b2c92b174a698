#include "meniscus/flow/fem/vertex_velocity.hpp"

#include <cmath>

#include <Eigen/Geometry>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/polynomial_fit.hpp"

namespace meniscus::fem {
namespace {

constexpr int kTerms = 1 + num_monomials(2);  // the value too

/// The running sums of one vertex's fit.
struct QuadraticFit {
  Vec3 t1, t2;
  double scale = 0.0;  ///< of an edge, so that the equations are well scaled
  PolynomialFit<kTerms> fit;
  Eigen::Matrix<double, kTerms, 3> side = Eigen::Matrix<double, kTerms, 3>::Zero();

  void add(const Vec3& d, const Vec3& value) {
    Eigen::Matrix<double, kTerms, 1> row;
    row << 1.0, monomials<2>(d.dot(t1) / scale, d.dot(t2) / scale);
    side += fit.add(row, scale * scale / d.squaredNorm()) * value.transpose();
  }
  [[nodiscard]] Vec3 value_or(const Vec3& fallback) const {
    const auto factor = fit.factor();
    return factor ? Vec3(factor->solve(side).row(0).transpose()) : fallback;
  }
};

}  // namespace

VertexField<Vec3> vertex_velocity(const SurfaceMesh& surface, const FaceNodeTable& faces,
                                  const NodePositions& positions, const Field<NodeId, Vec3>& v) {
  MENISCUS_ASSERT(v.size() == positions.x.size(), "{} velocities of {} nodes", v.size(),
                  positions.x.size());
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
  // Each face gives a corner two middles: of the edge that leaves the corner, and of the edge
  // opposite to it. The next face has the one that arrives.
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
