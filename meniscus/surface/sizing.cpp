#include "meniscus/surface/sizing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/gap.hpp"

namespace meniscus {
namespace {

/// C0 and the floor, raised and lowered so far that they leave a small or round drop its fewest
/// vertices.
struct Allowance {
  double C0, edge_floor;
};
Allowance allowance(const VertexField<double>& squared_curvature, const SurfaceMesh& mesh,
                    const RemeshOptions& options) {
  const VertexField<double> areas = vertex_areas(mesh);
  double area = 0.0, integral = 0.0;
  for (const VertexId v : mesh.x.ids()) {
    area += areas[v];
    integral += areas[v] * squared_curvature[v];
  }
  return {std::max(options.C0, options.min_vertices / integral),
          std::min(options.edge_floor, 0.5 * length_of_density(options.min_vertices / area))};
}

}  // namespace

double density_of_length(double rest_length) {
  return 2.0 / (std::numbers::sqrt3 * rest_length * rest_length);
}

double length_of_density(double density) {
  return std::sqrt(2.0 / (std::numbers::sqrt3 * density));
}

void limit_gradation(VertexField<double>& length, const SurfaceMesh& mesh,
                     const SurfaceTopology& topology, double gradation) {
  bool changed = true;
  while (changed) {
    changed = false;
    for (const SurfaceEdge& e : topology.edges()) {
      double &a = length[e.a], &b = length[e.b];
      const double reach = gradation * (mesh.x[e.a] - mesh.x[e.b]).norm();
      const double bound_a = b + reach, bound_b = a + reach;
      if (a > bound_a * (1.0 + 1e-12)) {
        a = bound_a;
        changed = true;
      } else if (b > bound_b * (1.0 + 1e-12)) {
        b = bound_b;
        changed = true;
      }
    }
  }
}

VertexField<double> rest_lengths(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                                 const VertexField<VertexCurvature>& curvature,
                                 const RemeshOptions& options) {
  VertexField<double> squared(mesh.num_vertices());
  for (const VertexId v : mesh.x.ids())
    squared[v] = 0.5 * (curvature[v].k1 * curvature[v].k1 + curvature[v].k2 * curvature[v].k2);
  const auto [C0, edge_floor] = allowance(squared, mesh, options);
  VertexField<double> length(mesh.num_vertices());
  for (const VertexId v : mesh.x.ids()) {
    double l = std::min(length_of_density(C0 * squared[v]), options.edge_ceiling);
    if (options.size_bound) l = std::min(l, options.size_bound(mesh.x[v]));
    length[v] = l;
  }
  if (options.gap_layers > 0.0) {
    VertexField<Vec3> normals(mesh.num_vertices());
    for (const VertexId v : mesh.x.ids()) normals[v] = curvature[v].n;
    bound_by_gaps(length, mesh, normals, options.gap_layers, options.neighbours);
  }
  for (double& l : length) l = std::max(l, edge_floor);
  limit_gradation(length, mesh, topology, options.gradation);
  return length;
}

}  // namespace meniscus
