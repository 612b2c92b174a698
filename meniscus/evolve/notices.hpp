#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "meniscus/evolve/remesh_interfaces.hpp"

namespace meniscus {

/// A step that was undone, to be tried again at half its length.
struct RefusedStep {
  std::int64_t step = 0;
  double dt = 0.0;
  std::string why;
};
/// A cut or a bridge that was due and could not be carried out: the place is left as it was.
struct FailedSurgery {
  std::string why;
};
/// A linear solver that gave up; another one did not.
struct FailedSolver {
  std::string why;
};
/// Restoring the volume of a drop shifts a vertex by this part of its edges, whatever the length of
/// the step; that this is so for the steps to come is not said again.
struct LargeVolumeShift {
  double over_edge = 0.0;
};

/// What happened to a run, besides where it led, that its user should know.
struct Notice {
  double t = 0.0;
  std::variant<RefusedStep, InterfaceRemesh, FailedSurgery, FailedSolver, LargeVolumeShift> what;
};

/// Told of each notice when it is given.
using NoticeListener = std::function<void(const Notice&)>;

}  // namespace meniscus
