#pragma once

#include <stdexcept>

namespace meniscus {

/// An assertion of TetGen's that does not hold: a bug there, which points in special positions
/// bring out (coplanar and cospherical ones, as on a box).
struct TetgenAssertion : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// While one lives, a failed assert() of a C library throws TetgenAssertion in this thread instead
/// of ending the program: Debian's TetGen is built with its assertions on, and a run must outlive
/// them.
class TetgenAssertionsThrow {
 public:
  TetgenAssertionsThrow();
  TetgenAssertionsThrow(const TetgenAssertionsThrow&) = delete;
  TetgenAssertionsThrow& operator=(const TetgenAssertionsThrow&) = delete;
  ~TetgenAssertionsThrow();
};

}  // namespace meniscus
