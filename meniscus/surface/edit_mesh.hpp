#pragma once

#include <cstdint>
#include <vector>

#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus {

using HalfedgeId = Id<struct HalfedgeTag>;

/// Connectivity of a closed triangulated surface while it is edited: half-edges 3f, 3f + 1, 3f + 2
/// run round face f. Only the partner across the edge and the vertex each starts at are stored.
/// Removed faces and vertices stay behind as dead ids until `compact_mesh`.
class EditMesh {
 public:
  EditMesh(const SurfaceMesh& mesh, const SurfaceTopology& topology);

  [[nodiscard]] static HalfedgeId next(HalfedgeId h) {
    return {h.value % 3 == 2 ? h.value - 2 : h.value + 1};
  }
  [[nodiscard]] static HalfedgeId previous(HalfedgeId h) {
    return {h.value % 3 == 0 ? h.value + 2 : h.value - 1};
  }
  [[nodiscard]] HalfedgeId twin(HalfedgeId h) const { return twin_[h]; }
  [[nodiscard]] VertexId from(HalfedgeId h) const { return from_[h]; }
  [[nodiscard]] VertexId to(HalfedgeId h) const { return from_[next(h)]; }
  /// The corner opposite to the edge in the face of h.
  [[nodiscard]] VertexId opposite(HalfedgeId h) const { return from_[previous(h)]; }
  [[nodiscard]] HalfedgeId out(VertexId v) const { return out_[v]; }

  [[nodiscard]] std::int32_t num_halfedge_slots() const { return from_.size(); }
  [[nodiscard]] std::int32_t num_vertex_slots() const { return out_.size(); }
  [[nodiscard]] std::int32_t num_vertices() const { return num_alive_; }
  [[nodiscard]] bool is_alive(HalfedgeId h) const { return from_[h].is_valid(); }
  [[nodiscard]] bool is_alive(VertexId v) const { return out_[v].is_valid(); }
  /// One of the two half-edges of each edge.
  [[nodiscard]] bool is_representative(HalfedgeId h) const { return is_alive(h) && h < twin_[h]; }

  /// Calls visit(h) for every half-edge that starts at v, counter-clockwise.
  template <class Visit>
  void for_each_out(VertexId v, Visit&& visit) const {
    const HalfedgeId start = out_[v];
    HalfedgeId h = start;
    do {
      visit(h);
      h = twin_[previous(h)];
    } while (h != start);
  }
  [[nodiscard]] std::int32_t valence(VertexId v) const { return valence_[v]; }
  [[nodiscard]] bool are_joined(VertexId a, VertexId b) const;

  /// Cuts the edge of h and its two faces in two; returns the new vertex.
  VertexId split(HalfedgeId h);
  /// Turns the edge of h to join the two opposite corners. They must not be joined already.
  void flip(HalfedgeId h);
  /// Whether `collapse` keeps a closed manifold: the ends have only the two opposite corners in
  /// common (link condition), and these keep three neighbours or more.
  [[nodiscard]] bool can_collapse(HalfedgeId h) const;
  /// Merges from(h) into to(h), which stays; the two faces of the edge vanish.
  void collapse(HalfedgeId h);

  /// Living vertices in the order of their ids, and the faces between them.
  struct CompactMesh {
    std::vector<VertexId> vertices;
    FaceField<FaceVertices> faces;
  };
  [[nodiscard]] CompactMesh compact_mesh() const;

 private:
  void pair(HalfedgeId a, HalfedgeId b) {
    twin_[a] = b;
    twin_[b] = a;
  }

  Field<HalfedgeId, VertexId> from_;  // invalid where the face is dead
  Field<HalfedgeId, HalfedgeId> twin_;
  VertexField<HalfedgeId> out_;  // invalid where the vertex is dead
  VertexField<std::int32_t> valence_;
  std::int32_t num_alive_ = 0;
};

}  // namespace meniscus
