#include "meniscus/surface/sizing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/gap.hpp"

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

/// The shape operator k1 d1 d1ᵀ + k2 d2 d2ᵀ of a neighbour, turned into the tangent plane at n by
/// the smallest rotation.
Mat3 shape_operator(const VertexCurvature& c, const Vec3& n) {
  const auto turned = [&](const Vec3& d) -> Vec3 {
    return d - n.dot(d) / (1.0 + n.dot(c.n)) * (n + c.n);
  };
  const Vec3 d1 = turned(c.d1), d2 = turned(c.d2);
  return c.k1 * d1 * d1.transpose() + c.k2 * d2 * d2.transpose();
}

/// ⟨κ⟩² at a vertex, the fit's error O(h²) taken out by one step of deferred correction. Fitted
/// to one ring of radius h, the curvature of a height f(x) is f₂ + 7/96 h² f₄ with f₂ and f₄ its
/// second and fourth derivative (least squares of cos⁴ by a quadratic form), and the mean of f₂
/// over the ring is f₂ + 1/4 h² f₄: of what the mean exceeds the own value by, 7/24 is the error.
double squared_rms(const VertexField<VertexCurvature>& curvature, std::span<const VertexId> ring,
                   VertexId v) {
  constexpr double kCorrection = 7.0 / 24.0;
  const Vec3& n = curvature[v].n;
  Mat3 sum = Mat3::Zero();
  for (const VertexId w : ring) {
    if (curvature[w].n.dot(n) <= 0.0) return std::pow(curvature[v].rms(), 2);
    sum += shape_operator(curvature[w], n);
  }
  const Mat3 own = shape_operator(curvature[v], n);
  return 0.5 * (own + kCorrection * (own - sum / static_cast<double>(ring.size()))).squaredNorm();
}

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
  for (const VertexId v : mesh.x.ids()) squared[v] = squared_rms(curvature, topology.ring(v), v);
  squared = averaged_over_rings(squared, topology);

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
