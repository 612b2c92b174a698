#include "meniscus/flow/bem/tension_balance.hpp"

#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus::bem {
namespace {

using Face = InterfaceElements::Face;

/// ε over the root of a vertex's area, about an edge: where nodes are the sources of the far field.
constexpr double kSpread = 2.0;

/// ∫ ∇_s(σ φ_a) dS at the nodes of a face: the pull of tension and that of its gradient. The
/// Marangoni layer takes the latter away.
NodeVectors pulls(const Face& face, const NodeValues& tension) {
  NodeVectors pulls;
  pulls.fill(Vec3::Zero());
  for (std::size_t q = 0; q < face.points.size(); ++q) {
    const TriangleShape<kQuadraticNodes> shape = quadratic_shape(kTriangleRule5[q].barycentric);
    const TriangleGradients gradients = surface_gradients(tangents(shape, face.nodes));
    double sigma = 0.0, by_1 = 0.0, by_2 = 0.0;
    for (std::size_t a = 0; a < tension.size(); ++a) {
      sigma += shape.value[a] * tension[a];
      by_1 += shape.by_1[a] * tension[a];
      by_2 += shape.by_2[a] * tension[a];
    }
    const double area = face.points[q].area.norm();
    for (std::size_t a = 0; a < pulls.size(); ++a)
      pulls[a] += area * ((sigma * shape.by_1[a] + shape.value[a] * by_1) * gradients.g1 +
                          (sigma * shape.by_2[a] + shape.value[a] * by_2) * gradients.g2);
  }
  return pulls;
}

/// σκ at the points.
std::vector<double> capillary_pressure(const BoundaryGeometry& geometry,
                                       std::vector<double> tension) {
  for (std::size_t m = 0; m < geometry.surfaces.size(); ++m) {
    const VertexField<double>& kappa = geometry.surfaces[m].elements.kappa;
    for (const VertexId v : kappa.ids())
      tension[static_cast<std::size_t>(geometry.index(m, v))] *= kappa[v];
  }
  return tension;
}

/// What the pull of tension differs by from σκ n, at all nodes.
SourceVectors imbalance(const Scene& scene, const BoundaryGeometry& geometry) {
  const std::vector<double> at_points = tension_at_points(scene),
                            tension = geometry.at_nodes(at_points),
                            pressure = geometry.at_nodes(capillary_pressure(geometry, at_points));
  SourceVectors forces(geometry.num_nodes());
  for (std::size_t m = 0; m < geometry.surfaces.size(); ++m)
    for (const FaceId f : geometry.surfaces[m].elements.faces.ids()) {
      const Face& face = geometry.surfaces[m].elements.faces[f];
      const NodeVectors pull = pulls(face, geometry.on_face(m, f, tension));
      const NodeValues jump = geometry.on_face(m, f, pressure);
      const auto nodes = geometry.nodes_of(m, f);
      for (std::size_t a = 0; a < nodes.size(); ++a)
        forces.set(nodes[a], forces.at(nodes[a]) + pull[a] - jump[a] * face.area[a]);
    }
  return forces;
}

}  // namespace

TensionBalance::TensionBalance(const Scene& scene, const BoundaryGeometry& geometry) {
  const SourceVectors forces = geometry.to_points(imbalance(scene, geometry));
  for (std::int32_t i = 0; i < geometry.size(); ++i)
    forces_.add(geometry.nodes.point(i), forces.at(i));
  for (const Interface& interface : scene.interfaces)
    for (const double area : vertex_areas(interface.mesh))
      spread_.push_back(kSpread * kSpread * area);
}

Vec3 TensionBalance::operator()(const Vec3& x) const {
  return spread_forces_sum(forces_, spread_, x);
}

}  // namespace meniscus::bem
