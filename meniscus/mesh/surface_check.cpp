#include "meniscus/mesh/surface_check.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <random>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/geometry/predicates.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_tree.hpp"

namespace meniscus {
namespace {

Triangle corners(const SurfaceMesh& mesh, FaceId f) {
  const FaceVertices& v = mesh.faces[f];
  return {mesh.x[v[0]], mesh.x[v[1]], mesh.x[v[2]]};
}

Vec3 low(const Triangle& x) { return x[0].cwiseMin(x[1]).cwiseMin(x[2]); }
Vec3 high(const Triangle& x) { return x[0].cwiseMax(x[1]).cwiseMax(x[2]); }

/// A point near which two triangles meet, for messages: the middle of the overlap of their boxes.
Vec3 meeting_point(const Triangle& s, const Triangle& t) {
  return 0.5 * (low(s).cwiseMax(low(t)) + high(s).cwiseMin(high(t)));
}

/// Whether two faces of one surface meet elsewhere than in the vertices they share.
bool meet_elsewhere(const SurfaceMesh& mesh, FaceId f, FaceId g) {
  const FaceVertices &u = mesh.faces[f], &v = mesh.faces[g];
  std::array<std::size_t, 3> shared_in_f{}, shared_in_g{};
  std::size_t num_shared = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (u[i] == v[j] && num_shared < 3) {
        shared_in_f[num_shared] = i;
        shared_in_g[num_shared++] = j;
      }
  const Triangle s = corners(mesh, f), t = corners(mesh, g);
  if (num_shared == 0) return do_intersect(s, t);
  if (num_shared == 1) {
    // What they share is convex and contains the vertex. If it is more than that, it reaches the
    // edge of one of them that lies opposite the vertex.
    const std::size_t i = shared_in_f[0], j = shared_in_g[0];
    return do_intersect(s, t[(j + 1) % 3], t[(j + 2) % 3]) ||
           do_intersect(t, s[(i + 1) % 3], s[(i + 2) % 3]);
  }
  if (num_shared == 2) {
    const std::size_t i = 3 - shared_in_f[0] - shared_in_f[1],
                      j = 3 - shared_in_g[0] - shared_in_g[1];
    return is_folded(s[shared_in_f[0]], s[shared_in_f[1]], s[i], t[j]);
  }
  return true;
}

/// Sine of the least angle at a vertex, seen along its normal, that counts as one: far above
/// round-off.
constexpr double kTurn = 1e-6;

/// Whether the faces around each vertex, seen along its area vector, all turn the same way and go
/// round it once. They then lie side by side, and no two of them meet but in what they share. Most
/// vertices of a surface that is not crumpled are such, which spares their faces exact tests.
VertexField<char> fans(const SurfaceMesh& mesh) {
  VertexField<Vec3> t1 = vertex_area_vectors(mesh), t2(mesh.num_vertices());
  for (const VertexId v : mesh.x.ids()) {
    const Vec3 n = t1[v].stableNormalized();
    t1[v] = n.unitOrthogonal();
    t2[v] = n.cross(t1[v]);
  }
  VertexField<char> turns(mesh.num_vertices(), true);
  VertexField<int> rounds(mesh.num_vertices(), 0);  // how often the faces pass the first axis
  for (const FaceVertices& f : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId v = f[k];
      const Vec3 a = mesh.x[f[(k + 1) % 3]] - mesh.x[v], b = mesh.x[f[(k + 2) % 3]] - mesh.x[v];
      const double a1 = a.dot(t1[v]), a2 = a.dot(t2[v]), b1 = b.dot(t1[v]), b2 = b.dot(t2[v]);
      const double cross = a1 * b2 - a2 * b1;
      turns[v] = turns[v] && cross * cross > kTurn * kTurn * a.squaredNorm() * b.squaredNorm() &&
                 cross > 0.0;
      rounds[v] += static_cast<int>(a2 < 0.0 && b2 >= 0.0);
    }
  for (const VertexId v : turns.ids()) turns[v] = turns[v] && rounds[v] == 1;
  return turns;
}

std::optional<Fault> find_self_intersection(const SurfaceMesh& mesh, const SurfaceTree& tree) {
  const VertexField<char> is_fan = fans(mesh);
  const auto lie_side_by_side = [&](FaceId f, FaceId g) {
    return std::ranges::any_of(mesh.faces[f], [&](VertexId v) {
      return is_fan[v] && std::ranges::find(mesh.faces[g], v) != mesh.faces[g].end();
    });
  };
  std::optional<Fault> found;
  tree.visit_touching_pairs([&](FaceId f, const Triangle& s, FaceId g, const Triangle& t) {
    if (lie_side_by_side(f, g) || !meet_elsewhere(mesh, f, g)) return true;
    const Vec3 x = meeting_point(s, t);
    found = Fault{FaultKind::self_intersection,
                  fmt::format("surface meets itself near {} (faces {} and {})", text_of(x),
                              std::min(f, g).value, std::max(f, g).value),
                  x};
    return false;
  });
  return found;
}

/// Whether the segment p q crosses the inside of a triangle. That is unclear when it passes through
/// an edge or a corner, or an end of it lies in the triangle's plane.
enum class Crossing { no, yes, unclear };
Crossing crossing(const Triangle& x, const Vec3& p, const Vec3& q) {
  const int side_of_p = orientation(x[0], x[1], x[2], p),
            side_of_q = orientation(x[0], x[1], x[2], q);
  if (side_of_p * side_of_q > 0) return Crossing::no;
  const std::array<int, 3> turn{orientation(p, q, x[0], x[1]), orientation(p, q, x[1], x[2]),
                                orientation(p, q, x[2], x[0])};
  const auto [least, most] = std::ranges::minmax(turn);
  if (least < 0 && most > 0) return Crossing::no;
  const bool is_clear = side_of_p != 0 && side_of_q != 0 && least == most && least != 0;
  return is_clear ? Crossing::yes : Crossing::unclear;
}

bool has_vertices_out_of_range(const SurfaceMesh& mesh) {
  return std::ranges::any_of(mesh.faces, [&](const FaceVertices& f) {
    return std::ranges::any_of(
        f, [&](VertexId v) { return v.value < 0 || v.value >= mesh.num_vertices(); });
  });
}

/// The first vertex that no path of edges joins to vertex 0.
std::optional<Fault> find_second_piece(const SurfaceMesh& mesh, const SurfaceTopology& topology) {
  VertexField<char> is_reached(mesh.num_vertices(), false);
  std::vector<VertexId> front{VertexId{0}};
  is_reached[VertexId{0}] = true;
  while (!front.empty()) {
    const VertexId v = front.back();
    front.pop_back();
    for (const VertexId w : topology.ring(v)) {
      if (is_reached[w]) continue;
      is_reached[w] = true;
      front.push_back(w);
    }
  }
  for (const VertexId v : mesh.x.ids())
    if (!is_reached[v])
      return Fault{FaultKind::several_pieces,
                   fmt::format("surface is in more than one piece: vertex {} at {} is not joined "
                               "to vertex 0 at {}",
                               v.value, text_of(mesh.x[v]), text_of(mesh.x[VertexId{0}])),
                   mesh.x[v]};
  return {};
}

std::optional<Fault> find_broken_topology(const SurfaceMesh& mesh) {
  const auto built = SurfaceTopology::try_build(mesh);
  if (const Fault* fault = std::get_if<Fault>(&built)) return *fault;
  const auto& topology = std::get<SurfaceTopology>(built);
  for (const VertexId v : mesh.x.ids())
    if (topology.valence(v) == 0)
      return Fault{FaultKind::connectivity,
                   fmt::format("vertex {} at {} belongs to no face", v.value, text_of(mesh.x[v])),
                   mesh.x[v]};
  return find_second_piece(mesh, topology);
}

std::optional<Fault> find_vertex_not_finite(const SurfaceMesh& mesh) {
  for (const VertexId v : mesh.x.ids())
    if (!mesh.x[v].allFinite())
      return Fault{FaultKind::not_finite, fmt::format("vertex {} is not finite", v.value)};
  return {};
}

}  // namespace

std::optional<Fault> find_defect(const SurfaceMesh& mesh) {
  if (mesh.num_faces() == 0) return Fault{FaultKind::connectivity, "surface has no faces"};
  if (has_vertices_out_of_range(mesh))
    return Fault{FaultKind::connectivity, "surface has a face that names a missing vertex"};
  if (auto fault = find_vertex_not_finite(mesh)) return fault;
  if (auto fault = find_broken_topology(mesh)) return fault;
  if (auto fault = find_degenerate_face(mesh)) return fault;
  if (auto fault = find_self_intersection(mesh)) return fault;
  if (const double volume = enclosed_volume(mesh); !(volume > 0.0))
    return Fault{FaultKind::no_volume,
                 fmt::format("surface is inside out: it encloses the volume {:.6g}", volume)};
  return {};
}

std::optional<Fault> find_degenerate_face(const SurfaceMesh& mesh) {
  for (const FaceId f : mesh.faces.ids())
    if (const Triangle x = corners(mesh, f); is_degenerate(x))
      return Fault{FaultKind::degenerate_face,
                   fmt::format("face {} near {} has no area", f.value, text_of(x[0])), x[0]};
  return {};
}

std::optional<Fault> find_self_intersection(const SurfaceMesh& mesh) {
  if (!is_finite(mesh)) return Fault{FaultKind::not_finite, "surface is not finite"};
  return find_self_intersection(mesh, SurfaceTree(mesh));
}

std::optional<Fault> find_intersection(const SurfaceMesh& a, const SurfaceMesh& b) {
  if (!is_finite(a) || !is_finite(b))
    return Fault{FaultKind::not_finite, "a surface is not finite"};
  return find_intersection(a, SurfaceTree(b));
}

std::optional<Fault> find_intersection(const SurfaceMesh& a, const SurfaceTree& b) {
  std::optional<Fault> found;
  for (const FaceId f : a.faces.ids()) {
    const Triangle s = corners(a, f);
    b.visit_box(low(s), high(s), [&](FaceId g, const Triangle& t) {
      if (!do_intersect(s, t)) return true;
      const Vec3 x = meeting_point(s, t);
      found = Fault{FaultKind::intersection,
                    fmt::format("surfaces meet near {} (face {} of the first, {} of the second)",
                                text_of(x), f.value, g.value),
                    x};
      return false;
    });
    if (found) break;
  }
  return found;
}

bool encloses(const SurfaceMesh& mesh, const Vec3& point) {
  return encloses(SurfaceTree(mesh), point);
}

bool encloses(const SurfaceTree& tree, const Vec3& point) {
  if ((point.array() < tree.low().array()).any() || (point.array() > tree.high().array()).any())
    return false;
  // Rays nearly along an axis and no longer than out of the tree's box, the shortest first, so that
  // their own boxes touch few faces. One that grazes an edge or a vertex does not count: another is
  // drawn.
  const double margin = 1e-3 * (tree.high() - tree.low()).norm();
  std::array<double, 6> to_leave{};
  for (int k = 0; k < 3; ++k) {
    to_leave[k] = point[k] - tree.low()[k] + margin;
    to_leave[k + 3] = tree.high()[k] - point[k] + margin;
  }
  std::array<std::size_t, 6> order{0, 1, 2, 3, 4, 5};
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return to_leave[k]; });
  std::minstd_rand random(1);
  std::uniform_real_distribution<double> tilt(-0.02, 0.02);
  for (std::size_t attempt = 0; attempt < 18; ++attempt) {
    const std::size_t way = order[attempt % order.size()];
    Vec3 direction(tilt(random), tilt(random), tilt(random));
    direction[static_cast<int>(way % 3)] = way < 3 ? -1.0 : 1.0;
    const Vec3 end = point + to_leave[way] * direction;
    int crossings = 0;
    bool is_clear = true, is_on_surface = false;
    tree.visit_box(point.cwiseMin(end), point.cwiseMax(end), [&](FaceId, const Triangle& x) {
      const Crossing here = crossing(x, point, end);
      if (here == Crossing::yes) ++crossings;
      is_clear = here != Crossing::unclear;
      is_on_surface = !is_clear && contains(x, point);
      return is_clear;
    });
    if (is_on_surface) return false;
    if (is_clear) return crossings % 2 == 1;
  }
  return false;
}

double smallest_gap(const SurfaceMesh& a, const SurfaceMesh& b) {
  const SurfaceTree tree_a(a), tree_b(b);
  double gap = std::numeric_limits<double>::infinity();
  for (const Vec3& x : a.x) gap = std::min(gap, tree_b.closest(x, gap).distance);
  for (const Vec3& x : b.x) gap = std::min(gap, tree_a.closest(x, gap).distance);
  return gap;
}

}  // namespace meniscus
