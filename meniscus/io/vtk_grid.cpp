#include "meniscus/io/vtk_grid.hpp"

#include <algorithm>

#include "meniscus/core/error.hpp"

namespace meniscus::io {
namespace {

/// One number for two points, in whatever order.
std::uint64_t key(vtkIdType a, vtkIdType b) {
  return (static_cast<std::uint64_t>(std::min(a, b)) << 32) |
         static_cast<std::uint64_t>(std::max(a, b));
}

}  // namespace

GridBuilder::GridBuilder(const CurvedEdges& curved, std::size_t num_corner_points)
    : curved_(curved), num_corner_points_(num_corner_points) {
  MENISCUS_ASSERT(curved.middles.size() == curved.ends.size(), "{} middles of {} edges",
                  curved.middles.size(), curved.ends.size());
  for (std::size_t e = 0; e < curved.ends.size(); ++e)
    edges_.emplace(key(curved.ends[e][0], curved.ends[e][1]), e);
  points_.reserve(num_corner_points);
  cells_->Use32BitStorage();  // ids of ours have 32 bits
}

std::optional<std::size_t> GridBuilder::curved_edge(std::int32_t a, std::int32_t b) const {
  const auto found = edges_.find(key(a, b));
  return found == edges_.end() ? std::nullopt : std::optional(found->second);
}

vtkIdType GridBuilder::middle(vtkIdType a, vtkIdType b, std::optional<std::size_t> edge) {
  const auto next = static_cast<vtkIdType>(num_corner_points_ + middles_.size());
  const auto [found, is_new] = middle_points_.try_emplace(key(a, b), next);
  if (is_new) middles_.push_back({a, b, edge});
  return found->second;
}

template <std::size_t Corners>
void GridBuilder::add_cell(const std::array<std::int32_t, Corners>& vertices,
                           const std::array<vtkIdType, Corners>& corners) {
  using Cell = VtkCell<Corners>;
  constexpr std::size_t kEdges = Cell::edges.size();
  std::array<std::optional<std::size_t>, kEdges> curved;
  std::ranges::transform(Cell::edges, curved.begin(), [&](const std::array<std::size_t, 2>& ends) {
    return curved_edge(vertices[ends[0]], vertices[ends[1]]);
  });
  std::vector<vtkIdType> nodes(corners.begin(), corners.end());
  const bool is_curved = std::ranges::any_of(curved, [](const auto& e) { return e.has_value(); });
  if (is_curved)
    for (std::size_t k = 0; k < kEdges; ++k) {
      const auto [a, b] = Cell::edges[k];
      nodes.push_back(middle(corners[a], corners[b], curved[k]));
    }
  cells_->InsertNextCell(static_cast<vtkIdType>(nodes.size()), nodes.data());
  types_->InsertNextValue(static_cast<unsigned char>(is_curved ? Cell::quadratic : Cell::flat));
}

template void GridBuilder::add_cell(const std::array<std::int32_t, 3>&,
                                    const std::array<vtkIdType, 3>&);
template void GridBuilder::add_cell(const std::array<std::int32_t, 4>&,
                                    const std::array<vtkIdType, 4>&);

vtkNew<vtkUnstructuredGrid> GridBuilder::grid() const {
  MENISCUS_ASSERT(points_.size() == num_corner_points_, "{} of {} points", points_.size(),
                  num_corner_points_);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& x : points_) points->InsertNextPoint(x.data());
  for (const Middle& middle : middles_) {
    const Vec3 x = middle.edge ? curved_.middles[*middle.edge]
                               : Vec3(0.5 * (points_[static_cast<std::size_t>(middle.a)] +
                                             points_[static_cast<std::size_t>(middle.b)]));
    points->InsertNextPoint(x.data());
  }
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  grid->SetCells(types_, cells_);
  return grid;
}

NamedArray GridBuilder::at_all_points(NamedArray array) const {
  const auto size = static_cast<std::size_t>(array.components);
  MENISCUS_ASSERT(array.values.size() == size * num_corner_points_,
                  "array {} has {} values for {} points", array.name, array.values.size(),
                  num_corner_points_);
  const auto known = std::ranges::find(curved_.values, array.name, &NamedArray::name);
  const bool is_known = known != curved_.values.end();
  MENISCUS_ASSERT(!is_known || known->values.size() == size * curved_.middles.size(),
                  "array {} has {} values for {} middles", array.name, known->values.size(),
                  curved_.middles.size());
  for (const Middle& middle : middles_)
    for (std::size_t k = 0; k < size; ++k) {
      const double at_a = array.values[size * static_cast<std::size_t>(middle.a) + k],
                   at_b = array.values[size * static_cast<std::size_t>(middle.b) + k];
      array.values.push_back(is_known && middle.edge ? known->values[size * *middle.edge + k]
                                                     : 0.5 * (at_a + at_b));
    }
  return array;
}

}  // namespace meniscus::io
