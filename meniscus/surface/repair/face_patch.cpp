#include "meniscus/surface/repair/face_patch.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {
namespace {

using Successors = std::map<VertexId, VertexId>;

/// From each vertex of the boundary to the next; none where a vertex has two.
std::optional<Successors> boundary_successors(const SurfaceMesh& mesh, const FacePatch& patch) {
  std::set<std::pair<VertexId, VertexId>> directed;
  for (const FaceId f : mesh.faces.ids())
    if (patch[f])
      for (std::size_t k = 0; k < 3; ++k)
        directed.emplace(mesh.faces[f][k], mesh.faces[f][(k + 1) % 3]);
  Successors next;
  for (const auto& [a, b] : directed)
    if (!directed.contains({b, a}) && !next.emplace(a, b).second) return std::nullopt;
  return next;
}

/// Vertices at which the faces around change more than once from inside the patch to outside it.
std::vector<VertexId> pinched_vertices(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                                       const FacePatch& patch) {
  std::vector<VertexId> pinched;
  for (const VertexId v : mesh.x.ids()) {
    const auto faces = topology.faces_around(v);
    int changes = 0;
    for (std::size_t k = 0; k < faces.size(); ++k)
      if (patch[faces[k]] && !patch[faces[(k + 1) % faces.size()]]) ++changes;
    if (changes > 1) pinched.push_back(v);
  }
  return pinched;
}

void open_pinches(const SurfaceMesh& mesh, const SurfaceTopology& topology, FacePatch& patch) {
  for (auto pinched = pinched_vertices(mesh, topology, patch); !pinched.empty();
       pinched = pinched_vertices(mesh, topology, patch))
    for (const VertexId v : pinched)
      for (const FaceId f : topology.faces_around(v)) patch[f] = true;
}

/// The connected parts of what a patch leaves of the piece of the surface that it lies on.
std::vector<std::vector<FaceId>> complement_parts(const SurfaceMesh& mesh,
                                                  const FaceNeighbours& neighbours,
                                                  const FacePatch& patch) {
  FacePatch is_seen = patch;
  std::vector<std::vector<FaceId>> parts;
  for (const FaceId first : mesh.faces.ids()) {
    if (is_seen[first]) continue;
    std::vector<FaceId>& part = parts.emplace_back(1, first);
    is_seen[first] = true;
    bool is_beside = false;
    for (std::size_t k = 0; k < part.size(); ++k)
      for (const FaceId f : neighbours[part[k]]) {
        is_beside = is_beside || patch[f];
        if (is_seen[f]) continue;
        is_seen[f] = true;
        part.push_back(f);
      }
    if (!is_beside) parts.pop_back();
  }
  return parts;
}

double area_of(const SurfaceMesh& mesh, std::span<const FaceId> faces) {
  double area = 0.0;
  for (const FaceId f : faces) area += face_area_vector(mesh, f).norm();
  return area;
}

/// Adds what a patch leaves of its piece of the surface, except the largest parts of it (by area).
void fill_all_but(std::size_t kept, const SurfaceMesh& mesh, const FaceNeighbours& neighbours,
                  FacePatch& patch) {
  std::vector<std::vector<FaceId>> parts = complement_parts(mesh, neighbours, patch);
  std::ranges::sort(
      parts, [&](const auto& a, const auto& b) { return area_of(mesh, a) > area_of(mesh, b); });
  for (std::size_t k = kept; k < parts.size(); ++k)
    for (const FaceId f : parts[k]) patch[f] = true;
}

}  // namespace

FaceNeighbours face_neighbours(const SurfaceMesh& mesh, const SurfaceTopology& topology) {
  FaceNeighbours neighbours(mesh.num_faces());
  FaceField<std::size_t> count(mesh.num_faces(), 0);
  for (const SurfaceEdge& e : topology.edges()) {
    neighbours[e.left][count[e.left]++] = e.right;
    neighbours[e.right][count[e.right]++] = e.left;
  }
  return neighbours;
}

std::optional<std::vector<std::vector<VertexId>>> boundary_curves(const SurfaceMesh& mesh,
                                                                  const FacePatch& patch) {
  std::optional<Successors> next = boundary_successors(mesh, patch);
  if (!next) return std::nullopt;
  std::vector<std::vector<VertexId>> curves;
  while (!next->empty()) {
    std::vector<VertexId>& curve = curves.emplace_back();
    const VertexId first = next->begin()->first;
    VertexId v = first;
    do {
      const auto found = next->find(v);
      if (found == next->end()) return std::nullopt;
      curve.push_back(v);
      v = found->second;
      next->erase(found);
    } while (v != first);
  }
  return curves;
}

bool is_planar(const SurfaceMesh& mesh, const FacePatch& patch, std::size_t num_boundaries) {
  std::set<VertexId> vertices;
  std::set<std::pair<VertexId, VertexId>> edges;
  long num_faces = 0;
  for (const FaceId f : mesh.faces.ids()) {
    if (!patch[f]) continue;
    ++num_faces;
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = mesh.faces[f][k], b = mesh.faces[f][(k + 1) % 3];
      vertices.insert(a);
      edges.insert(std::minmax(a, b));
    }
  }
  const long euler =
      static_cast<long>(vertices.size()) - static_cast<long>(edges.size()) + num_faces;
  return euler == 2 - static_cast<long>(num_boundaries);
}

bool make_ring(const SurfaceMesh& mesh, const SurfaceTopology& topology,
               const FaceNeighbours& neighbours, FacePatch& patch) {
  open_pinches(mesh, topology, patch);
  fill_all_but(2, mesh, neighbours, patch);
  const auto curves = boundary_curves(mesh, patch);
  return curves && curves->size() == 2 && is_planar(mesh, patch, 2);
}

bool make_disc(const SurfaceMesh& mesh, const SurfaceTopology& topology,
               const FaceNeighbours& neighbours, FacePatch& patch) {
  open_pinches(mesh, topology, patch);
  fill_all_but(1, mesh, neighbours, patch);
  const auto curves = boundary_curves(mesh, patch);
  return curves && curves->size() == 1 && is_planar(mesh, patch, 1);
}

SurfaceMesh remaining_surface(const SurfaceMesh& mesh, const FacePatch& patch) {
  MENISCUS_ASSERT(patch.size() == mesh.num_faces(), "{} {}", patch.size(), mesh.num_faces());
  SurfaceMesh rest;
  rest.x = mesh.x;
  for (const FaceId f : mesh.faces.ids())
    if (!patch[f]) rest.faces.add(mesh.faces[f]);
  return rest;
}

}  // namespace meniscus
