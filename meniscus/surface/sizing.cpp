#include "meniscus/surface/sizing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {
namespace {

/// ½(own + mean of first ring): takes the noise of single fits out of the springs.
VertexField<double> averaged_over_rings(const VertexField<double>& values,
                                        const SurfaceTopology& topology) {
  VertexField<double> result(values.size());
  for (const VertexId v : values.ids()) {
    double sum = 0.0;
    for (const VertexId w : topology.ring(v)) sum += values[w];
    result[v] = 0.5 * (values[v] + sum / topology.valence(v));
  }
  return result;
}

double limited(double length, const Vec3& x, const RemeshOptions& options) {
  double l = std::min(length, options.edge_ceiling);
  if (options.size_bound) l = std::min(l, options.size_bound(x));
  return std::max(l, options.edge_floor);
}

/// Lowers lengths until none exceeds a neighbour's by more than gradation × distance. Sweeps along
/// the edges; the last finds nothing to do, and a sweep carries a bound over many edges.
void limit_gradation(VertexField<double>& length, const SurfaceMesh& mesh,
                     const SurfaceTopology& topology, double gradation) {
  bool changed = true;
  while (changed) {
    changed = false;
    for (const SurfaceEdge& e : topology.edges()) {
      double &a = length[e.a], &b = length[e.b];
      if (std::abs(a - b) <= gradation * std::min(a, b) * 0.1) continue;  // common case, no root
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

VertexField<double> lengths_for(double C0, const VertexField<double>& squared_curvature,
                                const SurfaceMesh& mesh, const SurfaceTopology& topology,
                                const RemeshOptions& options) {
  VertexField<double> length(mesh.num_vertices());
  for (const VertexId v : mesh.x.ids())
    length[v] = limited(length_of_density(C0 * squared_curvature[v]), mesh.x[v], options);
  limit_gradation(length, mesh, topology, options.gradation);
  return length;
}

/// ∮ρ dS on the flat faces.
double expected_vertices(const SurfaceMesh& mesh, const VertexField<double>& length) {
  const VertexField<double> area = vertex_areas(mesh);
  double sum = 0.0;
  for (const VertexId v : mesh.x.ids()) sum += area[v] * density_of_length(length[v]);
  return sum;
}

}  // namespace

double density_of_length(double rest_length) {
  return 2.0 / (std::numbers::sqrt3 * rest_length * rest_length);
}

double length_of_density(double density) {
  return std::sqrt(2.0 / (std::numbers::sqrt3 * density));
}

VertexField<double> rest_lengths(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                                 const VertexField<VertexCurvature>& curvature,
                                 const RemeshOptions& options) {
  VertexField<double> squared(mesh.num_vertices());
  for (const VertexId v : mesh.x.ids()) squared[v] = std::pow(curvature[v].rms(), 2);
  squared = averaged_over_rings(squared, topology);

  VertexField<double> length = lengths_for(options.C0, squared, mesh, topology, options);
  const double expected = expected_vertices(mesh, length);
  if (expected >= options.min_vertices) return length;
  // Below the ceiling and the bounds ∮ρ dS is linear in C0; above, it was larger already.
  return lengths_for(options.C0 * options.min_vertices / expected, squared, mesh, topology,
                     options);
}

}  // namespace meniscus
