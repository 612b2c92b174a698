#include "meniscus/volume/tetgen_assertions.hpp"

#include <cstdlib>
#include <string>

#include <dlfcn.h>

namespace meniscus {
namespace {

thread_local int throwing = 0;

}  // namespace

TetgenAssertionsThrow::TetgenAssertionsThrow() { ++throwing; }
TetgenAssertionsThrow::~TetgenAssertionsThrow() { --throwing; }

}  // namespace meniscus

/// What assert() calls, in the place of the C library's. This file must not include <assert.h>,
/// whose declaration promises that nothing is thrown.
// NOLINTNEXTLINE(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
extern "C" [[noreturn]] void __assert_fail(const char* assertion, const char* file,
                                           unsigned int line, const char* function) {
  if (meniscus::throwing > 0)
    throw meniscus::TetgenAssertion(std::string("its assertion ") + assertion + " does not hold");
  using Fail = void (*)(const char*, const char*, unsigned int, const char*);
  if (const auto next = reinterpret_cast<Fail>(dlsym(RTLD_NEXT, "__assert_fail")))
    next(assertion, file, line, function);
  std::abort();
}
