#include "meniscus/surface/restructure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

#include <Eigen/Geometry>

#include "meniscus/surface/sizing.hpp"

namespace meniscus {
namespace {

// Bands. A vertex more or less changes the mean over two rings (19 vertices) by 5 %: a band of
// ±15 % is three of them, wide enough that an edit never calls for its own undoing.
constexpr double kLocalBand = 0.15;
constexpr double kLocalBandFar = 0.3;    // beyond, edits may be as close as their faces allow
constexpr double kGlobalBand = 0.01;     // of the whole number; a fifth of the law's 5 %
constexpr double kLongestEdge = 1.6;     // l/l0 split, whatever the density: its halves are 0.8
constexpr double kShortestEdge = 0.55;   // l/l0 collapsed, whatever the density
constexpr double kDelaunaySlack = 0.02;  // radians of excess over 180°, against flipping for ever
constexpr double kAllowance = 0.1;       // radians per unit of Σ(valence − 6)²
constexpr double kLargestAllowance = 0.8;  // radians
constexpr int kMaxFlipRounds = 10;

struct EdgeScore {
  double score;
  HalfedgeId h;
};

/// Area of the smooth surface over a face: that of the face times 1 + h²/8R² (equilateral, sphere
/// of radius R, to leading order), with Σ|Δn|² over its edges for 3h²/R².
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

VertexField<double> ring_averaged(const RemeshState& state, const VertexField<double>& load) {
  VertexField<double> sum = load;
  VertexField<int> count(load.size(), 1);
  for (std::int32_t i = 0; i < state.mesh.num_halfedge_slots(); ++i) {
    const HalfedgeId h{i};
    if (!state.mesh.is_alive(h)) continue;
    sum[state.mesh.from(h)] += load[state.mesh.to(h)];
    ++count[state.mesh.from(h)];
  }
  for (const VertexId v : sum.ids()) sum[v] /= count[v];
  return sum;
}

/// Marks vertices near an edit so that the rest of the pass leaves them alone.
class Locks {
 public:
  explicit Locks(const RemeshState& state)
      : mesh_(state.mesh), locked_(mesh_.num_vertex_slots(), 0) {}
  [[nodiscard]] bool is_locked(HalfedgeId h) const {
    return is_locked(mesh_.from(h)) || is_locked(mesh_.to(h)) || is_locked(mesh_.opposite(h)) ||
           is_locked(mesh_.opposite(mesh_.twin(h)));
  }
  void lock(VertexId v) {
    if (v.value < locked_.size()) locked_[v] = 1;
  }
  void lock_faces(HalfedgeId h) {
    lock(mesh_.from(h));
    lock(mesh_.to(h));
    lock(mesh_.opposite(h));
    lock(mesh_.opposite(mesh_.twin(h)));
  }
  void lock_ring(VertexId v) {
    lock(v);
    mesh_.for_each_out(v, [&](HalfedgeId h) { lock(mesh_.to(h)); });
  }

 private:
  [[nodiscard]] bool is_locked(VertexId v) const {
    return v.value >= locked_.size() || locked_[v] != 0;
  }
  const EditMesh& mesh_;
  VertexField<char> locked_;
};

void split_edge(RemeshState& state, HalfedgeId h) {
  const RemeshVertex middle = halfway(state.reference, state.vertices[state.mesh.from(h)],
                                      state.vertices[state.mesh.to(h)]);
  state.mesh.split(h);
  state.vertices.add(middle);
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
      if (p != other && q != other && !is_upright(merged, state.vertices[p], state.vertices[q]))
        is_sound = false;
    });
  };
  check_fan(a, b);
  check_fan(b, a);
  if (!is_sound) return false;
  state.mesh.collapse(h);
  state.vertices[b] = merged;
  return true;
}

/// Sum of the two angles that face an edge less π [radians], if it is more than `least` ≥ −π/2;
/// else some value below that. Most edges are far from flipping: they cost no angle.
double opposite_angle_excess(const RemeshState& state, HalfedgeId h, double least) {
  const Vec3 &a = state.vertices[state.mesh.from(h)].x, &b = state.vertices[state.mesh.to(h)].x;
  const auto cosine_and_sine = [&](const Vec3& apex) {
    const Vec3 p = a - apex, q = b - apex;
    return std::pair(p.dot(q), p.cross(q).norm());
  };
  const auto [c1, s1] = cosine_and_sine(state.vertices[state.mesh.opposite(h)].x);
  const auto [c2, s2] = cosine_and_sine(state.vertices[state.mesh.opposite(state.mesh.twin(h))].x);
  // Cosine and sine of the sum, both times the same length.
  const double cosine = c1 * c2 - s1 * s2, sine = s1 * c2 + c1 * s2;
  // The sum is below π where the sine is positive, and below π/2 where the cosine is too.
  const double tangent = std::tan(least);  // of −least from π
  if (sine > 0.0 && (cosine >= 0.0 || sine > cosine * tangent)) return -std::numbers::pi;
  return -std::atan2(sine, -cosine);
}

bool try_flip(RemeshState& state, HalfedgeId h) {
  const EditMesh& mesh = state.mesh;
  const VertexId a = mesh.from(h), b = mesh.to(h), c = mesh.opposite(h),
                 d = mesh.opposite(mesh.twin(h));
  constexpr double kLeast = kDelaunaySlack - kLargestAllowance;
  const double excess = opposite_angle_excess(state, h, kLeast);
  if (excess < kLeast) return false;
  const std::int32_t valence_a = mesh.valence(a), valence_b = mesh.valence(b);
  if (valence_a <= 4 || valence_b <= 4) return false;
  // Growth of Σ(valence − 6)² by the flip.
  const std::int32_t growth = 2 * (mesh.valence(c) + mesh.valence(d) - valence_a - valence_b) + 4;
  const double threshold = std::clamp(kAllowance * growth, -kLargestAllowance, kLargestAllowance);
  if (excess < threshold + kDelaunaySlack || mesh.are_joined(c, d)) return false;
  const VertexField<RemeshVertex>& v = state.vertices;
  if (!is_upright(v[d], v[c], v[a]) || !is_upright(v[c], v[d], v[b])) return false;
  state.mesh.flip(h);
  return true;
}

/// Edges wanted for splitting (score > 0, largest first) or collapsing (score < 0).
struct Candidates {
  std::vector<EdgeScore> splits, collapses;
};

/// How far the neighbourhood is from its density, in units of one vertex per vertex, and among its
/// edges the longest and the shortest first.
Candidates density_candidates(const RemeshState& state, const VertexField<double>& mean_load,
                              double band) {
  Candidates result;
  for (std::int32_t i = 0; i < state.mesh.num_halfedge_slots(); ++i) {
    const HalfedgeId h{i};
    if (!state.mesh.is_representative(h)) continue;
    const double ratio = state.edge_vector(h).norm() / state.rest_length(h);
    const double load =
        0.5 * (mean_load[state.mesh.from(h)] + mean_load[state.mesh.to(h)]) * ratio * ratio;
    const double mean = 0.5 * (mean_load[state.mesh.from(h)] + mean_load[state.mesh.to(h)]);
    if ((mean > 1.0 + band && ratio > 1.0) || ratio > kLongestEdge)
      result.splits.push_back({load, h});
    else if ((mean < 1.0 - band && ratio < 1.0) || ratio < kShortestEdge)
      result.collapses.push_back({load, h});
  }
  const auto order = [](const EdgeScore& p, const EdgeScore& q) {
    return std::tuple(p.score, p.h.value) < std::tuple(q.score, q.h.value);
  };
  std::ranges::sort(result.splits, [&](const auto& p, const auto& q) { return order(q, p); });
  std::ranges::sort(result.collapses, order);
  return result;
}

/// Takes candidates in order of need, at most `max_splits` and `max_collapses`.
DensityEdits edit(RemeshState& state, const Candidates& candidates,
                  const VertexField<double>& mean_load, int max_splits, int max_collapses) {
  DensityEdits edits;
  Locks locks(state);
  for (const auto& [score, h] : candidates.splits) {
    if (edits.splits == max_splits) break;
    if (locks.is_locked(h)) continue;
    const bool is_far = mean_load[state.mesh.from(h)] > 1.0 + kLocalBandFar;
    locks.lock_faces(h);
    if (!is_far)
      for (const VertexId v : {state.mesh.from(h), state.mesh.to(h)}) locks.lock_ring(v);
    split_edge(state, h);
    ++edits.splits;
  }
  for (const auto& [score, h] : candidates.collapses) {
    if (edits.collapses == max_collapses) break;
    if (!state.mesh.is_alive(h) || locks.is_locked(h)) continue;
    const VertexId kept = state.mesh.to(h), c = state.mesh.opposite(h),
                   d = state.mesh.opposite(state.mesh.twin(h));
    const bool is_far = mean_load[kept] < 1.0 - kLocalBandFar;
    if (!try_collapse_edge(state, h)) continue;
    if (is_far)
      for (const VertexId v : {kept, c, d}) locks.lock(v);
    else
      locks.lock_ring(kept);
    ++edits.collapses;
  }
  return edits;
}

}  // namespace

int flip_to_delaunay(RemeshState& state) {
  const EditMesh& mesh = state.mesh;
  int flips = 0;
  // The round in which an edge between the faces of a vertex was last flipped. Whether an edge
  // flips depends on its four corners alone: after the first round, only those near flips may.
  VertexField<int> last_flip(mesh.num_vertex_slots(), 0);
  for (int round = 1; round <= kMaxFlipRounds; ++round) {
    int flipped = 0;
    for (std::int32_t i = 0; i < mesh.num_halfedge_slots(); ++i) {
      const HalfedgeId h{i};
      if (!mesh.is_representative(h)) continue;
      const std::array<VertexId, 4> corners{mesh.from(h), mesh.to(h), mesh.opposite(h),
                                            mesh.opposite(mesh.twin(h))};
      const auto is_near = [&](VertexId v) { return last_flip[v] >= round - 1; };
      if (!std::ranges::any_of(corners, is_near) || !try_flip(state, h)) continue;
      for (const VertexId v : corners) last_flip[v] = round;
      ++flipped;
    }
    flips += flipped;
    if (flipped == 0) break;
  }
  return flips;
}

DensityEdits balance_density(RemeshState& state) {
  const VertexField<double> load = vertex_loads(state);
  const VertexField<double> mean_load = ring_averaged(state, ring_averaged(state, load));
  const int unlimited = state.mesh.num_vertices();
  const DensityEdits local = edit(state, density_candidates(state, mean_load, kLocalBand),
                                  mean_load, unlimited, unlimited);
  if (local.splits + local.collapses > 0) return local;

  const double expected = std::accumulate(load.begin(), load.end(), 0.0);
  const double missing = expected - state.mesh.num_vertices();
  const int count = static_cast<int>(std::lround(std::abs(missing)));
  if (count <= 1 || count <= kGlobalBand * expected) return {};
  // A negative band makes every edge longer (or shorter) than its rest length a candidate.
  const Candidates candidates = density_candidates(state, mean_load, -1.0);
  if (missing > 0.0) return edit(state, {candidates.splits, {}}, mean_load, count, 0);
  return edit(state, {{}, candidates.collapses}, mean_load, 0, count);
}

double expected_vertices(const RemeshState& state) {
  const VertexField<double> load = vertex_loads(state);
  return std::accumulate(load.begin(), load.end(), 0.0);
}

}  // namespace meniscus
