#include "meniscus/flow/fem/node_sources.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "meniscus/core/error.hpp"
#include "meniscus/volume/cell_tree.hpp"
#include "meniscus/volume/cell_walk.hpp"

namespace meniscus::fem {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

std::int32_t num_regions(const TetMesh& mesh) {
  return std::ranges::max_element(mesh.region)->value + 1;
}

/// The old regions, by number, that a region of the new mesh takes its values from.
std::vector<std::vector<bool>> allowed_regions(const TetMesh& before, const TetMesh& after,
                                               const RegionSources& sources) {
  std::vector<std::vector<bool>> result;
  for (const RegionId region : ids<RegionId>(num_regions(after))) {
    std::vector<bool>& is_allowed = result.emplace_back(at(num_regions(before)), false);
    if (sources.empty()) {
      if (region.value < num_regions(before)) is_allowed[at(region.value)] = true;
    } else {
      for (const RegionId old : sources[region])
        if (old.value < num_regions(before)) is_allowed[at(old.value)] = true;
    }
    if (std::ranges::find(is_allowed, true) == is_allowed.end())
      is_allowed.assign(is_allowed.size(), true);
  }
  return result;
}

/// The cells of allowed regions, found by a walk. Where a drop was in its way the walk ends away
/// from the point, and a tree is searched.
class Search {
 public:
  Search(const TetMesh& mesh, std::vector<bool> is_allowed)
      : mesh_(mesh), is_allowed_(std::move(is_allowed)) {}

  [[nodiscard]] CellWalk::Hit find(const CellWalk& walk, CellId near, const Vec3& p) {
    if (!near.is_valid()) return from_tree(p);
    const CellWalk::Hit hit = walk.find(near, p, is_allowed_);
    constexpr double kMostBeyond = 0.02;  // of an edge: interfaces move by less when remeshed
    const TetCorners x = corners(mesh_, hit.cell);
    const double beyond = kMostBeyond * kMostBeyond * (x[1] - x[0]).squaredNorm();
    return hit.squared_distance > beyond ? from_tree(p) : hit;
  }

 private:
  CellWalk::Hit from_tree(const Vec3& p) {
    if (!tree_) {
      std::vector<CellId> cells;
      for (const CellId c : mesh_.cells.ids())
        if (is_allowed_[at(mesh_.region[c].value)]) cells.push_back(c);
      tree_ = std::make_unique<CellTree>(mesh_, cells);
    }
    const CellTree::Hit hit = tree_->closest(p);
    return {hit.cell, hit.at.weights, hit.squared_distance};
  }

  const TetMesh& mesh_;
  std::vector<bool> is_allowed_;
  std::unique_ptr<CellTree> tree_;
};

/// x at a place of a quadratic cell, and ∂b_a/∂x_k of the barycentric coordinates but the first.
struct CellMap {
  Vec3 x = Vec3::Zero();
  Mat3 inverse = Mat3::Zero();
};
CellMap map_at(const PlacedSpace& from, std::span<const std::int32_t> nodes,
               const std::array<double, 4>& b) {
  const std::array<double, 10> phi = quadratic_tetrahedron_values(b);
  CellMap map;
  std::array<Vec3, 4> by;  // ∂x/∂b_k
  by.fill(Vec3::Zero());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vec3& x = from.positions.x[NodeId{nodes[i]}];
    map.x += phi[i] * x;
    if (i < 4) {
      by[i] += (4.0 * b[i] - 1.0) * x;
    } else {
      const auto [j, k] = kCellEdges[i - 4];
      by[j] += 4.0 * b[k] * x;
      by[k] += 4.0 * b[j] * x;
    }
  }
  Mat3 jacobian;
  for (int a = 0; a < 3; ++a) jacobian.col(a) = by[static_cast<std::size_t>(a) + 1] - by[0];
  map.inverse = jacobian.inverse();
  return map;
}

/// The place of p in or near a cell: Newton's method inverts the map of a curved one.
std::array<double, 4> place_in(const PlacedSpace& from, CellId c, std::array<double, 4> b,
                               const Vec3& p) {
  if (from.space.elements != Elements::p2_p1 || from.positions.is_curved[c] == 0) return b;
  const auto nodes = from.space.velocity.of(c);
  for (int k = 0; k < 5; ++k) {
    const CellMap here = map_at(from, nodes, b);
    if ((p - here.x).norm() <= 1e-12) break;
    const Vec3 step = here.inverse * (p - here.x);
    for (std::size_t a = 0; a < 3; ++a) b[a + 1] += step[static_cast<Eigen::Index>(a)];
    b[0] = 1.0 - b[1] - b[2] - b[3];
    // Where the point lies beyond the cell its nearest point will do.
    for (double& each : b) each = std::clamp(each, 0.0, 1.0);
    const double total = b[0] + b[1] + b[2] + b[3];
    for (double& each : b) each /= total;
  }
  return b;
}

}  // namespace

std::array<double, 10> shape_values(const FlowSpace& space,
                                    const std::array<double, 4>& barycentric) {
  if (space.elements == Elements::p2_p1) return quadratic_tetrahedron_values(barycentric);
  std::array<double, 10> values{};
  std::ranges::copy(barycentric, values.begin());
  return values;
}

std::vector<NodeSource> node_sources(const PlacedSpace& from, const PlacedSpace& to,
                                     const RegionSources& sources) {
  const CellWalk walk(from.mesh);
  std::vector<Search> searches;
  for (std::vector<bool>& is_allowed : allowed_regions(from.mesh, to.mesh, sources))
    searches.emplace_back(from.mesh, std::move(is_allowed));
  std::vector<CellId> near(searches.size());
  const auto count = at(to.space.velocity.num_nodes);
  std::vector<NodeSource> result(
      count, {.cell = {}, .squared_distance = std::numeric_limits<double>::infinity()});
  std::vector<std::int32_t> found_for(count, -1);  // the region that it was last looked for in
  std::vector<CellId> cell_of(count);
  for (const CellId c : to.mesh.cells.ids()) {
    const auto nodes = to.space.velocity.of(c);
    const auto region = at(to.mesh.region[c].value);
    for (const std::int32_t node : nodes)
      if (found_for[at(node)] == static_cast<std::int32_t>(region))
        near[region] = cell_of[at(node)];
    for (const std::int32_t node : nodes) {
      NodeSource& source = result[at(node)];
      if (found_for[at(node)] == static_cast<std::int32_t>(region) ||
          source.squared_distance == 0.0)
        continue;
      const Vec3& p = to.positions.x[NodeId{node}];
      const CellWalk::Hit hit = searches[region].find(walk, near[region], p);
      near[region] = cell_of[at(node)] = hit.cell;
      found_for[at(node)] = static_cast<std::int32_t>(region);
      if (!(hit.squared_distance < source.squared_distance)) continue;
      source = {hit.cell, place_in(from, hit.cell, hit.weights, p), hit.squared_distance};
    }
  }
  return result;
}

}  // namespace meniscus::fem
