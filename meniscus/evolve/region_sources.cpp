#include "meniscus/evolve/region_sources.hpp"

#include <map>
#include <set>

namespace meniscus {

RegionSources region_sources(const Scene& before, const Scene& after,
                             const std::vector<TopologyEvent>& events) {
  if (events.empty()) return {};
  std::map<int, std::set<RegionId>> liquids;  // of the drops that exist or existed, by id
  for (const Interface& interface : before.interfaces)
    liquids[interface.drop].insert(interface.inside);
  for (const TopologyEvent& event : events)
    for (const int child : event.children)
      for (const int parent : event.parents)
        liquids[child].insert(liquids[parent].begin(), liquids[parent].end());

  RegionSources sources(after.liquids.size());
  std::set<RegionId> lost;
  for (const RegionId region : before.liquids.ids()) lost.insert(region);
  for (const Interface& interface : after.interfaces) {
    const std::set<RegionId>& of = liquids[interface.drop];
    sources[interface.inside].assign(of.begin(), of.end());
    for (const RegionId region : of) lost.erase(region);
  }
  lost.insert(RegionId{0});
  sources[RegionId{0}].assign(lost.begin(), lost.end());
  return sources;
}

}  // namespace meniscus
