#include "meniscus/surface/even_out.hpp"

#include <cmath>
#include <numbers>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>
#include <Eigen/Geometry>

#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_quality.hpp"

namespace meniscus {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// An icosahedron, the coarsest sphere there is to be smoothed, turns its normals by 42°.
constexpr double kCreaseDeg = 50.0;
constexpr double kLowAngleDeg = 15.0;  // of the 5 % quantile; relaxed meshes have 40° and more
constexpr int kIterations = 5;         // CGAL's examples take 1 to 10; the angles settle by 5

CgalMesh to_cgal(const SurfaceMesh& mesh) {
  CgalMesh result;
  for (const Vec3& x : mesh.x) result.add_vertex({x.x(), x.y(), x.z()});
  const auto corner = [](VertexId v) {
    return CgalMesh::Vertex_index(static_cast<std::uint32_t>(v.value));
  };
  for (const FaceVertices& f : mesh.faces)
    result.add_face(corner(f[0]), corner(f[1]), corner(f[2]));
  return result;
}

SurfaceMesh from_cgal(CgalMesh& mesh) {
  mesh.collect_garbage();
  SurfaceMesh result;
  for (const auto v : mesh.vertices()) {
    const Kernel::Point_3& x = mesh.point(v);
    result.x.add(Vec3(x.x(), x.y(), x.z()));
  }
  for (const auto f : mesh.faces()) {
    FaceVertices corners;
    std::size_t k = 0;
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh))
      corners[k++] = VertexId{static_cast<std::int32_t>(v.idx())};
    result.faces.add(corners);
  }
  return result;
}

}  // namespace

bool is_rough(const SurfaceMesh& mesh, const SurfaceTopology& topology) {
  if (surface_quality(mesh, topology).low_angle_deg < kLowAngleDeg) return true;
  const double crease = std::cos(kCreaseDeg * std::numbers::pi / 180.0);
  for (const SurfaceEdge& e : topology.edges()) {
    const Vec3 left = face_area_vector(mesh, e.left), right = face_area_vector(mesh, e.right);
    if (left.dot(right) < crease * left.norm() * right.norm()) return true;
  }
  return false;
}

SurfaceMesh evened_out(const SurfaceMesh& mesh, double edge) {
  CgalMesh cgal = to_cgal(mesh);
  auto [is_crease, added] = cgal.add_property_map<CgalMesh::Edge_index, bool>("e:crease", false);
  pmp::detect_sharp_edges(cgal, kCreaseDeg, is_crease);
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
