#include "meniscus/mesh/surface_mesh.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

struct DirectedEdge {
  VertexId from, to, opposite;
  FaceId face;
};

/// The edges of all faces in the order of their smaller end, larger end, direction and face. A
/// counting sort goes over the smaller ends, whose few edges are then sorted each by themselves.
std::vector<DirectedEdge> directed_edges(const SurfaceMesh& mesh) {
  std::vector<std::int32_t> first(static_cast<std::size_t>(mesh.num_vertices()) + 1, 0);
  const auto smaller = [](VertexId a, VertexId b) {
    return static_cast<std::size_t>(std::min(a, b).value);
  };
  for (const FaceVertices& v : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) ++first[smaller(v[k], v[(k + 1) % 3]) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());

  std::vector<DirectedEdge> edges(3 * static_cast<std::size_t>(mesh.num_faces()));
  MENISCUS_ASSERT(static_cast<std::size_t>(first.back()) == edges.size(), "{} {}", first.back(),
                  edges.size());
  std::vector<std::int32_t> next(first.begin(), first.end() - 1);
  for (const FaceId f : mesh.faces.ids()) {
    const FaceVertices& v = mesh.faces[f];
    for (std::size_t k = 0; k < 3; ++k) {
      std::int32_t& slot = next[smaller(v[k], v[(k + 1) % 3])];
      edges[static_cast<std::size_t>(slot++)] = {v[k], v[(k + 1) % 3], v[(k + 2) % 3], f};
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

Fault edge_fault(const SurfaceMesh& mesh, const DirectedEdge& e, const char* what) {
  const Vec3 middle = 0.5 * (mesh.x[e.from] + mesh.x[e.to]);
  return {FaultKind::connectivity,
          fmt::format("surface is {} at the edge of vertices {} and {}, near {}", what,
                      e.from.value, e.to.value, text_of(middle)),
          middle};
}

Fault vertex_fault(const SurfaceMesh& mesh, VertexId v) {
  return {FaultKind::connectivity,
          fmt::format("surface is not manifold at vertex {}, near {}: its faces form more than "
                      "one fan",
                      v.value, text_of(mesh.x[v])),
          mesh.x[v]};
}

/// A corner of a face gives one step of the ring of its vertex: next neighbour → the one after.
struct Corner {
  VertexId next, after;
  FaceId face;
};

/// The corners at each vertex v, from first[v] on, in the order of their faces.
std::vector<Corner> corners_by_vertex(const SurfaceMesh& mesh,
                                      const std::vector<std::int32_t>& first) {
  MENISCUS_ASSERT(first.back() == 3 * mesh.num_faces(), "{} {}", first.back(), mesh.num_faces());
  std::vector<Corner> corners(static_cast<std::size_t>(first.back()));
  std::vector<std::int32_t> filled(first.begin(), first.end() - 1);
  for (const FaceId f : mesh.faces.ids()) {
    const FaceVertices& v = mesh.faces[f];
    for (std::size_t k = 0; k < 3; ++k) {
      std::int32_t& slot = filled[static_cast<std::size_t>(v[k].value)];
      corners[static_cast<std::size_t>(slot++)] = {v[(k + 1) % 3], v[(k + 2) % 3], f};
    }
  }
  return corners;
}

/// Orders the corners of one vertex counter-clockwise from its smallest neighbour, so that the
/// ring does not depend on the order of faces. False when they form more than one fan.
bool order_fan(std::span<Corner> corners) {
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto rest = corners.subspan(k);
    const auto next = k == 0 ? std::ranges::min_element(rest, {}, &Corner::next)
                             : std::ranges::find(rest, corners[k - 1].after, &Corner::next);
    if (next == rest.end()) return false;
    std::swap(rest.front(), *next);
  }
  return corners.empty() || corners.back().after == corners.front().next;
}

}  // namespace

SurfaceTopology::SurfaceTopology(const SurfaceMesh& mesh) {
  auto made = try_build(mesh);
  if (const Fault* fault = std::get_if<Fault>(&made)) throw InvalidInput(fault->text);
  *this = std::get<SurfaceTopology>(std::move(made));
}

std::variant<SurfaceTopology, Fault> SurfaceTopology::try_build(const SurfaceMesh& mesh) {
  SurfaceTopology topology;
  if (auto fault = topology.add_edges(mesh)) return *std::move(fault);
  if (auto fault = topology.add_rings(mesh)) return *std::move(fault);
  return topology;
}

std::optional<Fault> SurfaceTopology::add_edges(const SurfaceMesh& mesh) {
  const std::vector<DirectedEdge> directed = directed_edges(mesh);
  edges_.reserve(directed.size() / 2);
  for (std::size_t i = 0; i < directed.size(); i += 2) {
    const DirectedEdge& e = directed[i];
    const auto is_same = [&](std::size_t j) {
      return j < directed.size() &&
             std::minmax(e.from, e.to) == std::minmax(directed[j].from, directed[j].to);
    };
    if (!is_same(i + 1)) return edge_fault(mesh, e, "not closed");
    if (is_same(i + 2)) return edge_fault(mesh, e, "not manifold");
    const DirectedEdge& twin = directed[i + 1];
    if (twin.from == e.from) return edge_fault(mesh, e, "not consistently oriented");
    edges_.push_back({e.from, e.to, e.face, twin.face, e.opposite, twin.opposite});
  }
  return {};
}

std::optional<Fault> SurfaceTopology::add_rings(const SurfaceMesh& mesh) {
  first_.assign(static_cast<std::size_t>(mesh.num_vertices()) + 1, 0);
  for (const FaceVertices& f : mesh.faces)
    for (const VertexId v : f) ++first_[static_cast<std::size_t>(v.value) + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<Corner> corners = corners_by_vertex(mesh, first_);
  for (const VertexId v : mesh.x.ids()) {
    const auto i = static_cast<std::size_t>(v.value);
    const auto begin = static_cast<std::size_t>(first_[i]);
    const auto count = static_cast<std::size_t>(first_[i + 1]) - begin;
    MENISCUS_ASSERT(begin + count <= corners.size(), "{} {} {}", begin, count, corners.size());
    if (!order_fan(std::span(corners).subspan(begin, count))) return vertex_fault(mesh, v);
  }
  ring_.reserve(corners.size());
  around_.reserve(corners.size());
  for (const Corner& corner : corners) {
    ring_.push_back(corner.next);
    around_.push_back(corner.face);
  }
  return {};
}

std::optional<Fault> find_broken_connectivity(const SurfaceMesh& mesh) {
  const auto made = SurfaceTopology::try_build(mesh);
  if (const Fault* fault = std::get_if<Fault>(&made)) return *fault;
  return {};
}

std::span<const VertexId> SurfaceTopology::ring(VertexId v) const {
  const auto i = static_cast<std::size_t>(v.value);
  MENISCUS_ASSERT(i + 1 < first_.size(), "vertex {}", v.value);
  return std::span(ring_).subspan(static_cast<std::size_t>(first_[i]),
                                  static_cast<std::size_t>(first_[i + 1] - first_[i]));
}

std::span<const FaceId> SurfaceTopology::faces_around(VertexId v) const {
  const auto i = static_cast<std::size_t>(v.value);
  MENISCUS_ASSERT(i + 1 < first_.size(), "vertex {}", v.value);
  return std::span(around_).subspan(static_cast<std::size_t>(first_[i]),
                                    static_cast<std::size_t>(first_[i + 1] - first_[i]));
}

}  // namespace meniscus
