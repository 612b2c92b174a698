#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "meniscus/evolve/remesh_interfaces.hpp"

namespace meniscus {

/// A step that failed, was undone and is retried shorter. Attempts that error control refuses are
/// no failures, and no notices.
struct RefusedStep {
  std::int64_t step = 0;
  double dt = 0.0;
  std::string why;
};
/// A cut or a bridge that was due but not possible. The interfaces stay as they were.
struct FailedSurgery {
  std::string why;
};
/// What a solver did in another way than asked for (`FlowSolution::warnings`): a linear solver that
/// failed where another one then succeeded, or edges of interfaces that are less curved.
struct FailedSolver {
  std::string why;
};
/// Restoring the volume of a drop shifted a vertex by this fraction of its edge length, and shorter
/// steps did not help. The notice is given once.
struct LargeVolumeShift {
  double over_edge = 0.0;
};

/// The imposed flow of liquids with inertia jumps at a time: the schedule has no ramp there.
struct FlowJump {
  double time = 0.0;
};

/// The drops' common centroid has gone this far [R0] from its first place. The imposed flow takes
/// what is off its centre further away. The notice is given once.
struct LeftCenter {
  double distance = 0.0;
  bool may_be_followed = true;  ///< by domain.frame, which fields of the bulk do not allow
};

/// Something that happened in a run and that its user should know.
struct Notice {
  double t = 0.0;
  std::variant<RefusedStep, InterfaceRemesh, FailedSurgery, FailedSolver, LargeVolumeShift,
               FlowJump, LeftCenter>
      what;
};

/// A function that receives each notice.
using NoticeListener = std::function<void(const Notice&)>;

}  // namespace meniscus
