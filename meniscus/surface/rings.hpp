#pragma once

#include <span>
#include <vector>

#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus {

/// Gathers the first and second ring of one vertex after another, without a search.
class RingGatherer {
 public:
  RingGatherer(const SurfaceMesh& mesh, const SurfaceTopology& topology);

  /// Ring 1, then (if asked) ring 2, in an order that only connectivity decides. Of ring 2,
  /// vertices whose normal is turned from that of v by more than about 75° are left out. Seen from
  /// v they lie across a fold, or on the far side of a filament.
  std::span<const Vec3> gather(VertexId v, bool with_second_ring);
  /// Unit area vector of a vertex: the first guess of its normal.
  [[nodiscard]] const Vec3& normal(VertexId v) const { return normals_[v]; }

 private:
  bool mark(VertexId v, VertexId center);

  const SurfaceMesh& mesh_;
  const SurfaceTopology& topology_;
  VertexField<Vec3> normals_;
  VertexField<VertexId> seen_from_;
  std::vector<Vec3> points_;
};

}  // namespace meniscus
