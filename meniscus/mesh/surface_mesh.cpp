#include "meniscus/mesh/surface_mesh.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

struct DirectedEdge {
  VertexId from, to, opposite;
  FaceId face;
};

/// The edges of all faces in the order of their smaller end, larger end, direction and face: by a
/// counting sort over the smaller ends, whose few edges are then sorted each by themselves.
std::vector<DirectedEdge> directed_edges(const SurfaceMesh& mesh) {
  std::vector<std::int32_t> first(static_cast<std::size_t>(mesh.num_vertices()) + 1, 0);
  const auto smaller = [](VertexId a, VertexId b) {
    return static_cast<std::size_t>(std::min(a, b).value);
  };
  for (const FaceVertices& v : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) ++first[smaller(v[k], v[(k + 1) % 3]) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());

  std::vector<DirectedEdge> edges(3 * static_cast<std::size_t>(mesh.num_faces()));
  std::vector<std::int32_t> next(first.begin(), first.end() - 1);
  for (const FaceId f : mesh.faces.ids()) {
    const FaceVertices& v = mesh.faces[f];
    for (std::size_t k = 0; k < 3; ++k) {
      std::int32_t& place = next[smaller(v[k], v[(k + 1) % 3])];
      edges[static_cast<std::size_t>(place++)] = {v[k], v[(k + 1) % 3], v[(k + 2) % 3], f};
    }
  }
  for (std::size_t i = 0; i + 1 < first.size(); ++i)
    std::sort(edges.begin() + first[i], edges.begin() + first[i + 1],
              [](const DirectedEdge& d, const DirectedEdge& e) {
                return std::tuple(std::max(d.from, d.to), d.from, d.face) <
                       std::tuple(std::max(e.from, e.to), e.from, e.face);
              });
  return edges;
}

[[noreturn]] void reject_edge(const SurfaceMesh& mesh, const DirectedEdge& e, const char* fault) {
  const Vec3 middle = 0.5 * (mesh.x[e.from] + mesh.x[e.to]);
  reject_input("surface is {} at the edge of vertices {} and {}, near ({:.6g}, {:.6g}, {:.6g})",
               fault, e.from.value, e.to.value, middle.x(), middle.y(), middle.z());
}

}  // namespace

SurfaceTopology::SurfaceTopology(const SurfaceMesh& mesh) {
  const std::vector<DirectedEdge> directed = directed_edges(mesh);
  edges_.reserve(directed.size() / 2);
  for (std::size_t i = 0; i < directed.size(); i += 2) {
    const DirectedEdge& e = directed[i];
    const auto is_same = [&](std::size_t j) {
      return j < directed.size() &&
             std::minmax(e.from, e.to) == std::minmax(directed[j].from, directed[j].to);
    };
    if (!is_same(i + 1)) reject_edge(mesh, e, "not closed");
    if (is_same(i + 2)) reject_edge(mesh, e, "not manifold");
    const DirectedEdge& twin = directed[i + 1];
    if (twin.from == e.from) reject_edge(mesh, e, "not consistently oriented");
    edges_.push_back({e.from, e.to, e.face, twin.face, e.opposite, twin.opposite});
  }

  // Each corner of a face gives one step of the ring of its vertex: next neighbour → the one after.
  const std::size_t n = static_cast<std::size_t>(mesh.num_vertices());
  first_.assign(n + 1, 0);
  for (const FaceVertices& f : mesh.faces)
    for (const VertexId v : f) ++first_[static_cast<std::size_t>(v.value) + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  struct Corner {
    VertexId next, after;
    FaceId face;
  };
  std::vector<Corner> corners(static_cast<std::size_t>(first_.back()));
  std::vector<std::int32_t> filled(first_.begin(), first_.end() - 1);
  for (const FaceId f : mesh.faces.ids()) {
    const FaceVertices& v = mesh.faces[f];
    for (std::size_t k = 0; k < 3; ++k) {
      std::int32_t& slot = filled[static_cast<std::size_t>(v[k].value)];
      corners[static_cast<std::size_t>(slot++)] = {v[(k + 1) % 3], v[(k + 2) % 3], f};
    }
  }
  ring_.resize(corners.size());
  around_.resize(corners.size());
  for (std::size_t v = 0; v < n; ++v) {
    const auto begin = static_cast<std::size_t>(first_[v]),
               end = static_cast<std::size_t>(first_[v + 1]);
    if (begin == end) continue;
    // Start at the smallest neighbour, so that the ring does not depend on the order of faces.
    const auto corner_of = [&](VertexId next) {
      for (std::size_t i = begin; i < end; ++i)
        if (corners[i].next == next) return i;
      return end;
    };
    std::size_t i = begin;
    for (std::size_t j = begin; j < end; ++j)
      if (corners[j].next < corners[i].next) i = j;
    const VertexId start = corners[i].next;
    std::size_t k = begin;
    for (; k < end; ++k) {
      ring_[k] = corners[i].next;
      around_[k] = corners[i].face;
      const VertexId after = corners[i].after;
      if (after == start) break;
      i = corner_of(after);
    }
    if (k + 1 != end) {
      const Vec3& x = mesh.x[VertexId{static_cast<std::int32_t>(v)}];
      reject_input(
          "surface is not manifold at vertex {}, near ({:.6g}, {:.6g}, {:.6g}): its faces form "
          "more than one fan",
          v, x.x(), x.y(), x.z());
    }
  }
}

std::span<const VertexId> SurfaceTopology::ring(VertexId v) const {
  const auto i = static_cast<std::size_t>(v.value);
  return std::span(ring_).subspan(static_cast<std::size_t>(first_[i]),
                                  static_cast<std::size_t>(first_[i + 1] - first_[i]));
}

std::span<const FaceId> SurfaceTopology::faces_around(VertexId v) const {
  const auto i = static_cast<std::size_t>(v.value);
  return std::span(around_).subspan(static_cast<std::size_t>(first_[i]),
                                    static_cast<std::size_t>(first_[i + 1] - first_[i]));
}

}  // namespace meniscus
