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

std::shared_ptr<const FlowSpace> KnownElements::space(const FlowDomain& domain) {
  MENISCUS_ASSERT(domain.mesh != nullptr, "finite elements need a volume mesh");
  const auto known = std::ranges::find(spaces_, domain.connectivity, &KnownSpace::connectivity);
  if (known != spaces_.end()) return known->space;
  auto space = std::make_shared<const FlowSpace>(flow_space(*domain.mesh, elements_));
  remember<KnownSpace>({domain.connectivity, space}, 2, spaces_);
  return space;
}

std::shared_ptr<const NodePositions> KnownElements::positions(const FlowDomain& domain) {
  const std::shared_ptr<const FlowSpace> space = this->space(domain);
  const auto known = std::ranges::find_if(positions_, [&](const KnownPositions& each) {
    return each.connectivity == domain.connectivity && each.vertices == domain.mesh->x;
  });
  if (known != positions_.end()) return known->positions;
  auto positions = std::make_shared<const NodePositions>(
      node_positions(domain.scene, *domain.mesh, *space, domain.surfaces));
  remember<KnownPositions>({domain.connectivity, domain.mesh->x, positions}, 3, positions_);
  return positions;
}

}  // namespace meniscus::fem
