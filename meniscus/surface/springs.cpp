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
constexpr double kLongestMove = 0.25;  // of l0 in one step: no vertex can cross its ring
constexpr int kMaxUnfoldings = 4;
/// Of the move that counts as rest: vertices that would move less stay, and cost nothing. Most do
/// while the neighbourhoods of a few edits settle.
constexpr double kStill = 0.3;

/// The next move of each vertex, tangential.
VertexField<Vec3> spring_moves(const RemeshState& state) {
  const EditMesh& mesh = state.mesh;
  VertexField<Vec3> moves(mesh.num_vertex_slots(), Vec3::Zero());
  VertexField<int> valence(mesh.num_vertex_slots(), 0);
  for (std::int32_t i = 0; i < mesh.num_halfedge_slots(); ++i) {
    const HalfedgeId h{i};
    if (!mesh.is_representative(h)) continue;
    const Vec3 d = state.edge_vector(h);
    const Vec3 pull = (1.0 - kShortening * state.rest_length(h) / d.norm()) * d;
    const VertexId a = mesh.from(h), b = mesh.to(h);
    moves[a] += pull;
    moves[b] -= pull;
    ++valence[a];
    ++valence[b];
  }
  for (const VertexId v : moves.ids()) {
    if (!mesh.is_alive(v)) continue;
    const RemeshVertex& vertex = state.vertices[v];
    Vec3& move = moves[v];
    move = kStepTimesValence / valence[v] * (move - move.dot(vertex.n) * vertex.n);
    const double longest = kLongestMove * vertex.rest_length, length = move.norm();
    if (length > longest) move *= longest / length;
  }
  return moves;
}

double largest_relative_move(const RemeshState& state, const VertexField<Vec3>& moves) {
  double largest = 0.0;
  for (const VertexId v : moves.ids())
    if (state.mesh.is_alive(v))
      largest = std::max(largest, moves[v].norm() / state.vertices[v].rest_length);
  return largest;
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

  void move(VertexId v, const Vec3& d) {
    RemeshVertex& vertex = state_.vertices[v];
    saved_[v] = static_cast<std::int32_t>(before_.size());
    before_.push_back(vertex);
    vertex = vertex_at(state_.reference, state_.reference.walk.moved(vertex.place, d));
  }

  /// Puts the corners of folded faces back where they were; faces that were folded before stay.
  void take_back_folds() {
    const EditMesh& mesh = state_.mesh;
    for (int round = 0; round < kMaxUnfoldings; ++round) {
      bool found = false;
      for (std::int32_t i = 0; i < mesh.num_halfedge_slots(); i += 3) {
        const HalfedgeId h{i};
        if (!mesh.is_alive(h) || !has_moved(h) || !is_folded(state_, h)) continue;
        found = true;
        for (const VertexId v : {mesh.from(h), mesh.to(h), mesh.opposite(h)})
          if (has_moved(v)) state_.vertices[v] = before_[static_cast<std::size_t>(saved_[v])];
      }
      if (!found) return;
    }
  }

 private:
  [[nodiscard]] bool has_moved(VertexId v) const { return saved_[v] >= 0; }
  /// Whether a corner of the face of h has.
  [[nodiscard]] bool has_moved(HalfedgeId h) const {
    const EditMesh& mesh = state_.mesh;
    return has_moved(mesh.from(h)) || has_moved(mesh.to(h)) || has_moved(mesh.opposite(h));
  }

  RemeshState& state_;
  VertexField<std::int32_t> saved_;  // place in before_, or -1
  std::vector<RemeshVertex> before_;
};

}  // namespace

int relax_springs(RemeshState& state, double equilibrium, int max_steps) {
  for (int number = 0; number < max_steps; ++number) {
    const VertexField<Vec3> moves = spring_moves(state);
    if (largest_relative_move(state, moves) <= equilibrium) return number;
    Step step(state);
    for (const VertexId v : moves.ids())
      if (state.mesh.is_alive(v) &&
          moves[v].norm() > kStill * equilibrium * state.vertices[v].rest_length)
        step.move(v, moves[v]);
    step.take_back_folds();
  }
  return max_steps;
}

}  // namespace meniscus
