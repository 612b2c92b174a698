#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "meniscus/flow/fem/node_sources.hpp"
#include "meniscus/flow/flow_solver.hpp"

namespace meniscus::fem {

/// Makes the elements of meshes and finds where their nodes are, and remembers the last ones. The
/// flow and the scalars ask for those of the same domains in turn.
class KnownElements {
 public:
  explicit KnownElements(Elements elements) : elements_(elements) {}

  [[nodiscard]] Elements elements() const { return elements_; }
  /// The space on a domain's mesh, the same for the same connectivity.
  [[nodiscard]] std::shared_ptr<const FlowSpace> space(const FlowDomain& domain);
  /// Where the nodes of that space are.
  [[nodiscard]] std::shared_ptr<const NodePositions> positions(const FlowDomain& domain);
  /// Where the nodes of a domain's mesh lie in the one whose place it took. Null where it is not
  /// known any more where that one's nodes were.
  [[nodiscard]] std::shared_ptr<const std::vector<NodeSource>> sources(const MeshChange& change,
                                                                       const FlowDomain& domain);

 private:
  struct KnownSpace {
    std::int64_t connectivity = 0;
    std::shared_ptr<const FlowSpace> space;
  };
  struct KnownPositions {
    std::int64_t connectivity = 0;
    Field<TetVertexId, Vec3> vertices;
    std::shared_ptr<const NodePositions> positions;
  };
  struct KnownSources {
    std::int64_t connectivity = 0;  // that they lead to
    std::shared_ptr<const std::vector<NodeSource>> sources;
  };
  [[nodiscard]] std::shared_ptr<const FlowSpace> known_space(std::int64_t connectivity) const;

  Elements elements_;
  // Those asked for last first. A step begins on one mesh and goes on with another.
  std::deque<KnownSpace> spaces_;
  std::deque<KnownPositions> positions_;
  KnownSources last_;
};

}  // namespace meniscus::fem
