#pragma once

#include <utility>
#include <vector>

#include "meniscus/mesh/surface_mesh.hpp"

namespace meniscus {

/// A set of vertices, listed in the order in which they came.
class VertexSet {
 public:
  void insert(VertexId v) {
    if (v.value >= is_in_.size()) is_in_.resize(v.value + 1);
    if (is_in_[v] != 0) return;
    is_in_[v] = 1;
    members_.push_back(v);
  }
  /// The members; the set is empty afterwards.
  [[nodiscard]] std::vector<VertexId> take() {
    for (const VertexId v : members_) is_in_[v] = 0;
    return std::exchange(members_, {});
  }

 private:
  VertexField<char> is_in_;
  std::vector<VertexId> members_;
};

}  // namespace meniscus
