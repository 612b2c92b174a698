#include "meniscus/linear/saddle_system.hpp"

#include <cstddef>

#include "meniscus/core/error.hpp"
#include "meniscus/linear/index.hpp"

namespace meniscus::linear {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

CsrMatrix transpose(const CsrView& matrix) {
  CsrMatrix result;
  result.num_columns = matrix.num_rows;
  result.row_start.assign(at(matrix.num_columns) + 1, 0);
  for (const std::int32_t j : matrix.columns) ++result.row_start[at(j) + 1];
  for (std::size_t j = 0; j < at(matrix.num_columns); ++j)
    result.row_start[j + 1] += result.row_start[j];
  result.columns.resize(matrix.columns.size());
  result.values.resize(matrix.values.size());
  std::vector<std::int32_t> next(result.row_start.begin(), result.row_start.end() - 1);
  for (std::int32_t i = 0; i < matrix.num_rows; ++i)
    for (auto k = at(matrix.row_start[at(i)]); k < at(matrix.row_start[at(i) + 1]); ++k) {
      MENISCUS_ASSERT(matrix.columns[k] >= 0 && matrix.columns[k] < matrix.num_columns,
                      "column {} of {}", matrix.columns[k], matrix.num_columns);
      const std::size_t to = at(next[at(matrix.columns[k])]++);
      result.columns[to] = i;
      result.values[to] = matrix.values[k];
    }
  return result;
}

/// Appends row i of `block`, times `scale`, with its columns moved by `shift`.
void append_row(CsrMatrix& to, const CsrView& block, std::int32_t i, std::int32_t shift,
                double scale) {
  for (auto k = at(block.row_start[at(i)]); k < at(block.row_start[at(i) + 1]); ++k) {
    to.columns.push_back(block.columns[k] + shift);
    to.values.push_back(scale * block.values[k]);
  }
}

void end_row(CsrMatrix& matrix) {
  matrix.row_start.push_back(static_cast<std::int32_t>(matrix.columns.size()));
}

}  // namespace

CsrMatrix merged_system(const SaddleSystem& system, double continuity_sign, double pin) {
  const std::int32_t num_velocities = system.num_velocities();
  const CsrMatrix gradient = transpose(system.B);
  const CsrView lower_left = system.lower_left_block();
  CsrMatrix result;
  result.num_columns = system.size();
  const std::size_t entries =
      system.A.values.size() + 2 * system.B.values.size() + system.C.values.size();
  (void)checked_index(static_cast<std::int64_t>(entries), "entries of the merged matrix");
  result.columns.reserve(entries);
  result.values.reserve(entries);
  result.row_start.reserve(at(system.size()) + 1);
  result.row_start.push_back(0);
  for (std::int32_t i = 0; i < num_velocities; ++i) {
    append_row(result, system.A, i, 0, 1.0);
    append_row(result, gradient.view(), i, num_velocities, 1.0);
    end_row(result);
  }
  for (std::int32_t i = 0; i < system.num_pressures(); ++i) {
    append_row(result, lower_left, i, 0, continuity_sign);
    const std::size_t first = result.columns.size();
    append_row(result, system.C, i, num_velocities, -continuity_sign);
    for (std::size_t k = first; i == 0 && k < result.columns.size(); ++k)
      if (result.columns[k] == num_velocities) result.values[k] -= continuity_sign * pin;
    end_row(result);
  }
  return result;
}

}  // namespace meniscus::linear
