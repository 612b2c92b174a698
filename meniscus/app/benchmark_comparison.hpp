#pragma once

#include <string>
#include <vector>

#include "meniscus/case/benchmark.hpp"
#include "meniscus/io/table.hpp"

namespace meniscus {

/// How far a column of a table is from that of a benchmark, in the column's unit.
struct ColumnDifference {
  BenchmarkColumn column;
  double begin = 0.0, end = 0.0;   ///< the times that both tables span
  int compared = 0;                ///< number of times at which they were compared
  double largest = 0.0, at = 0.0;  ///< largest difference, and its time
  double rms = 0.0;                ///< root of the mean squared difference over those times

  [[nodiscard]] bool is_within() const { return largest <= column.tolerance; }
};

struct BenchmarkComparison {
  std::vector<ColumnDifference> columns;
  std::vector<std::string> missing;  ///< columns of the benchmark that the table does not have
};

/// Compares a table with a benchmark, column by column of the same name, over the times that both
/// span. The differences are taken at the rows of the one with fewer there; the other is
/// interpolated. Empty cells are left out. Columns not `chosen` are left out; none chosen: all.
/// Throws InvalidInput naming `file` when a chosen column, `t` or every column is missing, or a
/// cell is no finite number. So it does when t does not rise, or the times do not overlap.
[[nodiscard]] BenchmarkComparison compare_with_benchmark(const Benchmark& benchmark,
                                                         const io::Table& table,
                                                         const std::string& file,
                                                         const std::vector<std::string>& chosen);

/// The comparison in aligned columns, for a terminal.
[[nodiscard]] std::string comparison_text(const Benchmark& benchmark,
                                          const BenchmarkComparison& comparison,
                                          const std::string& file);
/// As a table: column,unit,t_begin,t_end,compared,largest,at,rms,error,tolerance,within.
[[nodiscard]] std::string comparison_csv(const BenchmarkComparison& comparison);

}  // namespace meniscus
