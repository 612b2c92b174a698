#include "meniscus/report/mesh_cut.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "meniscus/core/error.hpp"
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

/// The axes that span the plane; the first points to the right.
std::array<int, 2> plane_axes(int normal) {
  return normal == 2 ? std::array{0, 1} : std::array{0, 2};
}

class Cutter {
 public:
  Cutter(MeshCut& cut, const io::VolumeFrame& mesh) : cut_(cut), mesh_(mesh) {}

  /// Appends the polygon of cell c and returns its number of points: 0 if the plane misses the cell
  /// or the polygon lies beyond the window.
  int add_points(std::size_t c) {
    const std::size_t first = cut_.points.size();
    crossings_.clear();
    std::vector<std::size_t> above, below;
    for (const std::int32_t v : mesh_.cells[c]) {
      const auto point = static_cast<std::size_t>(v);
      (height(point) >= 0.0 ? above : below).push_back(point);
    }
    if (above.empty() || below.empty()) return 0;
    if (above.size() == 2) {  // in the order round the quadrangle
      add_crossing(above[0], below[0]);
      add_crossing(above[0], below[1]);
      add_crossing(above[1], below[1]);
      add_crossing(above[1], below[0]);
    } else {
      for (const std::size_t a : above) {
        for (const std::size_t b : below) add_crossing(a, b);
      }
    }
    if (is_beyond_window(first)) cut_.points.resize(first);
    return static_cast<int>(cut_.points.size() - first);
  }

  /// The mean of point values over the corners of the last polygon, linear along edges.
  [[nodiscard]] double mean(const std::vector<double>& values) const {
    MENISCUS_ASSERT(!crossings_.empty(), "a mean over no corner");
    double sum = 0.0;
    for (const auto& [a, b, share] : crossings_)
      sum += (1.0 - share) * values[a] + share * values[b];
    return sum / static_cast<double>(crossings_.size());
  }

 private:
  /// The point of an edge that lies on the plane, by its share of the way from a to b.
  struct Crossing {
    std::size_t a, b;
    double share;
  };

  [[nodiscard]] double height(std::size_t point) const {
    return mesh_.points[point][cut_.normal] - cut_.offset;
  }
  void add_crossing(std::size_t a, std::size_t b) {
    const Vec3 &xa = mesh_.points[a], &xb = mesh_.points[b];
    const double share = height(a) / (height(a) - height(b));
    crossings_.push_back({a, b, share});
    const Vec3 x = xa + share * (xb - xa);
    const auto [right, up] = plane_axes(cut_.normal);
    cut_.points.push_back({x[right], x[up]});
  }
  [[nodiscard]] bool is_beyond_window(std::size_t first) const {
    for (std::size_t k = 0; k < 2; ++k) {
      const auto of_polygon = std::span(cut_.points).subspan(first);
      const auto is_left = [&](const auto& x) { return x[k] < cut_.low[k]; };
      const auto is_right = [&](const auto& x) { return x[k] > cut_.high[k]; };
      if (std::ranges::all_of(of_polygon, is_left) || std::ranges::all_of(of_polygon, is_right)) {
        return true;
      }
    }
    return false;
  }

  MeshCut& cut_;
  const io::VolumeFrame& mesh_;
  std::vector<Crossing> crossings_;  // of the last polygon
};

}  // namespace

void add_polygons(MeshCut& cut, const io::VolumeFrame& mesh) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double>* region = cell_values(mesh, "region");
  const std::vector<double>* quality = cell_values(mesh, "min_dihedral_deg");
  const auto arrays = one_value_arrays(mesh.data.on_vertices, mesh.points.size());
  MENISCUS_ASSERT(cut.polygons.empty() && cut.fields.empty(), "a cut is filled twice");
  for (const io::NamedArray* array : arrays) cut.fields.push_back({array->name, {}});
  Cutter cutter(cut, mesh);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const std::size_t first = cut.points.size();
    const int num_points = cutter.add_points(c);
    if (num_points == 0) continue;
    MENISCUS_ASSERT(num_points == 3 || num_points == 4, "a section of {} corners", num_points);
    const int in = region == nullptr ? 0 : static_cast<int>(std::lround((*region)[c]));
    cut.polygons.push_back({first, num_points, in, quality == nullptr ? nan : (*quality)[c]});
    for (std::size_t k = 0; k < arrays.size(); ++k)
      cut.fields[k].values.push_back(cutter.mean(arrays[k]->values));
  }
}

MeshCut cut_through_drops(const io::VolumeFrame& mesh, int normal) {
  MENISCUS_ASSERT(normal == 1 || normal == 2, "a cut normal to axis {}", normal);
  MeshCut cut;
  cut.normal = normal;
  const std::array<int, 2> axes = plane_axes(normal);
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
