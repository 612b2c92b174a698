#include "meniscus/core/error.hpp"

#include <cstdio>
#include <cstdlib>

namespace meniscus {

void fail_assertion(const char* expression, const char* file, int line, const std::string& values) {
  std::fputs(
      fmt::format("{}:{}: broken invariant: {} [{}]\n", file, line, expression, values).c_str(),
      stderr);
  std::abort();
}

}  // namespace meniscus
