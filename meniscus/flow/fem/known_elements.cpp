#include "meniscus/flow/fem/known_elements.hpp"

#include <algorithm>

#include "meniscus/core/error.hpp"

namespace meniscus::fem {
namespace {

template <class Known>
void remember(Known known, std::size_t most, std::deque<Known>& last) {
  last.push_front(std::move(known));
  if (last.size() > most) last.pop_back();
}

}  // namespace

std::shared_ptr<const FlowSpace> KnownElements::known_space(std::int64_t connectivity) const {
  const auto known = std::ranges::find(spaces_, connectivity, &KnownSpace::connectivity);
  return known != spaces_.end() ? known->space : nullptr;
}

std::shared_ptr<const FlowSpace> KnownElements::space(const FlowDomain& domain) {
  MENISCUS_ASSERT(domain.mesh != nullptr, "finite elements need a volume mesh");
  if (auto known = known_space(domain.connectivity)) return known;
  auto space = std::make_shared<const FlowSpace>(flow_space(*domain.mesh, elements_));
  remember<KnownSpace>({domain.connectivity, space}, 2, spaces_);
  return space;
}

std::shared_ptr<const NodePositions> KnownElements::positions(const FlowDomain& domain) {
  const std::shared_ptr<const FlowSpace> space = this->space(domain);
  const auto known = std::ranges::find_if(positions_, [&](const KnownPositions& each) {
    return each.connectivity == domain.connectivity && each.vertices == domain.mesh->x;
  });
  if (known != positions_.end()) {
    std::rotate(positions_.begin(), known, known + 1);
    return positions_.front().positions;
  }
  auto positions = std::make_shared<const NodePositions>(
      node_positions(domain.scene, *domain.mesh, *space, domain.surfaces));
  remember<KnownPositions>({domain.connectivity, domain.mesh->x, positions}, 5, positions_);
  return positions;
}

std::shared_ptr<const std::vector<NodeSource>> KnownElements::sources(const MeshChange& change,
                                                                      const FlowDomain& domain) {
  if (last_.sources && last_.connectivity == domain.connectivity) return last_.sources;
  const auto before = std::ranges::find(positions_, change.before.x, &KnownPositions::vertices);
  if (before == positions_.end()) return nullptr;
  const std::shared_ptr<const FlowSpace> old_space = known_space(before->connectivity);
  if (!old_space) return nullptr;
  const std::shared_ptr<const NodePositions> old_positions = before->positions;
  last_ = {domain.connectivity,
           std::make_shared<const std::vector<NodeSource>>(
               node_sources({change.before, *old_space, *old_positions},
                            {*domain.mesh, *space(domain), *positions(domain)}, change.sources))};
  return last_.sources;
}

}  // namespace meniscus::fem
