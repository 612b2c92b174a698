#pragma once

#include "meniscus/linear/communicator.hpp"

namespace meniscus::bem {

struct Options {
  double rtol = 1e-6;         ///< relative residual of the double layer's equation
  int max_iterations = 2000;  ///< of GMRES
  // Results depend on neither of these, to the last bit.
  int threads = 1;
  linear::Processes processes = linear::Processes::alone;
};

}  // namespace meniscus::bem
