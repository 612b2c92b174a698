#include "meniscus/report/mesh_cut.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "meniscus/core/error.hpp"
#include "meniscus/report/cell_section.hpp"
#include "meniscus/report/surface_frames.hpp"

namespace meniscus::report {
namespace {

constexpr double margin_share = 0.6;  // margin around the drops, in units of their largest extent

using Box = Eigen::AlignedBox3d;

const std::vector<double>* cell_values(const io::VolumeFrame& mesh, const char* name) {
  const auto found = std::ranges::find(mesh.data.on_cells, name, &io::NamedArray::name);
  const bool is_usable = found != mesh.data.on_cells.end() && found->components == 1 &&
                         found->values.size() == mesh.cells.size();
  return is_usable ? &found->values : nullptr;
}

struct Boxes {
  Box all, drops;  ///< boxes of all cells and of the cells in drops (of all cells when there are no
                   ///< drops)
};

Boxes boxes_of(const io::VolumeFrame& mesh) {
  const std::vector<double>* region = cell_values(mesh, "region");
  Box drops, all;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    for (const std::int32_t v : mesh.cells[c]) {
      const Vec3& x = mesh.points[static_cast<std::size_t>(v)];
      all.extend(x);
      if (region != nullptr && (*region)[c] > 0.5) drops.extend(x);
    }
  }
  return {all, drops.isEmpty() ? all : drops};
}

/// The sections of cell c with a plane, flat or curved.
std::vector<CellSection> sections_of_cell(const io::VolumeFrame& mesh, std::size_t c,
                                          const CutPlane& plane) {
  const auto point = [&](std::int32_t i) { return mesh.points[static_cast<std::size_t>(i)]; };
  std::array<Vec3, 4> corners;
  std::ranges::transform(mesh.cells[c], corners.begin(), point);
  if (mesh.middles.empty() || mesh.middles[c].front() < 0) return section_of(corners, plane);
  std::array<Vec3, 10> nodes;
  std::ranges::copy(corners, nodes.begin());
  std::ranges::transform(mesh.middles[c], nodes.begin() + 4, point);
  return sections_of(nodes, plane);
}

bool is_beyond_window(const MeshCut& cut, const CellSection& section) {
  for (std::size_t k = 0; k < 2; ++k) {
    const auto is_left = [&](const auto& x) { return x[k] < cut.low[k]; };
    const auto is_right = [&](const auto& x) { return x[k] > cut.high[k]; };
    if (std::ranges::all_of(section.points, is_left) ||
        std::ranges::all_of(section.points, is_right))
      return true;
  }
  return false;
}

/// The mean of point values over the corners of a section of cell c.
double mean(const io::VolumeFrame& mesh, std::size_t c, const CellSection& section,
            const std::vector<double>& values) {
  double sum = 0.0;
  for (std::size_t k = 0; k < 4; ++k)
    if (section.weights[k] != 0.0)  // a value that counts for nothing may be infinite
      sum += section.weights[k] * values[static_cast<std::size_t>(mesh.cells[c][k])];
  return sum;
}

/// The ids of drops by region, of region 1 first.
std::vector<int> drops_of_regions(const io::VolumeFrame& mesh) {
  const std::vector<double>* region = cell_values(mesh, "region");
  const std::vector<double>* drop = cell_values(mesh, "drop");
  std::vector<int> drops;
  if (region == nullptr || drop == nullptr) return drops;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const double in = std::round((*region)[c]);
    if (!(in >= 1.0 && in <= static_cast<double>(mesh.cells.size()))) continue;
    const auto i = static_cast<std::size_t>(in) - 1;
    if (i >= drops.size()) drops.resize(i + 1, -1);
    drops[i] = static_cast<int>(std::lround((*drop)[c]));
  }
  return drops;
}

}  // namespace

void add_polygons(MeshCut& cut, const io::VolumeFrame& mesh) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double>* region = cell_values(mesh, "region");
  const std::vector<double>* quality = cell_values(mesh, "min_dihedral_deg");
  const auto arrays = one_value_arrays(mesh.data.on_vertices, mesh.points.size());
  MENISCUS_ASSERT(cut.polygons.empty() && cut.fields.empty(), "a cut is filled twice");
  for (const io::NamedArray* array : arrays) cut.fields.push_back({array->name, {}});
  cut.drops = drops_of_regions(mesh);
  const CutPlane plane{cut.normal, cut.offset};
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const int in = region == nullptr ? 0 : static_cast<int>(std::lround((*region)[c]));
    for (const CellSection& section : sections_of_cell(mesh, c, plane)) {
      if (is_beyond_window(cut, section)) continue;
      cut.polygons.push_back({cut.points.size(), static_cast<int>(section.points.size()), in,
                              quality == nullptr ? nan : (*quality)[c]});
      cut.points.insert(cut.points.end(), section.points.begin(), section.points.end());
      for (std::size_t k = 0; k < arrays.size(); ++k)
        cut.fields[k].values.push_back(mean(mesh, c, section, arrays[k]->values));
    }
  }
}

MeshCut cut_through_drops(const io::VolumeFrame& mesh, int normal) {
  MENISCUS_ASSERT(normal == 1 || normal == 2, "a cut normal to axis {}", normal);
  MeshCut cut;
  cut.normal = normal;
  const std::array<int, 2> axes = CutPlane{normal}.axes();
  cut.axes = {"xyz"[axes[0]], "xyz"[axes[1]]};
  const auto [all, box] = boxes_of(mesh);
  if (box.isEmpty()) return cut;
  cut.offset = box.center()[normal];
  const double margin = margin_share * box.sizes().maxCoeff();
  for (std::size_t k = 0; k < 2; ++k) {
    cut.low[k] = std::max(box.min()[axes[k]] - margin, all.min()[axes[k]]);
    cut.high[k] = std::min(box.max()[axes[k]] + margin, all.max()[axes[k]]);
  }
  add_polygons(cut, mesh);
  return cut;
}

}  // namespace meniscus::report
