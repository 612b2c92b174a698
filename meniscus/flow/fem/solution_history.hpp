#pragma once

#include <limits>
#include <span>
#include <vector>

#include "meniscus/core/archive.hpp"
#include "meniscus/flow/fem/stokes_problem.hpp"

namespace meniscus::fem {

/// The last two solutions on a mesh, each less its undisturbed flow, or less what its stage began
/// with. The next solve begins with the line through them.
class SolutionHistory {
 public:
  [[nodiscard]] bool empty() const { return states_.empty(); }
  /// The last one first.
  [[nodiscard]] std::span<const StokesState> states() const { return states_; }
  /// The line through both at the time t; not further from the last than twice their distance. One
  /// alone holds at all times.
  [[nodiscard]] StokesState at(double t) const;

  /// Takes the place of the last one if that is of the same time.
  void add(StokesState state, double t);
  /// The same solutions on another mesh.
  void put_on_mesh(std::vector<StokesState> states);
  void clear();

  void save(Archive& archive) const;
  /// A solution without a time, of an older checkpoint, was long ago. Throws InvalidInput when
  /// arrays do not have the sizes of `like`, or of two solutions the times do not differ.
  void load(const Archive& archive, const StokesState& like);

 private:
  /// Of a solution whose checkpoint does not say its time.
  static constexpr double kLongAgo = -std::numeric_limits<double>::infinity();

  std::vector<StokesState> states_;
  std::vector<double> times_;  // [1/G]
};

}  // namespace meniscus::fem
