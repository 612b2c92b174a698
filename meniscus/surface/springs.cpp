#include "meniscus/surface/springs.hpp"

#include <algorithm>
#include <cmath>

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

/// Puts the corners of folded faces back where they were; faces that were folded before stay.
void take_back_folds(RemeshState& state, const VertexField<RemeshVertex>& before) {
  const EditMesh& mesh = state.mesh;
  for (int round = 0; round < kMaxUnfoldings; ++round) {
    bool found = false;
    for (std::int32_t i = 0; i < mesh.num_halfedge_slots(); i += 3) {
      const HalfedgeId h{i};
      if (!mesh.is_alive(h) || !is_folded(state, h)) continue;
      found = true;
      for (const VertexId v : {mesh.from(h), mesh.to(h), mesh.opposite(h)})
        state.vertices[v] = before[v];
    }
    if (!found) return;
  }
}

}  // namespace

int relax_springs(RemeshState& state, double equilibrium, int max_steps) {
  for (int step = 0; step < max_steps; ++step) {
    const VertexField<Vec3> moves = spring_moves(state);
    if (largest_relative_move(state, moves) <= equilibrium) return step;
    const VertexField<RemeshVertex> before = state.vertices;
    for (const VertexId v : moves.ids()) {
      if (!state.mesh.is_alive(v)) continue;
      RemeshVertex& vertex = state.vertices[v];
      vertex = vertex_at(state.reference, state.reference.walk.moved(vertex.place, moves[v]));
    }
    take_back_folds(state, before);
  }
  return max_steps;
}

}  // namespace meniscus
