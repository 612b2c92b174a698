#include "meniscus/volume/region_groups.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

std::int32_t num_regions(const TetMesh& mesh) {
  std::int32_t most = -1;
  for (const RegionId r : mesh.region) most = std::max(most, r.value);
  return most + 1;
}

/// The representative of a set, with paths halved on the way.
std::size_t find_root(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

/// Old regions 0 … n_old − 1 and new ones n_old … as sets joined by the sources.
std::vector<std::size_t> joined_regions(std::int32_t num_old, std::int32_t num_new,
                                        const RegionSources& sources) {
  std::vector<std::size_t> parent(static_cast<std::size_t>(num_old + num_new));
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  for (std::int32_t r = 0; r < num_new; ++r) {
    const std::vector<RegionId> own{RegionId{r}};
    const std::vector<RegionId>& old = sources.empty() ? own : sources[RegionId{r}];
    if (old.empty()) reject_input("region {} takes the fields of no region", r);
    for (const RegionId o : old) {
      if (o.value < 0 || o.value >= num_old)
        reject_input("region {} takes the fields of region {}, of {} there are", r, o.value,
                     num_old);
      const std::size_t a = find_root(parent, static_cast<std::size_t>(o.value));
      parent[find_root(parent, at(num_old) + at(r))] = a;
    }
  }
  return parent;
}

}  // namespace

RegionGroups group_regions(const TetMesh& before, const TetMesh& after,
                           const RegionSources& sources) {
  const std::int32_t num_old = num_regions(before), num_new = num_regions(after);
  if (!sources.empty() && sources.size() != num_new)
    reject_input("sources of {} regions for a mesh of {}", sources.size(), num_new);
  std::vector<std::size_t> parent = joined_regions(num_old, num_new, sources);
  std::vector<std::int32_t> number(parent.size(), -1);
  RegionGroups groups;
  for (std::int32_t r = 0; r < num_new; ++r) {
    std::int32_t& n = number[find_root(parent, at(num_old) + at(r))];
    if (n < 0) n = groups.num_groups++;
  }
  for (const RegionId r : before.region) {
    const std::int32_t n = number[find_root(parent, static_cast<std::size_t>(r.value))];
    if (n < 0) reject_input("no region takes the fields of region {}", r.value);
    groups.before.add(n);
  }
  for (const RegionId r : after.region)
    groups.after.add(number[find_root(parent, at(num_old) + at(r.value))]);
  return groups;
}

std::vector<std::vector<CellId>> cells_by_group(const CellField<std::int32_t>& group,
                                                std::int32_t num_groups) {
  std::vector<std::vector<CellId>> cells(static_cast<std::size_t>(num_groups));
  for (const CellId c : group.ids()) cells[static_cast<std::size_t>(group[c])].push_back(c);
  return cells;
}

std::vector<ValueRange> group_ranges(const CellField<double>& values,
                                     const CellField<std::int32_t>& group,
                                     std::int32_t num_groups) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<ValueRange> ranges(static_cast<std::size_t>(num_groups), {infinity, -infinity});
  for (const CellId c : values.ids()) {
    ValueRange& range = ranges[static_cast<std::size_t>(group[c])];
    range.low = std::min(range.low, values[c]);
    range.high = std::max(range.high, values[c]);
  }
  return ranges;
}

void raise_excess(FieldExcess& excess, double value, const ValueRange& range) {
  excess.above = std::max(excess.above, value - range.high);
  excess.below = std::max(excess.below, range.low - value);
}

}  // namespace meniscus
