#pragma once
// Private header of this room.

#include <array>
#include <cstddef>
#include <span>

namespace meniscus {

/// A x = b for a few dozen unknowns, by elimination with partial pivoting in memory of fixed size.
/// Splines solve thousands of such systems in a step; for 47 unknowns this takes under half of the
/// time of Eigen's blocked elimination. A singular matrix leaves solutions that are not numbers, or
/// large.
class DenseEquations {
 public:
  static constexpr std::size_t kMost = 48;  ///< unknowns

  /// n equations, all entries zero.
  void reset(std::size_t n);
  [[nodiscard]] double& operator()(std::size_t i, std::size_t j) { return rows_[kMost * i + j]; }
  /// Eliminates; the entries are lost.
  void factorize();
  /// Takes b to x. Only after `factorize`.
  void solve(std::span<double> b) const;

 private:
  std::size_t size_ = 0;
  std::array<std::size_t, kMost> order_{};              // of the rows as pivots
  alignas(64) std::array<double, kMost * kMost> rows_;  // the factors: L without its ones, and U
};

}  // namespace meniscus
