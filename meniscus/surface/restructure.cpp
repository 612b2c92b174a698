#include "meniscus/surface/restructure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "meniscus/core/error.hpp"
#include "meniscus/surface/remesh.hpp"
#include "meniscus/surface/sizing.hpp"

namespace meniscus {
namespace {

// Bands. The mean after k averages over rings is one over some 6 k vertices, of which a vertex more
// or less is 0.16/k. A band of twice that is wide enough that an edit never calls for its own
// undoing.
constexpr double kBandTimesAverages = 0.3;
constexpr std::array<int, 3> kAverages = {2, 8, 32};  // the widest has the band of the whole
constexpr double kLocalBandFar = 0.3;   // beyond, edits may be as close as their faces allow
constexpr int kMostRings = 5;           // an edit of one in a hundred
constexpr double kGlobalBand = 0.01;    // of the whole number; a fifth of the law's 5 %
constexpr double kFewEdits = 0.002;     // of the vertices: wider averages have their turn as well
constexpr double kLongestEdge = 1.6;    // l/l0 split, whatever the density: its halves are 0.8
constexpr double kShortestEdge = 0.55;  // l/l0 collapsed, whatever the density
// What a surface that is not remeshed may have.
constexpr double kShortestKept = 0.6, kLongestKept = 1.5;  // l/l0
constexpr double kDelaunaySlack = 0.02;  // radians of excess over 180°, against flipping for ever
constexpr double kAllowance = 0.3;       // radians per unit of Σ(valence − 6)²
constexpr double kLargestAllowance = 1.2;  // radians
constexpr int kMaxFlipRounds = 10;

struct EdgeScore {
  double score;
  HalfedgeId h;
};

/// An edge as balancing the density sees it.
struct DensityEdge {
  HalfedgeId h;
  VertexId a, b;         ///< its ends
  double squared_ratio;  ///< (l/l0)²
};
std::vector<DensityEdge> density_edges(const RemeshState& state) {
  std::vector<DensityEdge> edges;
  edges.reserve(static_cast<std::size_t>(state.mesh.num_halfedge_slots() / 2));
  for (std::int32_t i = 0; i < state.mesh.num_halfedge_slots(); ++i) {
    const HalfedgeId h{i};
    if (!state.mesh.is_representative(h)) continue;
    const double rest_length = state.rest_length(h);
    edges.push_back({h, state.mesh.from(h), state.mesh.to(h),
                     state.edge_vector(h).squaredNorm() / (rest_length * rest_length)});
  }
  return edges;
}

/// Area of the smooth surface over a face: that of the face times 1 + h²/8R² (equilateral, sphere
/// of radius R, to leading order). It is taken with Σ|Δn|² over its edges for 3h²/R².
double curved_area(const RemeshState& state, HalfedgeId h) {
  const RemeshVertex &a = state.vertices[state.mesh.from(h)], &b = state.vertices[state.mesh.to(h)],
                     &c = state.vertices[state.mesh.opposite(h)];
  const double turning =
      (a.n - b.n).squaredNorm() + (b.n - c.n).squaredNorm() + (c.n - a.n).squaredNorm();
  return 0.5 * (b.x - a.x).cross(c.x - a.x).norm() * (1.0 + turning / 24.0);
}

/// Area of each vertex times its density, which is 1 where the density is right: below, too many
/// vertices; above, too few.
VertexField<double> vertex_loads(const RemeshState& state) {
  const EditMesh& mesh = state.mesh;
  VertexField<double> load(mesh.num_vertex_slots(), 0.0);
  for (std::int32_t i = 0; i < mesh.num_halfedge_slots(); i += 3) {
    const HalfedgeId h{i};
    if (!mesh.is_alive(h)) continue;
    const double third = curved_area(state, h) / 3.0;
    for (const VertexId v : {mesh.from(h), mesh.to(h), mesh.opposite(h)}) load[v] += third;
  }
  for (const VertexId v : load.ids())
    if (mesh.is_alive(v)) load[v] *= density_of_length(state.vertices[v].rest_length);
  return load;
}

/// Averages over the rings, by an exchange along each edge that keeps the sum. What is short of
/// vertices here and over there together comes out right.
class RingAverage {
 public:
  /// The edges must outlive this.
  RingAverage(const std::vector<DensityEdge>& edges, VertexField<double> values)
      : edges_(edges), values_(std::move(values)), change_(values_.size()) {}
  /// Averages until `count` times in all.
  const VertexField<double>& after(int count) {
    constexpr double kExchange = 1.0 / 7.0;  // of a vertex of valence 6 with its ring: their mean
    for (; count_ < count; ++count_) {
      std::ranges::fill(change_, 0.0);
      for (const DensityEdge& edge : edges_) {
        MENISCUS_ASSERT(edge.a.value < values_.size() && edge.b.value < values_.size(), "{} {}",
                        edge.a.value, edge.b.value);
        const double exchange = kExchange * (values_[edge.b] - values_[edge.a]);
        change_[edge.a] += exchange;
        change_[edge.b] -= exchange;
      }
      for (const VertexId v : values_.ids()) values_[v] += change_[v];
    }
    return values_;
  }

 private:
  const std::vector<DensityEdge>& edges_;
  VertexField<double> values_, change_;
  int count_ = 0;
};

/// Marks vertices near an edit so that the rest of the pass leaves them alone.
class Locks {
 public:
  explicit Locks(const EditMesh& mesh)
      : mesh_(mesh), locked_(mesh.num_vertex_slots(), 0), reached_(mesh.num_vertex_slots(), 0) {}
  [[nodiscard]] bool is_locked(HalfedgeId h) const {
    return is_locked(mesh_.from(h)) || is_locked(mesh_.to(h)) || is_locked(mesh_.opposite(h)) ||
           is_locked(mesh_.opposite(mesh_.twin(h)));
  }
  void lock(VertexId v) {
    if (!is_new(v)) locked_[v] = 1;
  }
  void lock_faces(HalfedgeId h) {
    lock(mesh_.from(h));
    lock(mesh_.to(h));
    lock(mesh_.opposite(h));
    lock(mesh_.opposite(mesh_.twin(h)));
  }
  /// v and so many rings around it.
  void lock_rings(VertexId v, int rings) {
    ++search_;
    ring_.clear();
    reach(v);
    for (int number = 0; number < rings; ++number) {
      const std::vector<VertexId> inner = std::exchange(ring_, {});
      for (const VertexId w : inner)
        mesh_.for_each_out(w, [&](HalfedgeId h) { reach(mesh_.to(h)); });
    }
  }

 private:
  /// Made in this pass: always locked.
  [[nodiscard]] bool is_new(VertexId v) const { return v.value >= locked_.size(); }
  [[nodiscard]] bool is_locked(VertexId v) const { return is_new(v) || locked_[v] != 0; }
  void reach(VertexId v) {
    if (is_new(v) || reached_[v] == search_) return;
    reached_[v] = search_;
    locked_[v] = 1;
    ring_.push_back(v);
  }

  const EditMesh& mesh_;
  VertexField<char> locked_;
  VertexField<int> reached_;  // by which search
  std::vector<VertexId> ring_;
  int search_ = 0;
};

void split_edge(RemeshState& state, HalfedgeId h) {
  const RemeshVertex middle = halfway(state.reference, state.vertices[state.mesh.from(h)],
                                      state.vertices[state.mesh.to(h)]);
  const VertexId c = state.mesh.opposite(h), d = state.mesh.opposite(state.mesh.twin(h));
  const VertexId m = state.mesh.split(h);
  MENISCUS_ASSERT(m.value == state.vertices.size(), "{} {}", m.value, state.vertices.size());
  state.vertices.add(middle);
  for (const VertexId v : {m, c, d}) state.touch(v);
}

/// Merges the ends of an edge half-way between them, unless a face would fold.
bool try_collapse_edge(RemeshState& state, HalfedgeId h) {
  const EditMesh& mesh = state.mesh;
  if (!mesh.can_collapse(h)) return false;
  const VertexId a = mesh.from(h), b = mesh.to(h);
  const RemeshVertex merged = halfway(state.reference, state.vertices[a], state.vertices[b]);
  bool is_sound = true;
  const auto check_fan = [&](VertexId center, VertexId other) {
    mesh.for_each_out(center, [&](HalfedgeId g) {
      const VertexId p = mesh.to(g), q = mesh.opposite(g);
      if (p != other && q != other &&
          !is_consistently_oriented(merged, state.vertices[p], state.vertices[q]))
        is_sound = false;
    });
  };
  check_fan(a, b);
  check_fan(b, a);
  if (!is_sound) return false;
  const VertexId c = mesh.opposite(h), d = mesh.opposite(mesh.twin(h));
  state.mesh.collapse(h);
  state.vertices[b] = merged;
  for (const VertexId v : {b, c, d}) state.touch(v);
  return true;
}

/// Whether the two angles that face an edge sum to π and `excess` [radians] or more.
bool is_angle_excess(const RemeshState& state, HalfedgeId h, double excess) {
  const auto x = [&](VertexId v) -> const Vec3& { return state.vertices[v].x; };
  const Vec3 &a = x(state.mesh.from(h)), &b = x(state.mesh.to(h)), &c = x(state.mesh.opposite(h)),
             &d = x(state.mesh.opposite(state.mesh.twin(h)));
  // Cosines and sines, both times one length.
  const double cos_c = (a - c).dot(b - c), cos_d = (a - d).dot(b - d);
  // Two that are not obtuse sum to π at most: nearly all edges cost no root and no arc.
  if (excess > 0.0 && cos_c >= 0.0 && cos_d >= 0.0) return false;
  const double sin_c = (a - c).cross(b - c).norm(), sin_d = (a - d).cross(b - d).norm();
  const double cosine = cos_c * cos_d - sin_c * sin_d, sine = sin_c * cos_d + cos_c * sin_d;
  return -std::atan2(sine, -cosine) >= excess;
}

bool try_flip(RemeshState& state, HalfedgeId h) {
  const EditMesh& mesh = state.mesh;
  const VertexId a = mesh.from(h), b = mesh.to(h), c = mesh.opposite(h),
                 d = mesh.opposite(mesh.twin(h));
  const std::int32_t valence_a = mesh.valence(a), valence_b = mesh.valence(b);
  if (valence_a <= 4 || valence_b <= 4) return false;
  // Growth of Σ(valence − 6)² by the flip.
  const std::int32_t growth = 2 * (mesh.valence(c) + mesh.valence(d) - valence_a - valence_b) + 4;
  const double threshold = std::clamp(kAllowance * growth, -kLargestAllowance, kLargestAllowance);
  if (!is_angle_excess(state, h, threshold + kDelaunaySlack) || mesh.are_joined(c, d)) return false;
  const VertexField<RemeshVertex>& v = state.vertices;
  if (!is_consistently_oriented(v[d], v[c], v[a]) || !is_consistently_oriented(v[c], v[d], v[b]))
    return false;
  state.mesh.flip(h);
  return true;
}

std::array<VertexId, 4> edge_corners(const EditMesh& mesh, HalfedgeId h) {
  return {mesh.from(h), mesh.to(h), mesh.opposite(h), mesh.opposite(mesh.twin(h))};
}

/// Edges to be looked at, each marked by one of its half-edges, in the order of these. Whether an
/// edge flips depends on its four corners alone.
class EdgeMarks {
 public:
  explicit EdgeMarks(const EditMesh& mesh)
      : mesh_(mesh), marks_(static_cast<std::size_t>(mesh.num_halfedge_slots()), 0) {}
  /// Every edge of which v is a corner.
  void mark_around(VertexId v) {
    mesh_.for_each_out(v, [&](HalfedgeId h) {
      mark(h);
      mark(EditMesh::next(h));
    });
  }
  void clear(HalfedgeId h) { marks_[static_cast<std::size_t>(h.value)] = 0; }
  /// The first marked one behind h, or none.
  [[nodiscard]] HalfedgeId next_after(HalfedgeId h) const {
    // Few are marked: memchr passes over the others many at a time.
    const char* const begin = marks_.data() + h.value + 1;
    const char* const end = marks_.data() + marks_.size();
    const void* const found = std::memchr(begin, 1, static_cast<std::size_t>(end - begin));
    if (found == nullptr) return {};
    return {static_cast<std::int32_t>(static_cast<const char*>(found) - marks_.data())};
  }

 private:
  void mark(HalfedgeId h) {
    marks_[static_cast<std::size_t>(std::min(h, mesh_.twin(h)).value)] = 1;
  }
  const EditMesh& mesh_;
  std::vector<char> marks_;
};

/// Edges wanted for splitting (score > 0, largest first) or collapsing (score < 0).
struct Candidates {
  std::vector<EdgeScore> splits, collapses;
};

/// How far the neighbourhood is from its density, in units of one vertex per vertex, and among its
/// edges the longest and the shortest first.
Candidates density_candidates(const std::vector<DensityEdge>& edges,
                              const VertexField<double>& mean_load, double band) {
  Candidates result;
  for (const auto& [h, a, b, squared] : edges) {
    const double mean = 0.5 * (mean_load[a] + mean_load[b]);
    if ((mean > 1.0 + band && squared > 1.0) || squared > kLongestEdge * kLongestEdge)
      result.splits.push_back({mean * squared, h});
    else if ((mean < 1.0 - band && squared < 1.0) || squared < kShortestEdge * kShortestEdge)
      result.collapses.push_back({mean * squared, h});
  }
  const auto order = [](const EdgeScore& p, const EdgeScore& q) {
    return std::tuple(p.score, p.h.value) < std::tuple(q.score, q.h.value);
  };
  std::ranges::sort(result.splits, [&](const auto& p, const auto& q) { return order(q, p); });
  std::ranges::sort(result.collapses, order);
  return result;
}

/// Rings around an edit that see none other in the same pass. Where the load is off by x every
/// 1/x-th vertex is to be edited, and r rings are 1 + 3r(r + 1) vertices.
int rings_of_an_edit(double mean_load) {
  const double off = std::abs(mean_load - 1.0);
  if (off > kLocalBandFar) return 0;
  return std::clamp(static_cast<int>(std::sqrt(1.0 / (3.0 * off))), 1, kMostRings);
}

/// Takes candidates in order of need, so many at most.
DensityEdits edit(RemeshState& state, const Candidates& candidates,
                  const VertexField<double>& mean_load, const DensityEdits& most, Locks& locks) {
  DensityEdits edits;
  for (const auto& [score, h] : candidates.splits) {
    if (edits.splits == most.splits) break;
    if (!state.mesh.is_alive(h) || locks.is_locked(h)) continue;
    const int rings = rings_of_an_edit(mean_load[state.mesh.from(h)]);
    locks.lock_faces(h);
    if (rings > 0)
      for (const VertexId v : {state.mesh.from(h), state.mesh.to(h)}) locks.lock_rings(v, rings);
    split_edge(state, h);
    ++edits.splits;
  }
  for (const auto& [score, h] : candidates.collapses) {
    if (edits.collapses == most.collapses) break;
    if (!state.mesh.is_alive(h) || locks.is_locked(h)) continue;
    const VertexId kept = state.mesh.to(h), c = state.mesh.opposite(h),
                   d = state.mesh.opposite(state.mesh.twin(h));
    const int rings = rings_of_an_edit(mean_load[kept]);
    if (!try_collapse_edge(state, h)) continue;
    for (const VertexId v : {kept, c, d}) locks.lock(v);
    locks.lock_rings(kept, rings);
    ++edits.collapses;
  }
  return edits;
}

}  // namespace

int flip_to_delaunay(RemeshState& state) {
  EdgeMarks due(state.mesh);
  for (const VertexId v : state.unflipped.take())
    if (state.mesh.is_alive(v)) due.mark_around(v);
  int flips = 0;
  for (int round = 0; round < kMaxFlipRounds; ++round) {
    int flipped = 0;
    for (HalfedgeId h = due.next_after({-1}); h.is_valid(); h = due.next_after(h)) {
      due.clear(h);
      const std::array<VertexId, 4> corners = edge_corners(state.mesh, h);
      if (!try_flip(state, h)) continue;
      for (const VertexId v : corners) {
        due.mark_around(v);
        state.touch(v);
      }
      ++flipped;
    }
    flips += flipped;
    if (flipped == 0) break;
  }
  return flips;
}

DensityEdits balance_density(RemeshState& state) {
  const VertexField<double> load = vertex_loads(state);
  const std::vector<DensityEdge> edges = density_edges(state);
  RingAverage averaged(edges, load);
  Locks locks(state.mesh);
  DensityEdits all;
  for (const int averages : kAverages) {
    const VertexField<double>& mean_load = averaged.after(averages);
    const double band = std::max(kBandTimesAverages / averages, kGlobalBand);
    const int unlimited = state.mesh.num_vertices();
    const DensityEdits edits = edit(state, density_candidates(edges, mean_load, band), mean_load,
                                    {unlimited, unlimited}, locks);
    all.splits += edits.splits;
    all.collapses += edits.collapses;
    // A place or two that no edit cures must not keep the whole waiting.
    if (all.splits + all.collapses > kFewEdits * state.mesh.num_vertices()) return all;
  }
  if (all.splits + all.collapses > 0) return all;
  const VertexField<double>& mean_load = averaged.after(kAverages.back());

  const double expected = std::accumulate(load.begin(), load.end(), 0.0);
  const double missing = expected - state.mesh.num_vertices();
  const int count = static_cast<int>(std::lround(std::abs(missing)));
  if (count <= 1 || count <= kGlobalBand * expected) return {};
  // A negative band makes every edge longer (or shorter) than its rest length a candidate.
  const Candidates candidates = density_candidates(edges, mean_load, -1.0);
  if (missing > 0.0) return edit(state, {candidates.splits, {}}, mean_load, {count, 0}, locks);
  return edit(state, {{}, candidates.collapses}, mean_load, {0, count}, locks);
}

bool has_fit_density(const RemeshState& state, const KeptDensity& kept) {
  const std::vector<DensityEdge> edges = density_edges(state);
  const bool have_length = std::ranges::all_of(edges, [](const DensityEdge& edge) {
    return edge.squared_ratio > kShortestKept * kShortestKept &&
           edge.squared_ratio < kLongestKept * kLongestKept;
  });
  if (!have_length) return false;
  const VertexField<double> load = vertex_loads(state);
  const double mean = std::accumulate(load.begin(), load.end(), 0.0) / state.mesh.num_vertices();
  RingAverage averaged(edges, load);
  return std::abs(mean - 1.0) <= kept.whole &&
         std::ranges::all_of(averaged.after(kAverages.front()), [&](double local) {
           return local >= kept.fewest && local <= kept.most;
         });
}

double expected_vertices(const RemeshState& state) {
  const VertexField<double> load = vertex_loads(state);
  return std::accumulate(load.begin(), load.end(), 0.0);
}

}  // namespace meniscus
