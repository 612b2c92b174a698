#include "meniscus/io/table.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>

#include "meniscus/core/error.hpp"
#include "meniscus/io/atomic_file.hpp"
#include "meniscus/io/csv_line.hpp"
#include "meniscus/io/table_text.hpp"

namespace meniscus::io {
namespace {

namespace fs = std::filesystem;

/// One row of a CSV file and where it lies in the text.
struct Record {
  std::vector<std::string> cells;
  std::size_t begin = 0, end = 0;  ///< the line break included
  int line = 0;                    ///< of its first character, from 1
  bool is_ended = false;           ///< by a line break
};

/// The record that begins at `begin`: cells between commas, a cell in quotes may hold commas, line
/// breaks and doubled quotes (RFC 4180).
Record parse_record(std::string_view text, std::size_t begin, int line) {
  Record record{.cells = {""}, .begin = begin, .end = begin, .line = line};
  bool is_quoted = false;
  while (record.end < text.size() && !record.is_ended) {
    const char c = text[record.end++];
    std::string& cell = record.cells.back();
    const bool is_doubled = record.end < text.size() && text[record.end] == '"';
    if (c == '"' && is_quoted && is_doubled) {
      cell += text[record.end++];
    } else if (c == '"') {
      is_quoted = !is_quoted;
    } else if (c == ',' && !is_quoted) {
      record.cells.emplace_back();
    } else if (c == '\n' && !is_quoted) {
      record.is_ended = true;
    } else if (c != '\r' || is_quoted) {
      cell += c;
    }
  }
  return record;
}

/// Whether lines between records may be empty or comments, which begin with `#`.
enum class Lines { of_records, with_comments };

std::size_t end_of_line(std::string_view text, std::size_t begin) {
  const std::size_t line_break = text.find('\n', begin);
  return line_break == std::string_view::npos ? text.size() : line_break + 1;
}

bool is_comment(std::string_view line) {
  return line.starts_with('#') || line.find_first_not_of(" \t\r\n") == std::string_view::npos;
}

/// All records; a last line cut short (no line break, and not as many cells as the first) is left
/// out. Throws InvalidInput at any other row whose number of cells differs from the first's.
std::vector<Record> parse_records(const fs::path& path, std::string_view text,
                                  Lines lines = Lines::of_records) {
  std::vector<Record> records;
  int line = 1;
  for (std::size_t at = 0; at < text.size();) {
    if (const std::size_t end = end_of_line(text, at);
        lines == Lines::with_comments && is_comment(text.substr(at, end - at))) {
      at = end;
      ++line;
      continue;
    }
    Record record = parse_record(text, at, line);
    const std::string_view raw = text.substr(at, record.end - at);
    line += static_cast<int>(std::ranges::count(raw, '\n'));
    at = record.end;
    const std::size_t expected = records.empty() ? record.cells.size() : records[0].cells.size();
    if (!record.is_ended && raw.find('\n') != std::string_view::npos)
      reject_input("{}:{}: a quotation mark is not closed", path.string(), record.line);
    if (record.cells.size() != expected) {
      if (!record.is_ended) break;
      reject_input("{}:{}: {} cells where the header has {}", path.string(), record.line,
                   record.cells.size(), expected);
    }
    records.push_back(std::move(record));
  }
  if (records.empty()) reject_input("{}: is empty; a header line is missing", path.string());
  return records;
}

std::string quoted_text(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result(1, '"');
  for (const char c : text) result.append(c == '"' ? 2 : 1, c);
  result += '"';
  return result;
}

struct CellText {
  std::string operator()(std::monostate) const { return {}; }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(double value) const { return fmt::format("{}", value); }
  std::string operator()(const std::string& value) const { return quoted_text(value); }
};

std::string header_line(const std::vector<std::string>& columns) {
  MENISCUS_ASSERT(!columns.empty(), "a table without columns");
  std::string line;
  for (const std::string& column : columns) line += quoted_text(column) + ',';
  line.back() = '\n';
  return line;
}

std::size_t step_column(const fs::path& path, const std::vector<std::string>& columns) {
  const auto found = std::ranges::find(columns, "step");
  if (found == columns.end()) reject_input("{}: has no column `step`", path.string());
  return static_cast<std::size_t>(found - columns.begin());
}

std::optional<std::int64_t> whole_number(const std::string& cell) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
  if (error != std::errc() || end != cell.data() + cell.size()) return std::nullopt;
  return number;
}

std::int64_t parse_step(const fs::path& path, const Record& record, std::size_t column) {
  const auto step = whole_number(record.cells[column]);
  if (!step)
    reject_input("{}:{}: step = `{}` is not a whole number", path.string(), record.line,
                 record.cells[column]);
  return *step;
}

/// The text up to the first row with `step` ≥ first_step.
std::string rows_before(const fs::path& path, const std::vector<std::string>& columns,
                        std::int64_t first_step) {
  const std::string text = read_file(path);
  const std::vector<Record> records = parse_records(path, text);
  if (records[0].cells != columns) {
    std::string expected = header_line(columns);
    expected.pop_back();
    reject_input("{}:1: the header is not `{}`", path.string(), expected);
  }
  const std::size_t column = step_column(path, columns);
  std::size_t kept = records[0].end, i = 1;
  for (; i < records.size(); ++i) {
    if (!records[i].is_ended || parse_step(path, records[i], column) >= first_step) break;
    kept = records[i].end;
  }
  for (; i < records.size() && records[i].is_ended; ++i)
    if (const auto step = whole_number(records[i].cells[column]); step && *step < first_step)
      reject_input("{}:{}: step = {} comes after step {} or a later one", path.string(),
                   records[i].line, *step, first_step);
  return text.substr(0, kept);
}

}  // namespace

std::string csv_line(const std::vector<Cell>& row) {
  MENISCUS_ASSERT(!row.empty(), "a row without cells");
  std::string line;
  for (const Cell& cell : row) line += std::visit(CellText{}, cell) + ',';
  line.back() = '\n';
  return line;
}

TableWriter::TableWriter(fs::path path, const std::vector<std::string>& columns)
    : path_(std::move(path)), num_columns_(columns.size()), file_(path_, std::ios::binary) {
  append(header_line(columns));
}

TableWriter::TableWriter(fs::path path, const std::vector<std::string>& columns,
                         std::int64_t first_step)
    : path_(std::move(path)), num_columns_(columns.size()) {
  write_file(path_, rows_before(path_, columns, first_step));
  file_.open(path_, std::ios::binary | std::ios::app);
}

void require_rows(const fs::path& path, const std::vector<std::string>& columns,
                  std::int64_t first_step) {
  (void)rows_before(path, columns, first_step);
}

void TableWriter::add(const std::vector<Cell>& row) {
  MENISCUS_ASSERT(row.size() == num_columns_, "{} cells for {} columns", row.size(), num_columns_);
  append(csv_line(row));
}

void TableWriter::append(const std::string& line) {
  std::error_code ignored;
  const std::uintmax_t size_before = fs::file_size(path_, ignored);
  errno = 0;
  file_ << line << std::flush;
  if (file_) return;
  const int error = errno != 0 ? errno : EIO;
  file_.close();
  // A row written in part is cut off again, where there is a file to cut.
  if (fs::is_regular_file(path_, ignored)) fs::resize_file(path_, size_before, ignored);
  fail_writing(path_, error);
}

std::optional<std::size_t> Table::find(const std::string& column) const {
  const auto found = std::ranges::find(columns, column);
  if (found == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns.begin());
}

std::size_t Table::index_of(const std::string& name) const {
  const std::optional<std::size_t> index = find(name);
  if (!index) reject_input("the table has no column `{}`", name);
  return *index;
}

std::vector<double> Table::column(const std::string& name) const {
  const std::size_t index = index_of(name);
  std::vector<double> values;
  for (const std::vector<std::string>& row : rows) {
    MENISCUS_ASSERT(index < row.size(), "{} cells for {} columns", row.size(), columns.size());
    const std::string& cell = row[index];
    double value = 0.0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    const bool is_number = error == std::errc() && end == cell.data() + cell.size();
    values.push_back(is_number ? value : std::numeric_limits<double>::quiet_NaN());
  }
  return values;
}

namespace {

Table table_of(std::vector<Record> records) {
  Table table{.columns = std::move(records[0].cells), .rows = {}};
  for (std::size_t i = 1; i < records.size(); ++i) {
    table.rows.push_back(std::move(records[i].cells));
  }
  return table;
}

}  // namespace

Table read_table(const fs::path& path) {
  std::vector<Record> records = parse_records(path, read_file(path));
  // The cells of a last line may all be there and its last number cut short all the same.
  if (records.size() > 1 && !records.back().is_ended) records.pop_back();
  return table_of(std::move(records));
}

Table read_commented_table(const fs::path& path) {
  return parse_commented_table(path.string(), read_file(path));
}

Table parse_commented_table(const std::string& name, std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";  // of spreadsheets
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  return table_of(parse_records(name, text, Lines::with_comments));
}

}  // namespace meniscus::io
