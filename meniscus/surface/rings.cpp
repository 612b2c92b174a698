#include "meniscus/surface/rings.hpp"

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {
namespace {
constexpr double kSeenCosine =
    0.25;  // a height function needs well below 90°; 75° keeps slopes < 4
}

RingGatherer::RingGatherer(const SurfaceMesh& mesh, const SurfaceTopology& topology)
    : mesh_(mesh),
      topology_(topology),
      normals_(vertex_area_vectors(mesh)),
      seen_from_(mesh.num_vertices()) {
  for (Vec3& n : normals_) n.normalize();
}

bool RingGatherer::mark(VertexId v, VertexId center) {
  if (seen_from_[v] == center) return false;
  seen_from_[v] = center;
  return true;
}

std::span<const Vec3> RingGatherer::gather(VertexId v, bool with_second_ring) {
  MENISCUS_ASSERT(topology_.valence(v) >= 3, "vertex {}", v.value);
  points_.clear();
  // The mark of an earlier call for the same vertex would hide its rings.
  seen_from_[v] = v;
  for (const VertexId w : topology_.ring(v)) seen_from_[w] = VertexId{};
  if (with_second_ring)
    for (const VertexId w : topology_.ring(v))
      for (const VertexId far : topology_.ring(w))
        if (far != v) seen_from_[far] = VertexId{};
  for (const VertexId w : topology_.ring(v))
    if (mark(w, v)) points_.push_back(mesh_.x[w]);
  if (with_second_ring)
    for (const VertexId w : topology_.ring(v))
      for (const VertexId far : topology_.ring(w))
        if (mark(far, v) && normals_[far].dot(normals_[v]) > kSeenCosine)
          points_.push_back(mesh_.x[far]);
  return points_;
}

}  // namespace meniscus
