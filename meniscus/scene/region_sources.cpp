#include "meniscus/scene/region_sources.hpp"

#include <set>

#include "meniscus/core/error.hpp"

namespace meniscus {

RegionSources joined_sources(const RegionSources& first, const RegionSources& second) {
  if (first.empty()) return second;
  if (second.empty()) return first;
  RegionSources joined;
  for (const std::vector<RegionId>& middle : second) {
    std::set<RegionId> sources;
    for (const RegionId region : middle) {
      MENISCUS_ASSERT(region.value >= 0 && region.value < first.size(), "region {} of {}",
                      region.value, first.size());
      sources.insert(first[region].begin(), first[region].end());
    }
    joined.add({sources.begin(), sources.end()});
  }
  return joined;
}

}  // namespace meniscus
