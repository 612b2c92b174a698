#include "meniscus/mesh/surface_pieces.hpp"

#include <utility>

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

/// Disjoint sets of vertices; paths are halved as they are walked.
class VertexSets {
 public:
  explicit VertexSets(std::int32_t size) : parent_(size) {
    for (const VertexId v : parent_.ids()) parent_[v] = v;
  }
  [[nodiscard]] VertexId find(VertexId v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }
  void join(VertexId a, VertexId b) { parent_[find(a)] = find(b); }

 private:
  VertexField<VertexId> parent_;
};

}  // namespace

std::vector<SurfaceMesh> connected_pieces(const SurfaceMesh& mesh) {
  VertexSets sets(mesh.num_vertices());
  for (const FaceVertices& f : mesh.faces) {
    sets.join(f[0], f[1]);
    sets.join(f[1], f[2]);
  }
  std::vector<SurfaceMesh> pieces;
  VertexField<std::int32_t> root_to_piece(mesh.num_vertices(), -1);
  for (const FaceVertices& f : mesh.faces) {
    std::int32_t& piece = root_to_piece[sets.find(f[0])];
    if (piece >= 0) continue;
    piece = static_cast<std::int32_t>(pieces.size());
    pieces.emplace_back();
  }
  VertexField<VertexId> vertex_in_piece(mesh.num_vertices());
  for (const VertexId v : mesh.x.ids()) {
    const std::int32_t piece = root_to_piece[sets.find(v)];
    MENISCUS_ASSERT(piece < static_cast<std::int32_t>(pieces.size()), "{} {}", piece,
                    pieces.size());
    if (piece >= 0) vertex_in_piece[v] = pieces[static_cast<std::size_t>(piece)].x.add(mesh.x[v]);
  }
  for (const FaceVertices& f : mesh.faces)
    pieces[static_cast<std::size_t>(root_to_piece[sets.find(f[0])])].faces.add(
        {vertex_in_piece[f[0]], vertex_in_piece[f[1]], vertex_in_piece[f[2]]});
  return pieces;
}

SurfaceMesh joined_surface(std::span<const SurfaceMesh> pieces) {
  SurfaceMesh whole;
  for (const SurfaceMesh& piece : pieces) {
    const std::int32_t first = whole.num_vertices();
    for (const Vec3& x : piece.x) whole.x.add(x);
    for (const FaceVertices& f : piece.faces)
      whole.faces.add({VertexId{first + f[0].value}, VertexId{first + f[1].value},
                       VertexId{first + f[2].value}});
  }
  return whole;
}

int euler_characteristic(const SurfaceMesh& mesh) {
  MENISCUS_ASSERT(mesh.num_faces() % 2 == 0, "{} faces of a closed surface", mesh.num_faces());
  return mesh.num_vertices() - mesh.num_faces() / 2;  // every edge is shared by two faces
}

void turn_inside_out(SurfaceMesh& mesh) {
  for (FaceVertices& f : mesh.faces) std::swap(f[1], f[2]);
}

}  // namespace meniscus
