#include "meniscus/surface/dense_equations.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "meniscus/core/error.hpp"
#include "meniscus/core/vector_clones.hpp"

namespace meniscus {
namespace {

constexpr std::size_t kMost = DenseEquations::kMost;
constexpr std::size_t kLanes = 8;  // columns that are treated at once
static_assert(kMost % kLanes == 0);

constexpr std::size_t block_of(std::size_t column) { return column / kLanes * kLanes; }

/// Takes multiples of the pivot's row from those that still wait. Columns up to the pivot's hold
/// multiples already.
MENISCUS_VECTOR_CLONES void eliminate(double* rows, std::size_t n, std::size_t* order) {
  alignas(64) double pivot[kMost];
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t best = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(rows[kMost * order[i] + k]) > std::abs(rows[kMost * order[best] + k])) best = i;
    std::swap(order[k], order[best]);
    const double* chosen = rows + kMost * order[k];
    const double scale = 1.0 / chosen[k];
    for (std::size_t j = 0; j < kMost; ++j) pivot[j] = j > k ? chosen[j] : 0.0;
    for (std::size_t i = k + 1; i < n; ++i) {
      double* __restrict row = rows + kMost * order[i];
      const double multiple = row[k] * scale;
      for (std::size_t block = block_of(k); block < kMost; block += kLanes)
        for (std::size_t lane = 0; lane < kLanes; ++lane)
          row[block + lane] -= multiple * pivot[block + lane];
      row[k] = multiple;
    }
  }
}

/// Σ row_j x_j over the columns from one to another, which are all but the zeros of x, in as many
/// sums as there are lanes.
double product(const double* row, const double* x, std::size_t from, std::size_t to) {
  std::array<double, kLanes> sums{};
  for (std::size_t block = block_of(from); block <= to; block += kLanes)
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      sums[lane] += row[block + lane] * x[block + lane];
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

}  // namespace

void DenseEquations::reset(std::size_t n) {
  MENISCUS_ASSERT(n <= kMost, "{} unknowns", n);
  size_ = n;
  std::ranges::fill(rows_, 0.0);
  std::iota(order_.begin(), order_.end(), std::size_t{0});
}

void DenseEquations::factorize() { eliminate(rows_.data(), size_, order_.data()); }

void DenseEquations::solve(std::span<double> b) const {
  MENISCUS_ASSERT(b.size() == size_, "{} values of {} unknowns", b.size(), size_);
  // What is not known yet is zero, so that whole blocks may be multiplied.
  alignas(64) std::array<double, kMost> y{}, x{};
  for (std::size_t k = 0; k < size_; ++k)
    y[k] = b[order_[k]] - product(&rows_[kMost * order_[k]], y.data(), 0, k);
  for (std::size_t k = size_; k-- > 0;) {
    const double* row = &rows_[kMost * order_[k]];
    x[k] = (y[k] - product(row, x.data(), k, kMost - 1)) / row[k];
  }
  std::copy_n(x.begin(), size_, b.begin());
}

}  // namespace meniscus
