#include "meniscus/transport/bulk/scalar_transfer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "meniscus/core/error.hpp"
#include "meniscus/transport/bulk/cell_kernel.hpp"
#include "meniscus/volume/cell_tree.hpp"
#include "meniscus/volume/cell_walk.hpp"

namespace meniscus::bulk {
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

/// The cells of allowed regions: found by a walk, or in a tree where the walk ends away from the
/// point, as a drop was in its way.
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

/// The value at p, found in or near a cell: Newton's method inverts the map of a curved one.
double value_near(const PlacedSpace& from, CellId c, std::array<double, 4> b, const Vec3& p,
                  std::span<const double> values) {
  PointValue here = value_at(from.space, from.positions, c, b, values);
  if (from.positions.is_curved[c] != 0)
    for (int k = 0; k < 5 && (p - here.x).norm() > 1e-12; ++k) {
      const Vec3 step = here.inverse * (p - here.x);
      for (std::size_t a = 0; a < 3; ++a) b[a + 1] += step[static_cast<Eigen::Index>(a)];
      b[0] = 1.0 - b[1] - b[2] - b[3];
      // Where the point lies beyond the cell its nearest point will do.
      for (double& each : b) each = std::clamp(each, 0.0, 1.0);
      const double total = b[0] + b[1] + b[2] + b[3];
      for (double& each : b) each /= total;
      here = value_at(from.space, from.positions, c, b, values);
    }
  return here.value;
}

}  // namespace

std::vector<double> interpolated_values(std::span<const double> values, const PlacedSpace& from,
                                        const PlacedSpace& to, const RegionSources& sources) {
  const CellWalk walk(from.mesh);
  std::vector<Search> searches;
  for (std::vector<bool>& is_allowed : allowed_regions(from.mesh, to.mesh, sources))
    searches.emplace_back(from.mesh, std::move(is_allowed));
  std::vector<CellId> near(searches.size());
  const auto count = at(to.space.num_nodes());
  std::vector<double> result(count, 0.0);
  // A node on an interface is looked for on both sides: the nearer point counts.
  std::vector<double> distance(count, std::numeric_limits<double>::infinity());
  std::vector<std::int32_t> found_for(count, -1);  // the region that it was last looked for in
  std::vector<CellId> cell_of(count);
  for (const CellId c : to.mesh.cells.ids()) {
    const auto nodes = to.space.elements.velocity.of(c);
    const auto region = at(to.mesh.region[c].value);
    for (const std::int32_t node : nodes)
      if (found_for[at(node)] == static_cast<std::int32_t>(region))
        near[region] = cell_of[at(node)];
    for (const std::int32_t node : nodes) {
      if (found_for[at(node)] == static_cast<std::int32_t>(region) || distance[at(node)] == 0.0)
        continue;
      const Vec3& p = to.positions.x[NodeId{node}];
      const CellWalk::Hit hit = searches[region].find(walk, near[region], p);
      near[region] = cell_of[at(node)] = hit.cell;
      found_for[at(node)] = static_cast<std::int32_t>(region);
      if (!(hit.squared_distance < distance[at(node)])) continue;
      distance[at(node)] = hit.squared_distance;
      result[at(node)] = value_near(from, hit.cell, hit.weights, p, values);
    }
  }
  return result;
}

}  // namespace meniscus::bulk
