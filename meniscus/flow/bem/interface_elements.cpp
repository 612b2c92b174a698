#include "meniscus/flow/bem/interface_elements.hpp"

#include <algorithm>
#include <tuple>

#include "meniscus/core/error.hpp"
#include "meniscus/surface/edge_middles.hpp"
#include "meniscus/surface/quartic_curvature.hpp"

namespace meniscus::bem {
namespace {

using Face = InterfaceElements::Face;

/// Fills in the points and areas; returns ∫φ_a dS of the six functions.
NodeValues set_areas(Face& face) {
  NodeValues moments{};
  face.area.fill(Vec3::Zero());
  for (std::size_t q = 0; q < kTriangleRule5.size(); ++q) {
    const auto& [barycentric, share] = kTriangleRule5[q];
    const TriangleShape<kQuadraticNodes> shape = quadratic_shape(barycentric);
    const Vec3 area = share * tangents(shape, face.nodes).area();
    face.points[q] = {weighted_sum(shape.value, face.nodes), area};
    for (std::size_t a = 0; a < moments.size(); ++a) {
      face.area[a] += shape.value[a] * area;
      moments[a] += shape.value[a] * area.norm();
    }
  }
  return moments;
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
  std::vector<double> middle_weight(middles.size(), 0.0);
  for (const FaceId f : mesh.faces.ids()) {
    const auto& [corners, edges] = std::tie(mesh.faces[f], result.edges[f]);
    Face face;
    for (std::size_t k = 0; k < 3; ++k) {
      face.nodes[k] = mesh.x[corners[k]];
      face.nodes[3 + k] = middles[edges[k]];
    }
    for (std::size_t k = 0; k < 3; ++k)
      face.size = std::max(face.size, (face.nodes[k] - face.nodes[(k + 1) % 3]).norm());
    MENISCUS_ASSERT(face.size > 0.0, "face {}", f.value);
    const NodeValues moments = set_areas(face);
    for (std::size_t k = 0; k < 3; ++k) {
      result.weight[corners[k]] += moments[k];
      middle_weight[edges[k]] += moments[3 + k];
    }
    result.faces.add(face);
  }
  for (std::size_t e = 0; e < middles.size(); ++e)
    for (const VertexWeight& w : result.middles[e])
      result.weight[w.vertex] += w.weight * middle_weight[e];
  return result;
}

}  // namespace meniscus::bem
