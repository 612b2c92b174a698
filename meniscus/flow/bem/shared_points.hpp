#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "meniscus/linear/communicator.hpp"

namespace meniscus::bem {

/// The points 0 … count − 1 shared out. Each process of a group gets a row of them, and each of its
/// threads a block of those at a time.
class SharedPoints {
 public:
  explicit SharedPoints(std::int32_t count,
                        linear::Communicator communicator = linear::Communicator::self(),
                        int threads = 1);

  /// Calls work(begin, end) for blocks that partition this process's own points. Which thread takes
  /// which block is left to chance, so `work` must compute every point by itself.
  void for_own(const std::function<void(std::int32_t begin, std::int32_t end)>& work) const;
  /// To everyone the values that each process has for its own points: `values` are of all points,
  /// component by component. Collective.
  void gather(std::span<double> values) const;

  [[nodiscard]] linear::Communicator communicator() const { return communicator_; }

 private:
  linear::Communicator communicator_;
  int threads_;
  std::int32_t first_ = 0;            // of this process's own
  std::vector<std::int32_t> counts_;  // by process
};

}  // namespace meniscus::bem
