#include "meniscus/io/text_scanner.hpp"

#include <algorithm>
#include <charconv>
#include <system_error>

namespace meniscus::io {
namespace {

constexpr std::string_view blanks = " \t\r\v\f";

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> words;
  line = line.substr(0, line.find('#'));
  for (std::size_t at = line.find_first_not_of(blanks); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(blanks, end);
  }
  return words;
}

/// Whether the whole word is a number; "+1.5" is one too.
template <class T>
bool parse_number(std::string_view word, T& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

}  // namespace

std::string printable(std::string_view word) {
  constexpr std::size_t longest = 40;  // leaves room on a line of 80 for the file's name
  std::string text(word.substr(0, longest));
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' ' || c > '~'; }, '?');
  return word.size() > longest ? text + "..." : text;
}

bool TextScanner::next_line() {
  while (!rest_.empty()) {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size() - 1) + 1;
    words_ = split(rest_.substr(0, rest_[end - 1] == '\n' ? end - 1 : end));
    rest_.remove_prefix(end);
    ++line_;
    if (!words_.empty()) return true;
  }
  words_.clear();
  return false;
}

void TextScanner::require_line(std::string_view expected) {
  if (!next_line()) fail("the file ends where {} is expected", expected);
}

std::string_view TextScanner::word(std::size_t k) const {
  if (k >= words_.size()) fail("{} words where more are expected", words_.size());
  return words_[k];
}

double TextScanner::real(std::size_t k) const {
  double value = 0.0;
  if (!parse_number(word(k), value)) fail("`{}` is not a number", printable(word(k)));
  return value;
}

std::int64_t TextScanner::integer(std::string_view word) const {
  std::int64_t value = 0;
  if (!parse_number(word, value)) fail("`{}` is not a whole number", printable(word));
  return value;
}

}  // namespace meniscus::io
