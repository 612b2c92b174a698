#include "meniscus/surface/springs.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace meniscus {
namespace {

/// Springs are cut a little short. All are then stretched alike where the density is right, a
/// uniform tension that no density gradient disturbs, and that gives the net the stiffness against
/// shear and folding that springs at their rest length lack.
constexpr double kShortening = 0.85;
/// Step of the explicit method over the valence. The stiffest mode of a net of valence 6 has the
/// eigenvalue 6 to 9 (springs at rest, springs without length), so that 1.5/6 is stable.
constexpr double kStepTimesValence = 1.5;
/// What is left of a step in the next (heavy ball). Long waves, of which plain steps take away a
/// thousandth each, come to rest two and a half times sooner. (With 0.8 and more the short ones
/// swing so far that faces fold.)
constexpr double kMomentum = 0.6;
constexpr double kLongestMove = 0.25;  // of l0 in one step: no vertex can cross its ring
constexpr int kMaxUnfoldings = 4;
/// Of the move that counts as rest: vertices that would move less stay, and cost nothing until a
/// neighbour moves.
constexpr double kStill = 0.5;

struct Move {
  VertexId v;
  Vec3 d;
  double over_length;  // |d|/l0
  double pull;         // what of it the springs ask for now, over l0
};

/// The next move of a vertex, tangential, after one by `previous`.
Move spring_move(const RemeshState& state, VertexId v, const Vec3& previous) {
  const RemeshVertex& vertex = state.vertices[v];
  Vec3 pull = Vec3::Zero();
  state.mesh.for_each_out(v, [&](HalfedgeId h) {
    const RemeshVertex& other = state.vertices[state.mesh.to(h)];
    const Vec3 d = other.x - vertex.x;
    const double rest_length = 0.5 * (vertex.rest_length + other.rest_length);
    pull += (1.0 - kShortening * rest_length / d.norm()) * d;
  });
  pull *= kStepTimesValence / state.mesh.valence(v);
  const Vec3 d = pull + kMomentum * previous;
  Move move{v, d - d.dot(vertex.n) * vertex.n, 0.0,
            (pull - pull.dot(vertex.n) * vertex.n).norm() / vertex.rest_length};
  move.over_length = move.d.norm() / vertex.rest_length;
  if (move.over_length > kLongestMove) {
    move.d *= kLongestMove / move.over_length;
    move.over_length = kLongestMove;
  }
  return move;
}

/// The moves of more than `least` l0. Springs that nothing has pulled since they came to rest are
/// at rest still.
std::vector<Move> spring_moves(RemeshState& state, const VertexField<Vec3>& previous,
                               double least) {
  VertexSet pulled;
  for (const VertexId v : state.unrelaxed.take()) {
    if (!state.mesh.is_alive(v)) continue;
    pulled.insert(v);
    state.mesh.for_each_out(v, [&](HalfedgeId h) { pulled.insert(state.mesh.to(h)); });
  }
  std::vector<Move> moves;
  for (const VertexId v : pulled.take())
    if (const Move move = spring_move(state, v, previous[v]);
        std::max(move.over_length, move.pull) > least)
      moves.push_back(move);
  return moves;
}

bool is_folded(const RemeshState& state, HalfedgeId h) {
  const EditMesh& mesh = state.mesh;
  return !is_upright(state.vertices[mesh.from(h)], state.vertices[mesh.to(h)],
                     state.vertices[mesh.opposite(h)]);
}

/// One step of the springs: what it has moved, and from where.
class Step {
 public:
  explicit Step(RemeshState& state) : state_(state), saved_(state.mesh.num_vertex_slots(), -1) {}

  void move(const Move& move) {
    RemeshVertex& vertex = state_.vertices[move.v];
    saved_[move.v] = static_cast<std::int32_t>(before_.size());
    moved_.push_back(move.v);
    before_.push_back(vertex);
    vertex = vertex_at(state_.reference, state_.reference.walk.moved(vertex.place, move.d));
    state_.touch(move.v);
  }

  /// Puts the corners of folded faces back where they were; faces that were folded before stay.
  void take_back_folds(VertexField<Vec3>& moves) {
    for (int round = 0; round < kMaxUnfoldings; ++round) {
      bool found = false;
      for (const VertexId v : moved_)
        state_.mesh.for_each_out(v, [&](HalfedgeId h) {
          if (is_first_mover(v, h) && is_folded(state_, h)) {
            take_back(h, moves);
            found = true;
          }
        });
      if (!found) return;
    }
  }

 private:
  [[nodiscard]] bool has_moved(VertexId v) const { return saved_[v] >= 0; }
  /// Of the corners of the face of h that have moved, v is the one that did first.
  [[nodiscard]] bool is_first_mover(VertexId v, HalfedgeId h) const {
    for (const VertexId w : {state_.mesh.to(h), state_.mesh.opposite(h)})
      if (has_moved(w) && saved_[w] < saved_[v]) return false;
    return true;
  }
  void take_back(HalfedgeId h, VertexField<Vec3>& moves) {
    const EditMesh& mesh = state_.mesh;
    for (const VertexId v : {mesh.from(h), mesh.to(h), mesh.opposite(h)})
      if (has_moved(v)) {
        state_.vertices[v] = before_[static_cast<std::size_t>(saved_[v])];
        moves[v] = Vec3::Zero();
      }
  }

  RemeshState& state_;
  VertexField<std::int32_t> saved_;  // place in before_, or -1
  std::vector<VertexId> moved_;
  std::vector<RemeshVertex> before_;
};

}  // namespace

int relax_springs(RemeshState& state, double equilibrium, int max_steps) {
  VertexField<Vec3> previous(state.mesh.num_vertex_slots(), Vec3::Zero());
  for (int number = 0; number < max_steps; ++number) {
    const std::vector<Move> moves = spring_moves(state, previous, kStill * equilibrium);
    const bool at_rest = std::ranges::none_of(moves, [&](const Move& move) {
      return std::max(move.over_length, move.pull) > equilibrium;
    });
    if (at_rest) return number;
    Step step(state);
    std::ranges::fill(previous, Vec3::Zero());
    for (const Move& move : moves) {
      step.move(move);
      previous[move.v] = move.d;
    }
    step.take_back_folds(previous);
  }
  return max_steps;
}

}  // namespace meniscus
