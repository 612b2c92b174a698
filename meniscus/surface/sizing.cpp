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

Mat3 shape_operator(const VertexCurvature& c) {
  return c.k1 * c.d1 * c.d1.transpose() + c.k2 * c.d2 * c.d2.transpose();
}

/// A tensor of the tangent plane at m, turned into that at n by the smallest rotation.
Mat3 turned(const Mat3& tensor, const Vec3& m, const Vec3& n) {
  const Mat3 turn = Mat3::Identity() - (n + m) * n.transpose() / (1.0 + n.dot(m));
  return turn * tensor * turn.transpose();
}

/// What a tensor exceeds its mean over the ring by; zero where the ring turns by 90° and more.
VertexField<Mat3> excess_over_ring(const VertexField<Mat3>& tensor,
                                   const VertexField<VertexCurvature>& curvature,
                                   const SurfaceTopology& topology) {
  VertexField<Mat3> excess(tensor.size(), Mat3::Zero());
  for (const VertexId v : tensor.ids()) {
    const Vec3& n = curvature[v].n;
    const auto ring = topology.ring(v);
    if (std::ranges::any_of(ring, [&](VertexId w) { return curvature[w].n.dot(n) <= 0.0; }))
      continue;
    Mat3 sum = Mat3::Zero();
    for (const VertexId w : ring) sum += turned(tensor[w], curvature[w].n, n);
    excess[v] = tensor[v] - sum / static_cast<double>(ring.size());
  }
  return excess;
}

/// ⟨κ⟩², the error of the fit taken out by two steps of deferred correction. A wave cos(ξx) of the
/// height, fitted to a ring of unit radius, loses curvature by the factor 2(1 − J0 + 2J2)/ξ²
/// = 1 − 7ξ²/96 + …, and exceeds its mean over the ring by q = 1 − J0 = ξ²/4 − …, J(ξ) being
/// Bessel's: the inverse of the first is 1 + 7/24 q + O(q²). The factor of q² is the one that gives
/// the inverse right at ξ = 2, a wave of three edges (0.12 is its limit for long ones).
VertexField<double> squared_rms(const VertexField<VertexCurvature>& curvature,
                                const SurfaceTopology& topology) {
  constexpr double kFirst = 7.0 / 24.0, kSecond = 0.2;
  VertexField<Mat3> fitted(curvature.size());
  for (const VertexId v : curvature.ids()) fitted[v] = shape_operator(curvature[v]);
  const auto first = excess_over_ring(fitted, curvature, topology);
  const auto second = excess_over_ring(first, curvature, topology);
  VertexField<double> squared(curvature.size());
  for (const VertexId v : curvature.ids())
    squared[v] = 0.5 * (fitted[v] + kFirst * first[v] + kSecond * second[v]).squaredNorm();
  return squared;
}

/// Ceiling over floor less 1, below which edges are even.
constexpr double kEqualBounds = 1e-6;

/// The floor, lowered so far that it leaves a small drop its fewest vertices.
double lowered_floor(double area, const RemeshOptions& options) {
  return std::min(options.edge_floor, 0.5 * length_of_density(options.min_vertices / area));
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
  return {std::max(options.C0, options.min_vertices / integral), lowered_floor(area, options)};
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
  // Between equal bounds no curvature matters.
  if (const double least = lowered_floor(surface_area(mesh), options);
      options.edge_ceiling <= least * (1.0 + kEqualBounds))
    return {mesh.num_vertices(), least};
  const VertexField<double> squared =
      averaged_over_rings(squared_rms(curvature, topology), topology);

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
