#include "meniscus/flow/fem/interpolated_state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/fem/elements.hpp"
#include "meniscus/volume/cell_tree.hpp"
#include "meniscus/volume/cell_walk.hpp"

namespace meniscus::fem {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

using Barycentric = std::array<double, 4>;

Vec3 velocity_at(const StokesState& state, std::span<const std::int32_t> nodes,
                 const Barycentric& b) {
  const auto sum = [&](std::span<const double> value) {
    Vec3 total = Vec3::Zero();
    for (std::size_t k = 0; k < value.size(); ++k) total += value[k] * state.v[NodeId{nodes[k]}];
    return total;
  };
  return nodes.size() == 10 ? sum(quadratic_tetrahedron_values(b)) : sum(b);
}

double pressure_at(const StokesState& state, std::span<const std::int32_t> nodes,
                   const Barycentric& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < 4; ++k) sum += b[k] * state.p[at(nodes[k])];
  return sum;
}

std::int32_t num_regions(const TetMesh& mesh) {
  return std::ranges::max_element(mesh.region)->value + 1;
}

/// Where the nodes of one region of the new mesh look for their values.
struct Source {
  std::vector<bool> is_allowed;  ///< by old region
  CellId near;                   ///< a cell to start from
};

Field<RegionId, Source> sources_of_regions(const TetMesh& before, const TetMesh& after,
                                           const RegionSources& sources) {
  MENISCUS_ASSERT(sources.empty() || num_regions(after) <= sources.size(), "{} regions, {} sources",
                  num_regions(after), sources.size());
  Field<RegionId, Source> result;
  for (const RegionId region : ids<RegionId>(num_regions(after))) {
    std::vector<RegionId> known = {region};
    if (!sources.empty()) known = sources[region];
    std::vector<bool> is_allowed(at(num_regions(before)), false);
    for (const RegionId old : known)
      if (old.value < num_regions(before)) is_allowed[at(old.value)] = true;
    if (std::ranges::find(is_allowed, true) == is_allowed.end())
      is_allowed.assign(is_allowed.size(), true);
    result.add({std::move(is_allowed), {}});
  }
  return result;
}

using CellsByRegion = Field<RegionId, std::vector<CellId>>;

CellsByRegion cells_by_region(const TetMesh& mesh) {
  CellsByRegion cells(num_regions(mesh));
  for (const CellId c : mesh.cells.ids()) cells[mesh.region[c]].push_back(c);
  return cells;
}

/// The cell with the centroid nearest to a point, among those allowed.
CellId nearest_cell(const TetMesh& mesh, const CellsByRegion& cells,
                    const std::vector<bool>& is_allowed, const Vec3& p) {
  CellId nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const RegionId region : cells.ids()) {
    if (!is_allowed[at(region.value)]) continue;
    for (const CellId c : cells[region]) {
      const TetCorners x = corners(mesh, c);
      const double squared = (0.25 * (x[0] + x[1] + x[2] + x[3]) - p).squaredNorm();
      if (squared >= least) continue;
      least = squared;
      nearest = c;
    }
  }
  MENISCUS_ASSERT(nearest.is_valid(), "no cell is allowed");
  return nearest;
}

/// The cell at p, from one nearby. Where a drop is in its way the walk ends away from the point,
/// and begins again at the cell nearest to it.
CellWalk::Hit find_cell(const CellWalk& walk, const TetMesh& mesh, const CellsByRegion& cells,
                        const std::vector<bool>& is_allowed, CellId near, const Vec3& p) {
  constexpr double kMostBeyond = 0.3;  // of an edge: interfaces move by less when remeshed
  const CellWalk::Hit hit = walk.find(near, p, is_allowed);
  const TetCorners x = corners(mesh, hit.cell);
  if (hit.squared_distance <= kMostBeyond * kMostBeyond * (x[1] - x[0]).squaredNorm()) return hit;
  const CellWalk::Hit again = walk.find(nearest_cell(mesh, cells, is_allowed, p), p, is_allowed);
  return again.squared_distance < hit.squared_distance ? again : hit;
}

Vec3 node_position(const TetMesh& mesh, CellId c, std::size_t k) {
  const CellVertices& corners = mesh.cells[c];
  if (k < 4) return mesh.x[corners[k]];
  return 0.5 * (mesh.x[corners[kCellEdges[k - 4][0]]] + mesh.x[corners[kCellEdges[k - 4][1]]]);
}

}  // namespace

std::vector<StokesState> interpolated_states(std::span<const StokesState> states,
                                             const MeshedSpace& from, const MeshedSpace& to,
                                             const RegionSources& sources,
                                             std::span<const NodeSource> places,
                                             std::span<const CellId> cells) {
  MENISCUS_ASSERT(from.space.elements == to.space.elements, "other elements");
  const CellWalk walk(from.mesh);
  const CellsByRegion old_cells = cells_by_region(from.mesh);
  Field<RegionId, Source> source = sources_of_regions(from.mesh, to.mesh, sources);
  std::vector<StokesState> results(states.size(), state_at_rest(to.space));
  for (std::size_t n = 0; n < states.size(); ++n) {
    MENISCUS_ASSERT(states[n].v.size() == from.space.velocity.num_nodes, "{} {}",
                    states[n].v.size(), from.space.velocity.num_nodes);
    if (!places.empty())
      results[n].v =
          Field<NodeId, Vec3>(interpolated_values<Vec3>(states[n].v.span(), from.space, places));
  }
  std::vector<CellId> hit_cells(
      at(to.space.pressure.nodes.num_nodes));  // where pressures were found
  // A vertex on an interface is looked for in the liquids on both sides: the nearer point counts.
  Field<NodeId, double> distance(to.space.velocity.num_nodes,
                                 std::numeric_limits<double>::infinity());
  for (const CellId c : cells) {
    const auto nodes = to.space.velocity.of(c), pressures = to.space.pressure.nodes.of(c);
    auto& [is_allowed, near] = source[to.mesh.region[c]];
    for (std::size_t k = 0; k < 4; ++k)
      if (hit_cells[at(pressures[k])].is_valid()) near = hit_cells[at(pressures[k])];
    if (!near.is_valid())
      near = nearest_cell(from.mesh, old_cells, is_allowed, node_position(to.mesh, c, 0));
    for (std::size_t k = 0; k < (places.empty() ? nodes.size() : 4); ++k) {
      const NodeId i{nodes[k]};
      const bool is_known = k < 4 ? hit_cells[at(pressures[k])].is_valid() : distance[i] < HUGE_VAL;
      if (is_known) continue;
      if (!places.empty())
        if (const CellId known = places[at(i.value)].cell;
            is_allowed[at(from.mesh.region[known].value)])
          near = known;
      const CellWalk::Hit hit =
          find_cell(walk, from.mesh, old_cells, is_allowed, near, node_position(to.mesh, c, k));
      near = hit.cell;
      if (places.empty() && hit.squared_distance < distance[i]) {
        distance[i] = hit.squared_distance;
        for (std::size_t n = 0; n < states.size(); ++n)
          results[n].v[i] = velocity_at(states[n], from.space.velocity.of(hit.cell), hit.weights);
      }
      if (k >= 4) continue;
      hit_cells[at(pressures[k])] = hit.cell;
      for (std::size_t n = 0; n < states.size(); ++n)
        results[n].p[at(pressures[k])] =
            pressure_at(states[n], from.space.pressure.nodes.of(hit.cell), hit.weights);
    }
  }
  return results;
}

}  // namespace meniscus::fem
