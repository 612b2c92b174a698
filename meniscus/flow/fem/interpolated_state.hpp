#pragma once

#include <span>
#include <vector>

#include "meniscus/flow/fem/node_sources.hpp"
#include "meniscus/flow/fem/stokes_problem.hpp"
#include "meniscus/volume/field_transfer.hpp"

namespace meniscus::fem {

/// A space and the mesh that it is on.
struct MeshedSpace {
  const TetMesh& mesh;
  const FlowSpace& space;
};

/// Velocities and pressures on another mesh of the same liquids. A node takes the value of the old
/// shape functions where a walk to it ends. The walk stays in old cells of the node's liquid. It
/// ends at the node, or where that liquid ended. `sources` says where a region has its liquid from;
/// where it says nothing of one, any cell will do. Mid-edge nodes count as the middles of straight
/// edges, on both meshes: second order at curved surfaces, third elsewhere. Linear cost. Where
/// `places` is not empty it says where the nodes of the velocity lie, on curved edges too. Else
/// nodes of other cells than those given stay at rest; pressures of other cells are zero always.
[[nodiscard]] std::vector<StokesState> interpolated_states(std::span<const StokesState> states,
                                                           const MeshedSpace& from,
                                                           const MeshedSpace& to,
                                                           const RegionSources& sources,
                                                           std::span<const NodeSource> places,
                                                           std::span<const CellId> cells);

}  // namespace meniscus::fem
