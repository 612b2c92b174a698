#include "meniscus/io/run_files.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>

#include <fmt/format.h>

namespace meniscus::io {
namespace {

constexpr std::string_view kPrefix = "checkpoint-", kSuffix = ".h5";

/// The step in the name of a checkpoint; none for another name.
std::optional<std::int64_t> checkpoint_step(const std::string& name) {
  if (!name.starts_with(kPrefix) || !name.ends_with(kSuffix)) return std::nullopt;
  std::int64_t step = 0;
  const char *begin = name.data() + kPrefix.size(),
             *end = name.data() + name.size() - kSuffix.size();
  const auto [stopped, error] = std::from_chars(begin, end, step);
  return error == std::errc() && stopped == end ? std::optional(step) : std::nullopt;
}

}  // namespace

std::string checkpoint_name(std::int64_t step) {
  return fmt::format("{}{:06}{}", kPrefix, step, kSuffix);
}

std::vector<std::pair<std::int64_t, std::filesystem::path>> checkpoints(
    const std::filesystem::path& folder) {
  std::vector<std::pair<std::int64_t, std::filesystem::path>> found;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
    if (const auto step = checkpoint_step(entry.path().filename().string()))
      found.emplace_back(*step, entry.path());
  std::ranges::sort(found);
  return found;
}

}  // namespace meniscus::io
