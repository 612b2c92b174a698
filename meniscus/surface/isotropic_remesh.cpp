#include "meniscus/surface/isotropic_remesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <Eigen/Geometry>

#include "meniscus/mesh/cgal_surface.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_quality.hpp"

namespace meniscus {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

constexpr double kLowAngleDeg = 15.0;  // of the 5 % quantile; relaxed meshes have 40° and more
/// Edges longer than this many wanted ones are halved, the longest first, before creases are cut to
/// pieces. Creases of long slivers would make fans, and these take triangles without end.
constexpr double kLongEdge = 10.0;
constexpr int kIterations = 5;  // CGAL's examples take 1 to 10; the angles settle by 5

bool is_crease(const SurfaceMesh& mesh, const SurfaceEdge& e) {
  static const double cosine = std::cos(kCreaseDeg * std::numbers::pi / 180.0);
  const Vec3 left = face_area_vector(mesh, e.left), right = face_area_vector(mesh, e.right);
  return left.dot(right) < cosine * left.norm() * right.norm();
}

}  // namespace

bool has_creases(const SurfaceMesh& mesh, const SurfaceTopology& topology) {
  return std::ranges::any_of(topology.edges(),
                             [&](const SurfaceEdge& e) { return is_crease(mesh, e); });
}

bool is_rough(const SurfaceMesh& mesh, const SurfaceTopology& topology) {
  return has_creases(mesh, topology) ||
         surface_quality(mesh, topology).low_angle_deg < kLowAngleDeg;
}

Creases creases(const SurfaceMesh& mesh, const SurfaceTopology& topology, double edge) {
  Creases result;
  double longest = -1.0;
  for (const SurfaceEdge& e : topology.edges()) {
    if (!is_crease(mesh, e)) continue;
    const double length = (mesh.x[e.b] - mesh.x[e.a]).norm();
    result.pieces += std::max(0.0, length / edge - 1.0);
    if (length <= longest) continue;
    longest = length;
    result.longest = e;
  }
  return result;
}

SurfaceMesh isotropic_remesh(const SurfaceMesh& mesh, double edge, double crease_deg) {
  CgalMesh cgal = to_cgal(mesh);
  auto [is_crease, added] = cgal.add_property_map<CgalMesh::Edge_index, bool>("e:crease", false);
  if (crease_deg < 180.0) pmp::detect_sharp_edges(cgal, crease_deg, is_crease);
  pmp::split_long_edges(cgal.edges(), kLongEdge * edge, cgal,
                        CGAL::parameters::edge_is_constrained_map(is_crease));
  // Constrained edges are kept as they are, so that they have to be short before.
  std::vector<CgalMesh::Edge_index> creases;
  for (const auto e : cgal.edges())
    if (is_crease[e]) creases.push_back(e);
  pmp::split_long_edges(creases, edge, cgal, CGAL::parameters::edge_is_constrained_map(is_crease));
  pmp::isotropic_remeshing(cgal.faces(), edge, cgal,
                           CGAL::parameters::number_of_iterations(kIterations)
                               .edge_is_constrained_map(is_crease)
                               .protect_constraints(true));
  return from_cgal(cgal);
}

}  // namespace meniscus
