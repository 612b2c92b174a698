#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace meniscus {

/// Named flat arrays: the state of a part of a run, on its way to or from a checkpoint.
/// Names are paths such as "flow/guess/velocity".
struct Archive {
  std::map<std::string, std::vector<double>> reals;
  std::map<std::string, std::vector<std::int64_t>> integers;
  std::map<std::string, std::string> texts;
};

}  // namespace meniscus
