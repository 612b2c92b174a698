#include "meniscus/volume/cell_tree.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

#include "meniscus/core/error.hpp"
#include "meniscus/geometry/tetrahedron.hpp"

namespace meniscus {
namespace {

namespace bg = boost::geometry;
using Point = bg::model::point<double, 3, bg::cs::cartesian>;
using Box = bg::model::box<Point>;
using Entry = std::pair<Box, std::int32_t>;

Point point(const Vec3& x) { return {x.x(), x.y(), x.z()}; }

Box box(const TetCorners& x) {
  return {point(x[0].cwiseMin(x[1]).cwiseMin(x[2]).cwiseMin(x[3])),
          point(x[0].cwiseMax(x[1]).cwiseMax(x[2]).cwiseMax(x[3]))};
}

std::vector<Entry> entries(const TetMesh& mesh, const std::vector<CellId>& cells) {
  std::vector<Entry> all;
  all.reserve(cells.size());
  for (const CellId c : cells) all.emplace_back(box(corners(mesh, c)), c.value);
  return all;
}

}  // namespace

TetCorners corners(const TetMesh& mesh, CellId c) {
  const CellVertices& v = mesh.cells[c];
  return {mesh.x[v[0]], mesh.x[v[1]], mesh.x[v[2]], mesh.x[v[3]]};
}

struct CellTree::Index {
  bg::index::rtree<Entry, bg::index::quadratic<16>> tree;
};

CellTree::CellTree(const TetMesh& mesh, const std::vector<CellId>& cells)
    : mesh_(mesh),
      index_(std::make_unique<Index>(Index{decltype(Index::tree)(entries(mesh, cells))})) {
  MENISCUS_ASSERT(!cells.empty());
}

CellTree::~CellTree() = default;

std::vector<CellId> CellTree::near(const TetCorners& tet) const {
  std::vector<CellId> found;
  const auto& tree = index_->tree;
  for (auto hit = tree.qbegin(bg::index::intersects(box(tet))); hit != tree.qend(); ++hit)
    found.push_back({hit->second});
  std::ranges::sort(found);
  return found;
}

std::optional<CellTree::Hit> CellTree::containing(const Vec3& p) const {
  std::optional<Hit> found;
  const auto& tree = index_->tree;
  for (auto hit = tree.qbegin(bg::index::intersects(point(p))); hit != tree.qend(); ++hit) {
    const CellId c{hit->second};
    const TetCorners x = corners(mesh_, c);
    if (const auto corner = std::ranges::find(x, p); corner != x.end()) {
      Hit exact{c, {p, {}}, 0.0};
      exact.at.weights[static_cast<std::size_t>(corner - x.begin())] = 1.0;
      return exact;
    }
    if (found) continue;
    const std::array<double, 4> weights = barycentric_coordinates(x, p);
    if (std::ranges::min(weights) >= 0.0) found = Hit{c, {p, weights}, 0.0};
  }
  return found;
}

CellTree::Hit CellTree::closest(const Vec3& p) const {
  if (const std::optional<Hit> inside = containing(p)) return *inside;
  const auto& tree = index_->tree;
  const auto at_cell = [&](CellId c) {
    const TetPoint at = closest_point(corners(mesh_, c), p);
    return Hit{c, at, (at.point - p).squaredNorm()};
  };
  const auto first = tree.qbegin(bg::index::nearest(point(p), 1));
  MENISCUS_ASSERT(first != tree.qend(), "no cell near ({}, {}, {})", p.x(), p.y(), p.z());
  Hit best = at_cell({first->second});
  const Vec3 reach = Vec3::Constant(std::sqrt(best.squared_distance) * (1.0 + 1e-12));
  const Box around(point(p - reach), point(p + reach));
  for (auto hit = tree.qbegin(bg::index::intersects(around)); hit != tree.qend(); ++hit) {
    if (bg::comparable_distance(point(p), hit->first) > best.squared_distance * (1.0 + 1e-12))
      continue;
    const Hit other = at_cell({hit->second});
    if (other.squared_distance < best.squared_distance) best = other;
  }
  return best;
}

}  // namespace meniscus
