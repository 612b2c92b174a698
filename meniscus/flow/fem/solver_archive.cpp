#include "meniscus/flow/fem/solver_archive.hpp"

#include "meniscus/core/archive_entries.hpp"

namespace meniscus::fem {
void save_positions(const NodePositions& positions, Archive& archive, const std::string& prefix) {
  archive.reals[prefix + "/x"] = flat(positions.x);
  archive.integers[prefix + "/is-curved"] =
      std::vector<std::int64_t>(positions.is_curved.begin(), positions.is_curved.end());
}

NodePositions load_positions(const Archive& archive, const std::string& prefix) {
  NodePositions positions;
  positions.x = vectors<NodeId>(entry_of_rows(archive.reals, prefix + "/x", 3));
  for (const std::int64_t is_curved : entry_of_rows(archive.integers, prefix + "/is-curved", 1))
    positions.is_curved.add(is_curved != 0);
  return positions;
}

void save(const StokesState& state, Archive& archive, const std::string& prefix) {
  archive.reals[prefix + "/velocity"] = flat(state.v);
  archive.reals[prefix + "/pressure"] = state.p;
}

StokesState load_state(const Archive& archive, const std::string& prefix) {
  return {vectors<NodeId>(entry_of_rows(archive.reals, prefix + "/velocity", 3)),
          entry_of_rows(archive.reals, prefix + "/pressure", 1)};
}

}  // namespace meniscus::fem
