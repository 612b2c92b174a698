#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "meniscus/linear/communicator.hpp"

namespace meniscus::linear {

/// Fetches values of items that other ranks own, and gives them values. Items are numbered rank by
/// rank, and each has as many values, side by side. All functions are collective.
class GhostValues {
 public:
  /// This rank owns `num_owned` items, and wants those with these numbers.
  GhostValues(Communicator communicator, std::int32_t num_owned,
              std::span<const std::int32_t> wanted, std::int32_t values_each);
  ~GhostValues();
  GhostValues(const GhostValues&) = delete;
  GhostValues& operator=(const GhostValues&) = delete;

  /// Writes the values of the wanted items, in their order, from what each rank has of its own.
  void fetch(std::span<const double> owned, std::span<double> wanted) const;
  /// The transpose of `fetch`: adds to the owned items what this and other ranks have of them.
  void give(std::span<const double> wanted, std::span<double> owned) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace meniscus::linear
