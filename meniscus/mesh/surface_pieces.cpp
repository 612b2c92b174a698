#include "meniscus/mesh/surface_pieces.hpp"

#include <algorithm>
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

FaceField<std::int32_t> face_pieces(const SurfaceMesh& mesh) {
  VertexSets sets(mesh.num_vertices());
  for (const FaceVertices& f : mesh.faces) {
    sets.join(f[0], f[1]);
    sets.join(f[1], f[2]);
  }
  VertexField<std::int32_t> root_to_piece(mesh.num_vertices(), -1);
  std::int32_t num_pieces = 0;
  FaceField<std::int32_t> pieces;
  for (const FaceVertices& f : mesh.faces) {
    std::int32_t& piece = root_to_piece[sets.find(f[0])];
    if (piece < 0) piece = num_pieces++;
    pieces.add(piece);
  }
  return pieces;
}

std::vector<SurfaceMesh> connected_pieces(const SurfaceMesh& mesh) {
  const FaceField<std::int32_t> piece_of_face = face_pieces(mesh);
  std::vector<SurfaceMesh> pieces;
  VertexField<std::int32_t> piece_of_vertex(mesh.num_vertices(), -1);
  for (const FaceId f : mesh.faces.ids()) {
    pieces.resize(std::max(pieces.size(), static_cast<std::size_t>(piece_of_face[f]) + 1));
    for (const VertexId v : mesh.faces[f]) piece_of_vertex[v] = piece_of_face[f];
  }
  VertexField<VertexId> vertex_in_piece(mesh.num_vertices());
  for (const VertexId v : mesh.x.ids()) {
    const std::int32_t piece = piece_of_vertex[v];
    MENISCUS_ASSERT(piece < static_cast<std::int32_t>(pieces.size()), "{} {}", piece,
                    pieces.size());
    if (piece >= 0) vertex_in_piece[v] = pieces[static_cast<std::size_t>(piece)].x.add(mesh.x[v]);
  }
  for (const FaceId f : mesh.faces.ids()) {
    const FaceVertices& v = mesh.faces[f];
    pieces[static_cast<std::size_t>(piece_of_face[f])].faces.add(
        {vertex_in_piece[v[0]], vertex_in_piece[v[1]], vertex_in_piece[v[2]]});
  }
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
