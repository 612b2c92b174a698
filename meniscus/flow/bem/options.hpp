#pragma once

namespace meniscus::bem {

struct Options {
  double rtol = 1e-6;         ///< relative residual of the double layer's equation
  int max_iterations = 2000;  ///< of GMRES
  int threads = 1;            ///< results do not depend on it, to the last bit
};

}  // namespace meniscus::bem
