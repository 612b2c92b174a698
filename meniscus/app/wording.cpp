#include "meniscus/app/wording.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "meniscus/core/error.hpp"
#include "meniscus/core/log.hpp"

namespace meniscus {
namespace {

std::string id_list(std::span<const int> ids) { return fmt::format("{}", fmt::join(ids, ", ")); }

/// Makes the text of each kind of notice at time t.
struct Wording {
  double t;

  std::string operator()(const RefusedStep& step) const {
    return fmt::format("step {} of length {:.3g} failed: {}", step.step, step.dt, step.why);
  }
  std::string operator()(const InterfaceRemesh& done) const {
    if (!done.ok())
      return fmt::format("drop {} was not remeshed at t = {:.6g}: {}", done.drop, t, done.text());
    const std::string what =
        done.smoothed_over > 0.0
            ? fmt::format("drop {} was smoothed over {:.4g}", done.drop, done.smoothed_over)
            : fmt::format("creases of drop {} were rounded", done.drop);
    return fmt::format("t = {:.6g}: {}, {} holes through it closed, to remesh it", t, what,
                       done.closed_holes);
  }
  std::string operator()(const FailedSurgery& failed) const {
    return fmt::format("t = {:.6g}: {}", t, failed.why);
  }
  std::string operator()(const FailedSolver& failed) const {
    return fmt::format("t = {:.6g}: {}", t, failed.why);
  }
  std::string operator()(const LargeVolumeShift& shift) const {
    return fmt::format(
        "t = {:.6g}: restoring the volume shifts a vertex by {:.2g} of its edges, and by as much "
        "after a shorter step",
        t, shift.over_edge);
  }
  std::string operator()(const FlowJump& jump) const {
    return fmt::format(
        "the flow jumps at t = {:g}, and the liquids have inertia: a ramp would be smoother",
        jump.time);
  }
  std::string operator()(const LeftCenter& left) const {
    return fmt::format(
        "t = {:.6g}: the drops are {:.3g} R0 from where they began, an unstable place in this "
        "flow{}",
        t, left.distance,
        left.may_be_followed ? "; domain.frame = \"drops\" moves the domain along" : "");
  }
};

}  // namespace

std::string text_of(const Notice& notice) { return std::visit(Wording{notice.t}, notice.what); }

std::string text_of(const TopologyEvent& event, double t) {
  MENISCUS_ASSERT(
      event.kind == EventKind::breakup ? event.neck_radius.has_value() : event.gap.has_value(),
      "an event without its width");
  const auto [kind, size, what] =
      event.kind == EventKind::breakup
          ? std::tuple("breakup", *event.neck_radius, "a neck of radius")
          : std::tuple("coalescence", *event.gap, "a gap of");
  return fmt::format("{} at t = {:.6g}: drop {} -> {}, at {} {:.3g} near ({:.4g}, {:.4g}, {:.4g})",
                     kind, t, id_list(event.parents), id_list(event.children), what, size,
                     event.position.x(), event.position.y(), event.position.z());
}

void log_growth(const FieldExcess& before, const FieldExcess& now, double t) {
  constexpr double kLeast = 1e-9;
  const double old = std::max(before.above, before.below), size = std::max(now.above, now.below);
  if (size < kLeast || std::ilogb(size) <= std::ilogb(old)) return;
  log::info("t = {:.6g}: to keep its amount a field left the range of its values by {:.3g}", t,
            size);
}

void log_notice(const Notice& notice) {
  if (std::holds_alternative<RefusedStep>(notice.what))
    log::warning("{}; trying a shorter one", text_of(notice));
  else if (std::holds_alternative<InterfaceRemesh>(notice.what) ||
           std::holds_alternative<LargeVolumeShift>(notice.what) ||
           std::holds_alternative<FlowJump>(notice.what) ||
           std::holds_alternative<LeftCenter>(notice.what))
    log::warning("{}", text_of(notice));
}

}  // namespace meniscus
