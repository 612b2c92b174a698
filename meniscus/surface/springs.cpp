#include "meniscus/surface/springs.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace meniscus {
namespace {

/// Springs are cut short. All are then stretched alike where the density is right, a uniform
/// tension that no density gradient disturbs. It gives the net the stiffness against shear and
/// folding that springs at their rest length lack. The shorter, the better the angles around
/// vertices of valence 5 and 7, and the less the springs hold their lengths.
constexpr double kShortening = 0.8;
/// A vertex moves by this multiple of the move that would bring it to rest: long waves settle in
/// fewer rounds.
constexpr double kOverRelaxation = 1.2;
constexpr double kLongestMove = 0.25;  // of l0 at a time: no vertex can cross its ring
/// Least stiffness of a spring on average; compressed ones push a vertex aside and have little.
constexpr double kLeastStiffness = 0.3;
constexpr int kMostAttempts = 3;  // the whole move, its half and its quarter

/// The vertices whose springs something has pulled since they were last looked at.
class PulledVertices {
 public:
  PulledVertices(const EditMesh& mesh, const std::vector<VertexId>& changed)
      : mesh_(mesh), is_pulled_(mesh.num_vertex_slots(), 0) {
    for (const VertexId v : changed)
      if (mesh.is_alive(v)) insert_ring(v);
  }
  /// v and its neighbours.
  void insert_ring(VertexId v) {
    insert(v);
    mesh_.for_each_out(v, [&](HalfedgeId h) { insert(mesh_.to(h)); });
  }
  /// The vertices of one round. Each is to be released when it is looked at. One that is inserted
  /// meanwhile and still to come in this round does not come again in the next.
  [[nodiscard]] std::vector<VertexId> next_round() { return std::exchange(members_, {}); }
  void release(VertexId v) { is_pulled_[v] = 0; }

 private:
  void insert(VertexId v) {
    if (is_pulled_[v] != 0) return;
    is_pulled_[v] = 1;
    members_.push_back(v);
  }
  const EditMesh& mesh_;
  VertexField<char> is_pulled_;
  std::vector<VertexId> members_;
};

/// The tangential move by which the springs of a vertex would come to rest if its neighbours
/// stayed. It is their pull over their stiffness, the mean of that along and across each.
Vec3 move_to_rest(const RemeshState& state, VertexId v) {
  const RemeshVertex& vertex = state.vertices[v];
  Vec3 pull = Vec3::Zero();
  double stiffness = 0.0;
  state.mesh.for_each_out(v, [&](HalfedgeId h) {
    const RemeshVertex& other = state.vertices[state.mesh.to(h)];
    const Vec3 d = other.x - vertex.x;
    const double length = 0.5 * kShortening * (vertex.rest_length + other.rest_length);
    const double distance = d.norm();
    if (distance == 0.0) return;  // two in one place: the springs of the others part them
    const double compression = length / distance;
    pull += (1.0 - compression) * d;
    stiffness += 1.0 - 0.5 * compression;
  });
  pull /= std::max(stiffness, kLeastStiffness * state.mesh.valence(v));
  return pull - pull.dot(vertex.n) * vertex.n;
}

/// Whether a face that is upright now would not be with v at `moved`.
bool would_fold(const RemeshState& state, VertexId v, const RemeshVertex& moved) {
  bool folds = false;
  state.mesh.for_each_out(v, [&](HalfedgeId h) {
    const RemeshVertex &a = state.vertices[state.mesh.to(h)],
                       &b = state.vertices[state.mesh.opposite(h)];
    if (!folds && !is_consistently_oriented(moved, a, b) &&
        is_consistently_oriented(state.vertices[v], a, b))
      folds = true;
  });
  return folds;
}

/// Moves v by d, or by less where that would fold a face.
bool try_move(RemeshState& state, VertexId v, Vec3 d) {
  RemeshVertex& vertex = state.vertices[v];
  for (int attempt = 0; attempt < kMostAttempts; ++attempt, d *= 0.5) {
    const RemeshVertex moved =
        vertex_at(state.reference, state.reference.walk.destination(vertex.point, d));
    if (would_fold(state, v, moved)) continue;
    vertex = moved;
    return true;
  }
  return false;
}

}  // namespace

void relax_springs(RemeshState& state, double spring_tolerance, int max_rounds) {
  PulledVertices pulled(state.mesh, state.unrelaxed.take());
  for (int round = 0; round < max_rounds; ++round) {
    const std::vector<VertexId> vertices = pulled.next_round();
    if (vertices.empty()) return;
    for (const VertexId v : vertices) {
      pulled.release(v);
      const Vec3 d = move_to_rest(state, v);
      const double over_length = d.norm() / state.vertices[v].rest_length;
      if (over_length <= spring_tolerance) continue;
      if (!try_move(state, v, std::min(kOverRelaxation, kLongestMove / over_length) * d)) continue;
      state.unflipped.insert(v);
      pulled.insert_ring(v);
    }
  }
  for (const VertexId v : pulled.next_round()) state.unrelaxed.insert(v);
}

}  // namespace meniscus
