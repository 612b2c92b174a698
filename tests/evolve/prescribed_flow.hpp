#pragma once

#include <functional>

#include "meniscus/flow/flow_solver.hpp"

namespace meniscus {

/// A flow solver that knows the velocity everywhere: v(x, t) given. It can be told to fail.
class PrescribedFlow final : public FlowSolver {
 public:
  using Velocity = std::function<Vec3(const Vec3& x, double t)>;
  explicit PrescribedFlow(Velocity velocity) : prescribed_(std::move(velocity)) {}

  FlowSolution solve(const FlowDomain& domain, const Instant& instant) override {
    ++solves;
    if (is_broken) return failed_flow({FaultKind::no_flow, "broken"});
    if (instant.dt > longest_step) return failed_flow({FaultKind::no_flow, "moved too far"});
    FlowSolution solution;
    solution.iterations = 1;
    solution.power = Power{};
    for (const Interface& interface : domain.scene.interfaces) {
      VertexField<Vec3> v(interface.mesh.num_vertices());
      for (const VertexId i : v.ids()) v[i] = prescribed_(interface.mesh.x[i], instant.t);
      solution.velocity.push_back(std::move(v));
    }
    return solution;
  }
  void save(Archive&, const FlowDomain&) const override {}
  void load(const Archive&, const FlowDomain&) override {}
  const PhaseTimes& times() const override { return times_; }

  int solves = 0;
  double longest_step = std::numeric_limits<double>::infinity();
  bool is_broken = false;

 private:
  Velocity prescribed_;
  PhaseTimes times_;
};

}  // namespace meniscus
