#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "meniscus/io/table.hpp"

namespace meniscus {

/// A table of benchmark/, embedded in the program.
struct BenchmarkFile {
  std::string_view name;  ///< "uniaxial-extension": the file's name without .csv
  std::string_view text;
};
[[nodiscard]] std::span<const BenchmarkFile> benchmark_files();

/// A curve of a benchmark over time.
struct BenchmarkColumn {
  std::string name, unit, meaning;
  double error = 0.0;      ///< of the reference [unit]
  double tolerance = 0.0;  ///< largest difference that a program may have [unit]
};

/// A reference that any program can be held against. Its file is a table with `t` first. Its head
/// has lines "# key: value" (title, set-up, equations, provenance, licence). For each column it has
/// "# column NAME [UNIT], error E, tolerance T: meaning"; a long line goes on after "#   ".
struct Benchmark {
  std::string name, title, licence;
  std::vector<BenchmarkColumn> columns;  ///< without t
  io::Table table;                       ///< t rises, all cells are finite numbers
};

/// Throws InvalidInput naming the benchmark and what its header or table lacks.
[[nodiscard]] Benchmark read_benchmark(const std::string& name, std::string_view text);
/// The benchmark of this name. Throws InvalidInput listing the names when there is none.
[[nodiscard]] Benchmark benchmark(const std::string& name);

}  // namespace meniscus
