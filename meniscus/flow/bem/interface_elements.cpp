#include "meniscus/flow/bem/interface_elements.hpp"

#include <algorithm>
#include <map>

#include "meniscus/core/error.hpp"
#include "meniscus/surface/edge_middles.hpp"
#include "meniscus/surface/quartic_curvature.hpp"

namespace meniscus::bem {
namespace {

using Face = InterfaceElements::Face;

/// Columns in rising order of the vertices, so that sums do not depend on how they were found.
void set_stencil(Face& face, const FaceVertices& corners,
                 const std::array<const Stencil*, 3>& middles) {
  std::map<VertexId, std::array<double, kQuadraticNodes>> weights;
  for (std::size_t k = 0; k < 3; ++k) {
    weights[corners[k]][k] += 1.0;
    for (const VertexWeight& w : *middles[k]) weights[w.vertex][3 + k] += w.weight;
  }
  face.to_nodes.resize(kQuadraticNodes, static_cast<Eigen::Index>(weights.size()));
  for (const auto& [vertex, values] : weights) {
    face.to_nodes.col(static_cast<Eigen::Index>(face.columns.size())) =
        Eigen::Map<const Eigen::Matrix<double, kQuadraticNodes, 1>>(values.data());
    face.columns.push_back(vertex);
  }
}

void set_points_and_shares(Face& face) {
  Eigen::Matrix<double, kQuadraticNodes, 1> moment =
      Eigen::Matrix<double, kQuadraticNodes, 1>::Zero();
  for (std::size_t q = 0; q < kTriangleRule5.size(); ++q) {
    const auto& [barycentric, share] = kTriangleRule5[q];
    const TriangleShape<kQuadraticNodes> shape = quadratic_shape(barycentric);
    face.points[q] = {weighted_sum(shape.value, face.nodes),
                      share * tangents(shape, face.nodes).area()};
    moment += face.points[q].area.norm() *
              Eigen::Map<const Eigen::Matrix<double, kQuadraticNodes, 1>>(shape.value.data());
  }
  const Eigen::VectorXd share = face.to_nodes.transpose() * moment;
  face.share.assign(share.begin(), share.end());
}

}  // namespace

InterfaceElements make_elements(const SurfaceMesh& mesh) {
  const SurfaceTopology topology(mesh);
  const SmoothSurface smooth(mesh, topology);
  InterfaceElements result;
  result.x = mesh.x;
  result.corners = mesh.faces;
  for (const VertexCurvature& c : quartic_curvature(mesh, topology, smooth.vertex_curvature())) {
    result.n.add(c.n);
    result.kappa.add(c.sum());
  }
  const std::vector<Vec3> middles = middles_on_patches(smooth, topology);
  result.middles = edge_stencils(mesh, topology, result.n, middles);
  result.edges = face_edges(mesh, topology);
  result.weight = VertexField<double>(mesh.num_vertices(), 0.0);
  for (const FaceId f : mesh.faces.ids()) {
    Face face;
    std::array<const Stencil*, 3> stencils{};
    for (std::size_t k = 0; k < 3; ++k) {
      face.nodes[k] = mesh.x[mesh.faces[f][k]];
      face.nodes[3 + k] = middles[result.edges[f][k]];
      stencils[k] = &result.middles[result.edges[f][k]];
    }
    for (std::size_t k = 0; k < 3; ++k)
      face.size = std::max(face.size, (face.nodes[k] - face.nodes[(k + 1) % 3]).norm());
    set_stencil(face, mesh.faces[f], stencils);
    set_points_and_shares(face);
    MENISCUS_ASSERT(face.size > 0.0 && face.share.size() == face.columns.size(), "face {}",
                    f.value);
    for (std::size_t c = 0; c < face.columns.size(); ++c)
      result.weight[face.columns[c]] += face.share[c];
    result.faces.add(std::move(face));
  }
  return result;
}

NodeValues node_values(const Face& face, const VertexField<double>& at_vertices) {
  NodeValues values{};
  for (std::size_t a = 0; a < values.size(); ++a)
    for (std::size_t c = 0; c < face.columns.size(); ++c)
      values[a] += face.to_nodes(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(c)) *
                   at_vertices[face.columns[c]];
  return values;
}

std::vector<double> value_weights(const Face& face, const Vec3& b) {
  const std::array<double, kQuadraticNodes> values = quadratic_values({b[0], b[1], b[2]});
  const Eigen::VectorXd weights =
      face.to_nodes.transpose() *
      Eigen::Map<const Eigen::Matrix<double, kQuadraticNodes, 1>>(values.data());
  return {weights.begin(), weights.end()};
}

}  // namespace meniscus::bem
