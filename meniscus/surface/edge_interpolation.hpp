#pragma once

#include <vector>

#include "meniscus/surface/smooth_surface.hpp"

namespace meniscus {

/// A linear function of vertex values.
struct VertexWeight {
  VertexId vertex;
  double weight = 0.0;
};
using Stencil = std::vector<VertexWeight>;

/// Values at points near a vertex from values at the vertices around it, by a quadratic function of
/// the tangent-plane coordinates. It has the vertex's value and fits those of its ring best
/// (weights 1/distance²). A second ring is added where the first leaves it near singular. Error
/// O(h³). Where two rings do not determine it the vertex's own value is returned.
class VertexInterpolation {
 public:
  VertexInterpolation(const SurfaceMesh& mesh, const SurfaceTopology& topology, VertexId v,
                      const Vec3& n);
  /// Adds `factor` times the function's value at x to a stencil.
  void add(const Vec3& x, double factor, Stencil& stencil) const;

 private:
  VertexId vertex_;
  HeightPatch frame_;
  double scale_ = 1.0;  // of an edge: the unit of length of the fit
  std::vector<VertexId> ring_;
  Eigen::Matrix<double, 5, Eigen::Dynamic> fit_;  // (value of ring − own value) ↦ coefficients
};

/// Values at the middle of every edge (at `middles`, in the order of the topology): the mean of the
/// interpolations from its two ends.
[[nodiscard]] std::vector<Stencil> edge_stencils(const SurfaceMesh& mesh,
                                                 const SurfaceTopology& topology,
                                                 const VertexField<Vec3>& normals,
                                                 const std::vector<Vec3>& middles);

/// What stencils make of the values at the vertices, in their order.
template <class Value>
[[nodiscard]] std::vector<Value> interpolated(const std::vector<Stencil>& stencils,
                                              const VertexField<Value>& values) {
  std::vector<Value> result;
  result.reserve(stencils.size());
  for (const Stencil& stencil : stencils) {
    Value sum = 0.0 * values[stencil.front().vertex];
    for (const VertexWeight& w : stencil) sum += w.weight * values[w.vertex];
    result.push_back(sum);
  }
  return result;
}

}  // namespace meniscus
