#include "meniscus/volume/field_transfer.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "meniscus/core/error.hpp"
#include "meniscus/volume/cell_tree.hpp"
#include "meniscus/volume/region_groups.hpp"
#include "meniscus/volume/settle_debts.hpp"

namespace meniscus {
namespace {

// Below this share of a cell what its intersections miss is their round-off, not space.
constexpr double kLeastShare = 1e-9;

CellField<double> cell_volumes(const TetMesh& mesh) {
  CellField<double> volume;
  for (const CellId c : mesh.cells.ids()) {
    volume.add(signed_volume(mesh, c));
    MENISCUS_ASSERT(volume[c] > 0.0, "cell {} of volume {}", c.value, volume[c]);
  }
  return volume;
}

/// What an old and a new cell have in common.
struct Intersection {
  CellId before, after;
  VolumeMoments part;
};

/// A part of a cell that the other mesh does not cover, as an amount given or taken at a cell.
struct Gap {
  CellId cell;     ///< the cell that has it
  CellId nearest;  ///< of the other mesh
  Vec3 at;         ///< a point of `nearest` near the part
  double volume = 0.0;
};

struct Mesh {
  const TetMesh& mesh;
  const CellField<std::int32_t>& group;
  std::vector<std::vector<CellId>> cells;
  CellField<double> volume;
  CellField<HalfSpaceTet> shape;  ///< where cells are intersected
  std::vector<std::unique_ptr<CellTree>> trees;

  Mesh(const TetMesh& tetrahedra, const CellField<std::int32_t>& groups, std::int32_t num_groups)
      : mesh(tetrahedra), group(groups), cells(cells_by_group(groups, num_groups)) {
    volume = cell_volumes(mesh);
    for (const auto& members : cells) trees.push_back(std::make_unique<CellTree>(mesh, members));
  }
  void find_shapes() {
    for (const CellId c : mesh.cells.ids()) shape.add(HalfSpaceTet(corners(mesh, c)));
  }
  [[nodiscard]] const CellTree& tree(std::int32_t g) const {
    return *trees[static_cast<std::size_t>(g)];
  }
};

std::vector<Intersection> intersections(const Mesh& before, const Mesh& after) {
  std::vector<Intersection> all;
  for (const CellId c : after.mesh.cells.ids()) {
    const HalfSpaceTet& shape = after.shape[c];
    for (const CellId old : before.tree(after.group[c]).near(shape.corners())) {
      const VolumeMoments part = tet_overlap(before.shape[old], shape);
      if (part.volume > 0.0) all.push_back({old, c, part});
    }
  }
  return all;
}

/// What the intersections leave of the cells of `self`; `cell_of` picks its cell of each.
template <class CellOf>
std::vector<Gap> find_gaps(const Mesh& self, const Mesh& other,
                           const std::vector<Intersection>& parts, const CellOf& cell_of) {
  CellField<VolumeMoments> covered(self.mesh.num_cells());
  for (const Intersection& i : parts) {
    covered[cell_of(i)].volume += i.part.volume;
    covered[cell_of(i)].moment += i.part.moment;
  }
  std::vector<Gap> gaps;
  for (const CellId c : self.mesh.cells.ids()) {
    const double volume = self.volume[c] - covered[c].volume;
    if (volume <= kLeastShare * self.volume[c]) continue;
    const Vec3 moment = tet_moments(corners(self.mesh, c)).moment - covered[c].moment;
    const Vec3 at = closest_point(corners(self.mesh, c), moment / volume).point;
    const CellTree::Hit hit = other.tree(self.group[c]).closest(at);
    gaps.push_back({c, hit.cell, hit.at.point, volume});
  }
  return gaps;
}

/// Everything about two meshes that all fields share.
struct Overlay {
  RegionGroups groups;
  Mesh before, after;
  CellStencils stencils;
  std::vector<Intersection> parts;
  std::vector<Gap> uncovered, lost;
  GroupNeighbours neighbours;

  Overlay(const TetMesh& old, const TetMesh& now, const RegionSources& sources)
      : groups(group_regions(old, now, sources)),
        before(old, groups.before, groups.num_groups),
        after(now, groups.after, groups.num_groups),
        stencils(old, groups.before) {}
  void intersect() {
    before.find_shapes();
    after.find_shapes();
    parts = intersections(before, after);
    uncovered = find_gaps(after, before, parts, [](const Intersection& i) { return i.after; });
    lost = find_gaps(before, after, parts, [](const Intersection& i) { return i.before; });
    neighbours = group_neighbours(after.mesh, after.group);
  }
};

/// Integrals of the reconstruction over the intersections and the uncovered parts, divided by the
/// covered measure; what that gave too much or too little is owed.
IndebtedField projected(const Overlay& overlay, const LinearReconstruction& linear) {
  const std::int32_t size = overlay.after.mesh.num_cells();
  CellField<double> integral(size, 0.0), measure(size, 0.0), debt(size, 0.0);
  CellField<double> kept(overlay.before.mesh.num_cells(), 0.0);
  CellField<ValueRange> range(size, {HUGE_VAL, -HUGE_VAL});
  const auto widen = [&](CellId c, const ValueRange& by) {
    range[c] = {std::min(range[c].low, by.low), std::max(range[c].high, by.high)};
  };
  for (const auto& [old, now, part] : overlay.parts) {
    const double amount = part.volume * linear.value(old, part.moment / part.volume);
    integral[now] += amount;
    measure[now] += part.volume;
    kept[old] += amount;
    widen(now, linear.range[old]);
  }
  for (const Gap& gap : overlay.uncovered) {
    const double amount = gap.volume * linear.value(gap.nearest, gap.at);
    integral[gap.cell] += amount;
    measure[gap.cell] += gap.volume;
    debt[gap.cell] -= amount;
    widen(gap.cell, linear.range[gap.nearest]);
  }
  for (const Gap& gap : overlay.lost)
    debt[gap.nearest] += linear.mean[gap.cell] * overlay.before.volume[gap.cell] - kept[gap.cell];
  IndebtedField field{CellField<double>(size), std::move(debt), std::move(range)};
  for (const CellId c : field.value.ids()) {
    MENISCUS_ASSERT(measure[c] > 0.0, "cell {} took nothing", c.value);
    field.value[c] = std::clamp(integral[c] / measure[c], field.range[c].low, field.range[c].high);
  }
  return field;
}

CellField<double> conserved_on_cells(const Overlay& overlay, const LinearReconstruction& linear,
                                     const std::vector<ValueRange>& ranges, FieldExcess& excess) {
  IndebtedField field = projected(overlay, linear);
  settle_debts(field, overlay.after.volume, overlay.neighbours);
  for (std::size_t g = 0; g < ranges.size(); ++g) {
    const double amount = amount_of(linear.mean, overlay.before.volume, overlay.before.cells[g]);
    settle_amount(field.value, overlay.after.volume, overlay.after.cells[g], ranges[g], amount);
    for (const CellId c : overlay.after.cells[g]) raise_excess(excess, field.value[c], ranges[g]);
  }
  return std::move(field.value);
}

CellField<double> interpolated_on_cells(const Overlay& overlay,
                                        const LinearReconstruction& linear) {
  CellField<double> values;
  for (const CellId c : overlay.after.mesh.cells.ids()) {
    const TetCorners x = corners(overlay.after.mesh, c);
    const Vec3 centroid = 0.25 * (x[0] + x[1] + x[2] + x[3]);
    const CellTree::Hit hit = overlay.before.tree(overlay.after.group[c]).closest(centroid);
    const ValueRange& range = linear.range[hit.cell];
    values.add(std::clamp(linear.value(hit.cell, hit.at.point), range.low, range.high));
  }
  return values;
}

/// Where the vertices of the new mesh lie among the old cells of the regions that they touch.
Field<TetVertexId, CellTree::Hit> locate_vertices(const Overlay& overlay) {
  const TetMesh& mesh = overlay.after.mesh;
  Field<TetVertexId, std::vector<std::int32_t>> touched(mesh.num_vertices());
  for (const CellId c : mesh.cells.ids())
    for (const TetVertexId v : mesh.cells[c])
      if (std::ranges::find(touched[v], overlay.after.group[c]) == touched[v].end())
        touched[v].push_back(overlay.after.group[c]);
  Field<TetVertexId, CellTree::Hit> hits;
  for (const TetVertexId v : mesh.x.ids()) {
    MENISCUS_ASSERT(!touched[v].empty(), "vertex {} has no cell", v.value);
    std::ranges::sort(touched[v]);
    std::optional<CellTree::Hit> best;
    for (const std::int32_t g : touched[v]) {
      const CellTree::Hit hit = overlay.before.tree(g).closest(mesh.x[v]);
      if (!best || hit.squared_distance < best->squared_distance) best = hit;
    }
    hits.add(*best);
  }
  return hits;
}

/// Σ w_k u_k, kept between the least and the greatest u_k.
double interpolate(const CellVertices& cell, const std::array<double, 4>& weights,
                   const Field<TetVertexId, double>& values) {
  double sum = 0.0, low = HUGE_VAL, high = -HUGE_VAL;
  for (std::size_t k = 0; k < 4; ++k) {
    const double value = values[cell[k]];
    sum += weights[k] * value;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return std::clamp(sum, low, high);
}

}  // namespace

VolumeFields transfer_fields(const VolumeFields& fields, const TetMesh& before,
                             const TetMesh& after, FieldExcess& excess,
                             const RegionSources& sources) {
  check_fields(fields, before);
  VolumeFields carried = fields;
  if (fields.empty()) return carried;
  Overlay overlay(before, after, sources);
  const auto is_conserved = [](const auto& f) { return f.transfer == FieldTransfer::conserved; };
  if (std::ranges::any_of(fields.on_cells, is_conserved)) overlay.intersect();
  for (auto& field : carried.on_cells) {
    const auto ranges =
        group_ranges(field.values, overlay.groups.before, overlay.groups.num_groups);
    const LinearReconstruction linear =
        reconstruct(before, overlay.stencils, field.values, overlay.groups.before, ranges);
    field.values = is_conserved(field) ? conserved_on_cells(overlay, linear, ranges, excess)
                                       : interpolated_on_cells(overlay, linear);
  }
  if (fields.on_vertices.empty()) return carried;
  const auto hits = locate_vertices(overlay);
  for (std::size_t i = 0; i < fields.on_vertices.size(); ++i) {
    carried.on_vertices[i].values.resize(after.num_vertices());
    for (const TetVertexId v : hits.ids())
      carried.on_vertices[i].values[v] =
          interpolate(before.cells[hits[v].cell], hits[v].at.weights, fields.on_vertices[i].values);
  }
  return carried;
}

void move_fields(VolumeFields& fields, const TetMesh& before, const TetMesh& after,
                 FieldExcess& excess) {
  MENISCUS_ASSERT(before.cells == after.cells, "another connectivity");
  check_fields(fields, before);
  const RegionGroups groups = group_regions(before, after, {});
  for (auto& field : fields.on_cells) {
    if (field.transfer != FieldTransfer::conserved) continue;
    const auto ranges = group_ranges(field.values, groups.before, groups.num_groups);
    for (const CellId c : before.cells.ids()) {
      const double volume = signed_volume(after, c);
      MENISCUS_ASSERT(volume > 0.0, "cell {} of volume {}", c.value, volume);
      field.values[c] *= signed_volume(before, c) / volume;
      raise_excess(excess, field.values[c], ranges[static_cast<std::size_t>(groups.after[c])]);
    }
  }
}

}  // namespace meniscus
