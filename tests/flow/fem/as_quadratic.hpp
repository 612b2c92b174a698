#pragma once

#include "meniscus/flow/fem/stokes_problem.hpp"

namespace meniscus::fem {

/// The points of the curved rule for every cell of either space: enough for the errors of both.
inline NodePositions all_curved(NodePositions positions) {
  for (char& is_curved : positions.is_curved) is_curved = true;
  return positions;
}

/// P1 as P2 on the same cells, so that its errors are measured by the same rule.
struct AsQuadratic {
  FlowSpace space;
  StokesProblem problem;
  StokesState state;

  AsQuadratic(const StokesProblem& given, const StokesState& solution)
      : space(flow_space(given.mesh, Elements::p2_p1)),
        problem(given.mesh, space, straight_positions(given.mesh, space)),
        state(state_at_rest(space)) {
    for (const TetVertexId v : given.mesh.x.ids()) state.v[node_at(v)] = solution.v[node_at(v)];
    for (std::size_t e = 0; e < space.edges.size(); ++e)
      state.v[NodeId{given.mesh.num_vertices() + static_cast<std::int32_t>(e)}] =
          0.5 * (solution.v[node_at(space.edges[e][0])] + solution.v[node_at(space.edges[e][1])]);
    state.p = solution.p;
  }
};

}  // namespace meniscus::fem
