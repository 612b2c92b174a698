#include "tests/surface/jet_curvature.hpp"

#include <algorithm>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Monge_via_jet_fitting.h>
#include <Eigen/Geometry>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus::test {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using JetFit = CGAL::Monge_via_jet_fitting<Kernel>;

constexpr std::size_t kDegree = 4;
constexpr std::size_t kUnknowns = (kDegree + 1) * (kDegree + 2) / 2;
constexpr int kRings = 3;

Kernel::Point_3 to_point(const Vec3& x) { return {x.x(), x.y(), x.z()}; }
Vec3 to_vector(const Kernel::Vector_3& v) { return {v.x(), v.y(), v.z()}; }

/// The vertex and the rings around it, as many as are asked or as the unknowns need.
std::vector<Kernel::Point_3> neighbourhood(VertexId v, const SurfaceMesh& mesh,
                                           const SurfaceTopology& topology) {
  std::vector<VertexId> found{v};
  std::size_t ring_begin = 0;
  for (int ring = 0; ring < kRings || found.size() < kUnknowns; ++ring) {
    const std::size_t ring_end = found.size();
    for (std::size_t i = ring_begin; i < ring_end; ++i)
      for (const VertexId w : topology.ring(found[i]))
        if (std::ranges::find(found, w) == found.end()) found.push_back(w);
    if (found.size() == ring_end) break;  // the whole surface
    ring_begin = ring_end;
  }
  if (found.size() < kUnknowns)
    reject_input("a jet of degree {} needs {} vertices; the surface has {}", kDegree, kUnknowns,
                 found.size());
  std::vector<Kernel::Point_3> points;
  for (const VertexId w : found) points.push_back(to_point(mesh.x[w]));
  return points;
}

}  // namespace

VertexField<VertexCurvature> jet_curvature(const SurfaceMesh& mesh,
                                           const SurfaceTopology& topology) {
  const VertexField<Vec3> areas = vertex_area_vectors(mesh);
  VertexField<VertexCurvature> result(mesh.num_vertices());
  for (const VertexId v : mesh.x.ids()) {
    const std::vector<Kernel::Point_3> points = neighbourhood(v, mesh, topology);
    JetFit fit;
    JetFit::Monge_form form = fit(points.begin(), points.end(), kDegree, 2);
    form.comply_wrt_given_normal({areas[v].x(), areas[v].y(), areas[v].z()});
    // CGAL's curvatures are those of the height along the normal: negative on a sphere.
    VertexCurvature& c = result[v];
    c.n = to_vector(form.normal_direction());
    c.k1 = -form.principal_curvatures(1);
    c.k2 = -form.principal_curvatures(0);
    c.d1 = to_vector(form.minimal_principal_direction());
    c.d2 = c.n.cross(c.d1);
  }
  return result;
}

}  // namespace meniscus::test
