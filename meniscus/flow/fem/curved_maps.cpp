#include "meniscus/flow/fem/curved_maps.hpp"

#include <algorithm>

#include "meniscus/flow/fem/cell_lanes.hpp"

namespace meniscus::fem {

using namespace lanes;

namespace {

using FourNodes = Numbers<10>;
/// Aligned for the widest vectors, whichever the clone.
struct alignas(64) FourPoints : std::array<CurvedPoint, kTetrahedronRule5.size()> {};
struct alignas(64) FourNumbers {
  Lanes of;
};

MENISCUS_VECTOR_CLONES
void set_maps(std::span<const FourNodes> cells, const double* x, FourPoints* points) {
  for (std::size_t n = 0; n < cells.size(); ++n) {
    Nodal nodes;
    Derivatives d;
    take(cells[n], x, nodes);
    differentiate(nodes, d);
    for (std::size_t q = 0; q < points[n].size(); ++q)
      set_point(kTetrahedronRule5[q], d, points[n][q]);
  }
}

MENISCUS_INLINE void lower(Lanes& least, const Tensor& by) {
  const Lanes determinant = dot(by[0], cross(by[1], by[2]));
  least = determinant < least ? determinant : least;
}

MENISCUS_VECTOR_CLONES
void set_least(std::span<const FourNodes> cells, const double* x, FourNumbers* all) {
  for (std::size_t n = 0; n < cells.size(); ++n) {
    Nodal nodes;
    Derivatives d;
    take(cells[n], x, nodes);
    differentiate(nodes, d);
    Lanes least = dot(d[0][0], cross(d[0][1], d[0][2]));
    for (std::size_t k = 1; k < 4; ++k) lower(least, d[k]);
    for (const auto& [barycentric, share] : kTetrahedronRule5)
      lower(least, at_point(barycentric, d));
    for (const auto& [p, q] : kCellEdges) {
      std::array<double, 4> middle{};
      middle[p] = middle[q] = 0.5;
      lower(least, at_point(middle, d));
    }
    all[n].of = least;
  }
}

/// The nodes of the cells by fours; the last lanes repeat a cell.
std::vector<FourNodes> by_fours(const NodeTable& nodes, std::span<const CellId> cells) {
  std::vector<FourNodes> result((cells.size() + kLanes - 1) / kLanes);
  for (std::size_t n = 0; n < kLanes * result.size(); ++n) {
    const auto of_cell = nodes.of(cells[std::min(n, cells.size() - 1)]);
    for (std::size_t i = 0; i < of_cell.size(); ++i) result[n / kLanes][i][n % kLanes] = of_cell[i];
  }
  return result;
}

const double* first_of(const Field<NodeId, Vec3>& x) { return x.span().front().data(); }

}  // namespace

std::vector<CurvedMaps> curved_maps(const Field<NodeId, Vec3>& x, const NodeTable& nodes,
                                    std::span<const CellId> cells) {
  const std::vector<FourNodes> fours = by_fours(nodes, cells);
  std::vector<FourPoints> points(fours.size());
  set_maps(fours, first_of(x), points.data());
  std::vector<CurvedMaps> maps(cells.size());
  for (std::size_t n = 0; n < maps.size(); ++n)
    for (std::size_t q = 0; q < maps[n].size(); ++q) {
      const CurvedPoint& from = points[n / kLanes][q];
      const std::size_t m = n % kLanes;
      CurvedMap& to = maps[n][q];
      to.weight = from.weight[m];
      for (std::size_t l = 0; l < 3; ++l)
        to.gradient[l] = {from.gradient[l][0][m], from.gradient[l][1][m], from.gradient[l][2][m]};
    }
  return maps;
}

MapsOfCurvedCells::MapsOfCurvedCells(const FlowSpace& space, const NodePositions& positions)
    : place_(positions.is_curved.size(), -1) {
  std::vector<CellId> curved;
  for (const CellId c : place_.ids()) {
    if (positions.is_curved[c] == 0) continue;
    place_[c] = static_cast<std::int32_t>(curved.size());
    curved.push_back(c);
  }
  maps_ = curved_maps(positions.x, space.velocity, curved);
}

std::vector<double> least_jacobians(const Field<NodeId, Vec3>& x, const NodeTable& nodes,
                                    std::span<const CellId> cells) {
  const std::vector<FourNodes> fours = by_fours(nodes, cells);
  std::vector<FourNumbers> least(fours.size());
  set_least(fours, first_of(x), least.data());
  std::vector<double> result(cells.size());
  for (std::size_t n = 0; n < result.size(); ++n) result[n] = least[n / kLanes].of[n % kLanes];
  return result;
}

}  // namespace meniscus::fem
