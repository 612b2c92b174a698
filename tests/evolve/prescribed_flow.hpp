#pragma once

#include <functional>

#include "meniscus/flow/flow_solver.hpp"

namespace meniscus {

/// A flow solver that knows the velocity everywhere: v(x, t) given. It can be told to fail.
class PrescribedFlow final : public FlowSolver {
 public:
  using Velocity = std::function<Vec3(const Vec3& x, double t)>;
  explicit PrescribedFlow(Velocity velocity) : prescribed_(std::move(velocity)) {}

  FlowReport rebuild(const Scene& scene) override {
    ++rebuilds;
    return scene.interfaces.size() < fewest_drops ? FlowReport{false, "too few drops", 0}
                                                  : answer();
  }
  FlowReport solve(const Scene& scene, double t) override {
    ++solves;
    velocity_.clear();
    for (const Interface& interface : scene.interfaces) {
      VertexField<Vec3> v(interface.mesh.num_vertices());
      for (const VertexId i : v.ids()) v[i] = prescribed_(interface.mesh.x[i], t);
      velocity_.push_back(std::move(v));
    }
    return answer();
  }
  std::span<const VertexField<Vec3>> velocity() const override { return velocity_; }
  std::optional<Power> power() const override { return Power{}; }
  void mark(const Scene&) override {}
  FlowReport move_from_mark(const Scene&, std::span<const VertexField<Vec3>>, double dt) override {
    return dt > longest_move ? FlowReport{false, "moved too far", 0} : FlowReport{};
  }
  double shortest_mesh_edge() const override { return std::numeric_limits<double>::infinity(); }
  void save(Archive&) const override {}
  void load(const Archive&, const Scene&) override {}
  const PhaseTimes& times() const override { return times_; }

  int rebuilds = 0, solves = 0;
  double longest_move = std::numeric_limits<double>::infinity();
  std::size_t fewest_drops = 0;  ///< that it makes a mesh of
  bool is_broken = false;

 private:
  [[nodiscard]] FlowReport answer() const {
    return is_broken ? FlowReport{false, "broken", 0} : FlowReport{true, "", 1};
  }

  Velocity prescribed_;
  std::vector<VertexField<Vec3>> velocity_;
  PhaseTimes times_;
};

}  // namespace meniscus
