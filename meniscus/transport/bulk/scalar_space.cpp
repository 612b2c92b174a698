#include "meniscus/transport/bulk/scalar_space.hpp"

#include <algorithm>
#include <numeric>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/curved_maps.hpp"
#include "meniscus/flow/fem/elements.hpp"

namespace meniscus::bulk {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

}  // namespace

ScalarSpace scalar_space(const FlowDomain& domain, std::shared_ptr<const fem::FlowSpace> of_flow) {
  const TetMesh& mesh = *domain.mesh;
  ScalarSpace space{.of_flow = std::move(of_flow), .interfaces = {}, .boundary = {}};
  for (std::size_t i = 0; i < mesh.interfaces.size(); ++i)
    space.interfaces.push_back(
        fem::face_nodes(space.elements, mesh, domain.scene.interfaces[i].mesh, mesh.interfaces[i]));
  space.boundary = fem::face_nodes(space.elements, mesh, domain.scene.boundary.mesh, mesh.boundary);
  return space;
}

std::size_t place_of(const fem::NodeGraph& graph, NodeId row, NodeId column) {
  const auto begin = graph.columns.begin() + graph.row_start[at(row.value)],
             end = graph.columns.begin() + graph.row_start[at(row.value) + 1];
  const auto found = std::lower_bound(begin, end, column.value);
  MENISCUS_ASSERT(found != end && *found == column.value, "no entry {}, {}", row.value,
                  column.value);
  return static_cast<std::size_t>(found - graph.columns.begin());
}

NodePositions halfway(const NodePositions& from, const NodePositions& to) {
  NodePositions middle = from;
  for (const NodeId i : middle.x.ids()) middle.x[i] = 0.5 * (from.x[i] + to.x[i]);
  for (const CellId c : from.is_curved.ids())
    middle.is_curved[c] = static_cast<char>(from.is_curved[c] != 0 || to.is_curved[c] != 0);
  return middle;
}

std::vector<double> element_volumes(const TetMesh& mesh, const ScalarSpace& space,
                                    const NodePositions& positions) {
  const fem::MapsOfCurvedCells maps(space.elements, positions);
  std::vector<double> volumes(mesh.interfaces.size() + 1, 0.0);
  for (const CellId c : mesh.cells.ids()) {
    const auto nodes = space.elements.velocity.of(c);
    double volume = 0.0;
    if (positions.is_curved[c] != 0) {
      for (const fem::CurvedMap& map : maps.of(c)) volume += map.weight;
    } else {
      volume = linear_tetrahedron({positions.x[NodeId{nodes[0]}], positions.x[NodeId{nodes[1]}],
                                   positions.x[NodeId{nodes[2]}], positions.x[NodeId{nodes[3]}]})
                   .volume;
    }
    volumes[static_cast<std::size_t>(mesh.region[c].value)] += volume;
  }
  return volumes;
}

std::vector<double> nominal_volumes(const Scene& scene, double total) {
  std::vector<double> volumes(scene.interfaces.size() + 1, 0.0);
  volumes[0] = total;
  for (const Interface& interface : scene.interfaces) {
    volumes[static_cast<std::size_t>(interface.inside.value)] += interface.volume;
    volumes[static_cast<std::size_t>(interface.outside.value)] -= interface.volume;
  }
  return volumes;
}

std::vector<double> volume_shares(const Scene& scene, std::span<const double> filled) {
  std::vector<double> shares =
      nominal_volumes(scene, std::accumulate(filled.begin(), filled.end(), 0.0));
  for (std::size_t r = 0; r < shares.size(); ++r)
    shares[r] = shares[r] > 0.0 && filled[r] > 0.0 ? shares[r] / filled[r] : 1.0;
  return shares;
}

GivenValues given_values(const Scene& scene, std::size_t scalar, const ScalarSpace& space,
                         const NodePositions& positions) {
  const auto count = static_cast<std::size_t>(space.num_nodes());
  GivenValues given{std::vector<char>(count, 0), std::vector<double>(count, 0.0)};
  const OuterBoundary& boundary = scene.boundary;
  for (const PatchId patch : boundary.patches.ids()) {
    const ScalarCondition& condition = boundary.patches[patch].scalars[scalar];
    if (condition.kind != ScalarCondition::Kind::value) continue;
    given.any = true;
    for (const FaceId f : space.boundary.faces()) {
      if (boundary.patch[f] != patch) continue;
      for (const NodeId i : space.boundary.of(f)) {
        const auto at = static_cast<std::size_t>(i.value);
        if (given.is_given[at] != 0) continue;
        given.is_given[at] = 1;
        given.value[at] = condition.value + condition.gradient.dot(positions.x[i]);
      }
    }
  }
  return given;
}

}  // namespace meniscus::bulk
