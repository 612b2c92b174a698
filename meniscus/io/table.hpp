#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace meniscus::io {

/// A cell of a table: empty, a whole number, a real number or text. Real numbers have the fewest
/// digits that read back to the same double.
using Cell = std::variant<std::monostate, std::int64_t, double, std::string>;

/// A CSV file written row by row; the system holds each row before `add` returns, so that a program
/// killed at any moment loses none. Texts with a comma, quote or line break are quoted.
class TableWriter {
 public:
  /// Starts a new file with its header line. Throws RunFailure when the disk refuses.
  TableWriter(std::filesystem::path path, const std::vector<std::string>& columns);
  /// Goes on with an existing file whose rows from the first one with `step` ≥ `first_step` on are
  /// dropped. So is a last line cut short by a crash. Throws InvalidInput if the header differs, is
  /// without `step`, or a row is not ours.
  TableWriter(std::filesystem::path path, const std::vector<std::string>& columns,
              std::int64_t first_step);

  /// Throws RunFailure when the disk refuses the row; the file ends with the row before then.
  void add(const std::vector<Cell>& row);

 private:
  void append(const std::string& line);

  std::filesystem::path path_;
  std::size_t num_columns_;
  std::ofstream file_;
};

/// A CSV file in memory, its first row the names of the columns; cells that are not numbers are NaN
/// in `column`.
struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  [[nodiscard]] std::optional<std::size_t> find(const std::string& column) const;
  /// Place of a column; throws InvalidInput if absent.
  [[nodiscard]] std::size_t index_of(const std::string& name) const;
  [[nodiscard]] std::vector<double> column(
      const std::string& name) const;  ///< Throws InvalidInput if absent.
};
/// Throws InvalidInput where a `TableWriter` cannot go on with a file, as its constructor does.
void require_rows(const std::filesystem::path& path, const std::vector<std::string>& columns,
                  std::int64_t first_step);

/// A table that a run writes. A last line without a line break is left out: it may be cut short.
/// Throws InvalidInput naming the file and the line when it is
/// missing, empty, or a row has not as many cells as there are columns.
[[nodiscard]] Table read_table(const std::filesystem::path& path);
/// As `read_table`, of a table that people write. Its last line counts without a line break too.
/// Lines that begin with `#` and empty ones are skipped.
[[nodiscard]] Table read_commented_table(const std::filesystem::path& path);

}  // namespace meniscus::io
