#pragma once

#include <string_view>

#include <fmt/format.h>

namespace meniscus::log {

/// Levels in falling order of importance; `set_level` silences all below it.
enum class Level { error, warning, info, debug, off };

void set_level(Level level);
/// Writes one line to standard error through spdlog.
void write(Level level, std::string_view text);

template <class... Args>
void warning(fmt::format_string<Args...> format, Args&&... args) {
  write(Level::warning, fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args>
void info(fmt::format_string<Args...> format, Args&&... args) {
  write(Level::info, fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args>
void debug(fmt::format_string<Args...> format, Args&&... args) {
  write(Level::debug, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace meniscus::log
