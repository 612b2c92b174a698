#include "meniscus/volume/field_transfer.hpp"

#include <algorithm>
#include <cmath>

#include "meniscus/core/error.hpp"
#include "meniscus/volume/linear_reconstruction.hpp"
#include "meniscus/volume/mesh_overlay.hpp"
#include "meniscus/volume/settle_debts.hpp"
#include "meniscus/volume/vertex_transfer.hpp"

namespace meniscus {
namespace {

/// Integrals of the reconstruction over the intersections and the uncovered parts, divided by the
/// covered measure. What that misses of the amounts is the cells' debt.
IndebtedField projection(const MeshOverlay& overlay, const LinearReconstruction& linear) {
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

/// Pays what a projected field owes, and keeps the amount of every group.
CellField<double> settled_values(IndebtedField field, const MeshOverlay& overlay,
                                 const GroupNeighbours& neighbours, const CellField<double>& old,
                                 FieldExcess& excess) {
  const GroupedMesh &before = overlay.before, &after = overlay.after;
  const auto ranges = group_ranges(old, before.group, overlay.groups.num_groups);
  settle_debts(field, after.volume, neighbours);
  for (std::size_t g = 0; g < ranges.size(); ++g) {
    const double amount = amount_of(old, before.volume, before.cells[g]);
    settle_amount(field.value, after.volume, after.cells[g], ranges[g], amount);
    for (const CellId c : after.cells[g]) raise_excess(excess, field.value[c], ranges[g]);
  }
  return std::move(field.value);
}

void transfer_on_cells(std::vector<CarriedField<CellId>>& fields, MeshOverlay& overlay,
                       FieldExcess& excess) {
  if (fields.empty()) return;
  overlay.intersect();
  const TetMesh& before = overlay.before.mesh;
  const CellStencils stencils(before, overlay.groups.before);
  const GroupNeighbours neighbours = group_neighbours(overlay.after.mesh, overlay.groups.after);
  for (auto& field : fields) {
    const auto ranges =
        group_ranges(field.values, overlay.groups.before, overlay.groups.num_groups);
    IndebtedField moved = projection(
        overlay, reconstruct(before, stencils, field.values, overlay.groups.before, ranges));
    field.values = field.transfer == FieldTransfer::conserved
                       ? settled_values(std::move(moved), overlay, neighbours, field.values, excess)
                       : std::move(moved.value);
  }
}

}  // namespace

VolumeFields transfer_fields(const VolumeFields& fields, const TetMesh& before,
                             const TetMesh& after, FieldExcess& excess,
                             const RegionSources& sources) {
  check_fields(fields, before);
  VolumeFields carried = fields;
  if (fields.empty()) return carried;
  MeshOverlay overlay(before, after, sources);
  transfer_on_cells(carried.on_cells, overlay, excess);
  if (fields.on_vertices.empty()) return carried;
  const auto hits = locate_vertices(overlay);
  for (auto& field : carried.on_vertices)
    field.values = interpolated_at_vertices(overlay, hits, field.values);
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
