#pragma once

#include "meniscus/volume/field_transfer.hpp"
#include "meniscus/volume/linear_reconstruction.hpp"

namespace meniscus {

/// Regions that share liquid across a change of meshes, numbered 0, 1, …, and the group of every
/// cell before and after.
struct RegionGroups {
  std::int32_t num_groups = 0;
  CellField<std::int32_t> before, after;
};

/// Throws InvalidInput when liquid has no region to go to or a region none to come from.
[[nodiscard]] RegionGroups group_regions(const TetMesh& before, const TetMesh& after,
                                         const RegionSources& sources);

[[nodiscard]] std::vector<std::vector<CellId>> cells_by_group(const CellField<std::int32_t>& group,
                                                              std::int32_t num_groups);
/// Least and greatest value in each group; a group without cells has none.
[[nodiscard]] std::vector<ValueRange> group_ranges(const CellField<double>& values,
                                                   const CellField<std::int32_t>& group,
                                                   std::int32_t num_groups);
void raise_excess(FieldExcess& excess, double value, const ValueRange& range);

}  // namespace meniscus
