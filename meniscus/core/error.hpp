#pragma once

#include <stdexcept>
#include <string>

#include <fmt/format.h>

namespace meniscus {

/// The user's mistake in a case, a file or an option. The text is one line that names the source,
/// the given value and what is allowed. Programs end with status 2.
class InvalidInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The run could not go on (a full disk, a step that fails at every size). Programs end with
/// status 1. Numerical failures that evolution can answer are reports, not exceptions.
class RunFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

template <class... Args>
[[noreturn]] void reject_input(fmt::format_string<Args...> format, Args&&... args) {
  throw InvalidInput(fmt::format(format, std::forward<Args>(args)...));
}

[[noreturn]] void fail_assertion(const char* expression, const char* file, int line,
                                 const std::string& values);

}  // namespace meniscus

/// Our own mistake: a broken invariant. MENISCUS_ASSERT(condition, "format", values…).
/// On in `dev` builds and wherever MENISCUS_ASSERTIONS is defined.
#if defined(MENISCUS_ASSERTIONS)
#define MENISCUS_ASSERT(condition, ...)                                                          \
  do {                                                                                           \
    if (!(condition))                                                                            \
      ::meniscus::fail_assertion(#condition, __FILE__, __LINE__, ::fmt::format("" __VA_ARGS__)); \
  } while (false)
#else
#define MENISCUS_ASSERT(condition, ...) \
  do {                                  \
  } while (false)
#endif
