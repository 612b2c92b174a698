#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "meniscus/core/error.hpp"
#include "meniscus/core/vec.hpp"

namespace meniscus::io {

/// A word as a message can show it: on one line, and not longer than a message bears.
[[nodiscard]] std::string printable(std::string_view word);

/// Reads a text line by line as words between blanks; blank lines and what follows a `#` are
/// skipped. Faults are thrown as InvalidInput "FILE:LINE: what".
class TextScanner {
 public:
  TextScanner(const std::filesystem::path& path, std::string_view text)
      : path_(path.string()), rest_(text) {}

  /// Steps to the next line with words on it; false at the end of the text.
  bool next_line();
  /// As `next_line`, but throws at the end of the text.
  void require_line(std::string_view expected);
  [[nodiscard]] const std::vector<std::string_view>& words() const { return words_; }
  /// The text after the current line.
  [[nodiscard]] std::string_view rest() const { return rest_; }

  /// The k-th word of the line as a number.
  [[nodiscard]] double real(std::size_t k) const;
  [[nodiscard]] std::int64_t integer(std::size_t k) const { return integer(word(k)); }
  [[nodiscard]] std::int64_t integer(std::string_view word) const;
  /// Words k, k + 1 and k + 2 as a point.
  [[nodiscard]] Vec3 point(std::size_t k) const { return {real(k), real(k + 1), real(k + 2)}; }

  template <class... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
    reject_input("{}:{}: {}", path_, line_, fmt::format(format, std::forward<Args>(args)...));
  }

 private:
  [[nodiscard]] std::string_view word(std::size_t k) const;

  std::string path_;
  std::string_view rest_;
  std::vector<std::string_view> words_;
  int line_ = 0;
};

/// Throws unless a face has corners enough. `source` is a TextScanner, or fails as one does.
template <class Source>
void require_corners(const Source& source, std::int64_t count) {
  if (count < 3) source.fail("a face of {} corners; a face has at least 3", count);
}

}  // namespace meniscus::io
