#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace meniscus::io {

/// A cell of a table: empty, a whole number, a real number (written with the fewest digits that
/// read back to the same double), or text.
using Cell = std::variant<std::monostate, std::int64_t, double, std::string>;

/// A CSV file written row by row; each row reaches the disk before `add` returns.
class TableWriter {
 public:
  /// Starts a new file with its header line.
  TableWriter(std::filesystem::path path, std::vector<std::string> columns);
  /// Goes on with an existing file whose rows from the first one with `step` ≥ `first_step` on are
  /// dropped, and with them a last line cut short by a crash. Throws InvalidInput if the header
  /// differs.
  TableWriter(std::filesystem::path path, std::vector<std::string> columns,
              std::int64_t first_step);

  /// Throws RunFailure when the disk refuses the row.
  void add(const std::vector<Cell>& row);

 private:
  std::filesystem::path path_;
  std::size_t num_columns_;
  std::ofstream file_;
};

/// A CSV file in memory; cells that are not numbers are NaN in `column`.
struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  [[nodiscard]] std::optional<std::size_t> find(const std::string& column) const;
  [[nodiscard]] std::vector<double> column(
      const std::string& name) const;  ///< Throws InvalidInput if absent.
};
[[nodiscard]] Table read_table(const std::filesystem::path& path);

}  // namespace meniscus::io
