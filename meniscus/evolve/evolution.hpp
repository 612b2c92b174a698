#pragma once

#include <memory>
#include <string>
#include <vector>

#include "meniscus/evolve/interface_motion.hpp"
#include "meniscus/evolve/options.hpp"
#include "meniscus/evolve/record.hpp"
#include "meniscus/flow/flow_solver.hpp"
#include "meniscus/mesh/surface_tree.hpp"

namespace meniscus {

/// How a part of the evolution ended; a failure has already been retried with less ambition.
struct [[nodiscard]] EvolutionReport {
  bool ok = true;
  std::string failure;
  bool is_final = false;  ///< no shorter step would do: what comes must not happen
};

/// A scene that evolves in time: its interfaces move with the velocity a flow solver gives, and are
/// kept fit for the next step. Between calls it stands at t_k with interfaces remeshed and the
/// solver's mesh made; the order of calls is prepare (or load), then solve, advance, solve,
/// advance…
class Evolution {
 public:
  Evolution(Scene scene, const EvolutionOptions& options, std::unique_ptr<FlowSolver> flow);

  /// Remeshes the initial interfaces and makes the solver's mesh: step 0.
  EvolutionReport prepare();
  /// The flow at t_k (first line of the paper's Table 1).
  EvolutionReport solve();
  /// From t_k to t_{k+1}: the rest of Table 1. A step that fails is undone and tried at half the
  /// length, down to `min_step`.
  EvolutionReport advance();

  [[nodiscard]] double t() const { return t_; }
  [[nodiscard]] std::int64_t step() const { return step_; }
  [[nodiscard]] bool is_finished() const { return t_ >= options_.end; }
  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const FlowSolver& flow() const { return *flow_; }
  [[nodiscard]] const InterfaceMotion& motion() const { return motion_; }
  [[nodiscard]] const PhaseTimes& times() const { return times_; }
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

  /// The changes of topology in the step that led to t_k.
  [[nodiscard]] const std::vector<TopologyEvent>& events() const { return events_; }

  /// Δt = step_factor · min(1, 1/tension) · l_min within its bounds, for the shapes as they are.
  [[nodiscard]] double step_length() const;

  /// The rows of the last solve.
  [[nodiscard]] HistoryRow history_row() const;
  [[nodiscard]] std::vector<DropRow> drop_rows() const;

  /// The state before the solve at t_k, bit for bit.
  void save(Archive& archive) const;
  void load(const Archive& archive);

 private:
  EvolutionReport try_step(double dt);
  EvolutionReport finish_step(const Scene& start, const InterfaceMotion& motion, double dt);
  [[nodiscard]] bool is_remesh_due() const { return (step_ + 1) % options_.remesh_every == 0; }
  [[nodiscard]] std::vector<SurfaceTree> trees_for_gaps() const;
  bool remesh_interfaces();
  [[nodiscard]] EvolutionReport refuse_touching(bool are_remeshed) const;
  EvolutionReport change_topology(const Scene& moved, const InterfaceMotion& motion);
  void restore_volumes();
  FlowReport solve_flow(double t);

  Scene scene_;
  EvolutionOptions options_;
  std::unique_ptr<FlowSolver> flow_;
  Vec3 centroid_;  // of the drops at the start
  double t_ = 0.0;
  double dt_ = 0.0;
  std::int64_t step_ = 0;
  InterfaceMotion motion_;          // n n·v at t_k
  std::vector<double> correction_;  // per interface: largest shift that restored its volume
  std::vector<TopologyEvent> events_;
  int iterations_ = 0;        // linear iterations since the last row
  mutable PhaseTimes times_;  // the clock is no part of the state
  std::vector<std::string> warnings_;
};

}  // namespace meniscus
