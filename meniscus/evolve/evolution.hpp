#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "meniscus/core/fault.hpp"
#include "meniscus/evolve/interface_motion.hpp"
#include "meniscus/evolve/notices.hpp"
#include "meniscus/evolve/options.hpp"
#include "meniscus/evolve/rows.hpp"
#include "meniscus/evolve/scalar_motion.hpp"
#include "meniscus/evolve/state.hpp"
#include "meniscus/evolve/step_control.hpp"
#include "meniscus/evolve/time_schemes.hpp"
#include "meniscus/evolve/volume_restoration.hpp"

namespace meniscus {

/// The time evolution of a state: a flow solver gives the velocity of the interfaces, and remeshing
/// keeps them fit. Between calls the state is at t_k with interfaces remeshed and the mesh made.
/// The order of calls is prepare (or load), then solve, advance, solve, advance… A call that
/// returns a fault has already tried its fallbacks.
class Evolution {
 public:
  /// `mesh` is given where the flow solver needs one, `scalars` where the scene has bulk scalars.
  Evolution(Scene scene, const EvolutionOptions& options, std::unique_ptr<FlowSolver> flow,
            std::optional<MovingMesh> mesh = std::nullopt,
            std::unique_ptr<ScalarSolver> scalars = nullptr);

  /// Remeshes the initial interfaces and makes the mesh: step 0.
  Report prepare();
  /// Solves the flow at t_k (first line of the paper's Table 1).
  Report solve();
  /// Advances from t_k to t_{k+1} (the rest of Table 1). A failed step is undone and retried at
  /// half its length, or as its error asks, down to `min_step`.
  Report advance();

  [[nodiscard]] const State& state() const { return state_; }
  [[nodiscard]] double t() const { return state_.t; }
  [[nodiscard]] std::int64_t step() const { return state_.step; }
  [[nodiscard]] const Scene& scene() const { return state_.scene; }
  /// What the interfaces' vertices stand for.
  [[nodiscard]] SurfaceShape surface_shape() const { return options_.surface; }
  [[nodiscard]] bool is_finished() const { return state_.t >= options_.end; }
  /// The flow at t_k, and the velocity ẋ = n n·v of the interfaces' vertices at t_k.
  [[nodiscard]] const FlowSolution& flow() const { return first_.flow; }
  [[nodiscard]] const InterfaceMotion& motion() const { return first_.motion; }
  /// The topology events of the step that led to t_k.
  [[nodiscard]] const std::vector<TopologyEvent>& events() const { return state_.events; }
  /// All notices to the user so far.
  [[nodiscard]] const std::vector<Notice>& notices() const { return notices_; }
  /// Sets a function that receives each notice at once.
  void set_listener(NoticeListener listener) { listener_ = std::move(listener); }
  /// Seconds that the evolution, its mesh and its solver spent in a phase.
  [[nodiscard]] double seconds_in(const std::string& phase) const;

  /// The length with which the next step is tried first.
  [[nodiscard]] double step_length() const { return step_plan(state_, options_).dt; }

  /// The rows of history.csv and drops.csv after the last solve. The processes of the options share
  /// the measures; the first of them alone has the drops. Collective.
  [[nodiscard]] Rows rows() const;
  /// The drops of `rows`, on any process.
  [[nodiscard]] std::vector<DropRow> moving_drop_rows() const;
  /// Those of drops.csv alone, which need no flow.
  [[nodiscard]] std::vector<DropRow> drop_rows() const;

  /// Sets the carried fields of every interface, or of the mesh, and replaces earlier ones
  /// (docs/fields.md). Throws InvalidInput naming what does not fit.
  void set_interface_fields(std::vector<SurfaceFields> fields);
  void set_bulk_fields(VolumeFields fields);

  /// Replaces the imposed flow and the conditions on the outer boundary by those of a scene with
  /// the same boundary. A solve must follow.
  void set_surroundings(const Scene& surroundings);

  /// Saves the state before the solve at t_k, bit for bit.
  void save(Archive& archive) const;
  void load(const Archive& archive);

 private:
  Report try_step(const Scene& start, double dt);
  StageFlow time_scheme_step(const Scene& start, double dt);
  StageFlow solve_stage(const Scene& start, const StageFlow& stage, double duration,
                        const Instant& instant, const ImplicitStage* implicit = nullptr);
  [[nodiscard]] FlowDomain domain_of(const Scene& scene, const TetMesh& mesh) const;
  InterfaceNormals normals();
  StageFlow flow_at(const Instant& instant, const ImplicitStage* implicit = nullptr);
  Report finish_step(const Scene& start, const StageFlow& whole, double dt);
  Report move_whole_step(const Scene& start, const StageFlow& whole, double dt);
  void move_surfactant(const Scene& start, const StageFlow& stage, double duration);
  ScalarAdvance move_scalars(const Scene& start, const FlowSolution& flow, double duration);
  Report judge_scalars(const ScalarAdvance& moved);
  Report exchange_with_liquids(const Scene& start, const StageFlow& whole, double dt);
  Report judge_motion(const Scene& start, const StageFlow& whole, double dt);
  void report_refusal(double dt, const Fault& fault);
  void accept_step(const StepPlan& plan);
  void notice_departure();
  Report carry_fields_of_mesh(const Scene& start, const Scene& moved, const StageFlow& whole,
                              double dt);
  Report follow_interfaces(const Scene& before, double t, const RegionSources& sources = {});
  [[nodiscard]] Report move_mesh(const Scene& start, const InterfaceMotion& motion,
                                 const FlowSolution& flow, double dt);
  [[nodiscard]] bool is_remesh_due();
  [[nodiscard]] bool is_remeshed_as_needed() const { return options_.remesh_every == 0; }
  Report keep_mesh(const Scene& start, const FlowSolution& flow, double dt);
  bool remesh_interfaces();
  bool remesh_interfaces(std::span<const std::size_t> interfaces);
  Report refuse_contact(bool are_remeshed);
  Report change_topology(const Scene& moved, const InterfaceMotion& motion);
  void restore_volumes();
  Report judge_volume_shift(double dt);
  FlowSolution solve_flow(const Instant& instant, const ImplicitStage* implicit = nullptr);
  [[nodiscard]] std::vector<ScalarMeasures> scalar_measures() const;
  template <class Make>
  auto measured(const Make& make) const;
  void give_notice(Notice notice);
  template <class What>
  void give_notice(What what) {
    give_notice(Notice{.t = state_.t, .what = std::move(what)});
  }

  EvolutionOptions options_;
  std::unique_ptr<FlowSolver> solver_;
  std::unique_ptr<ScalarSolver> scalar_solver_;  // null where there are no bulk scalars
  State state_;
  BulkScalars start_scalars_;                       // of the step from t_k
  std::vector<VertexField<double>> start_species_;  // of the same (`species_beside`)
  std::int64_t last_connectivity_ =
      0;                       // largest number given so far; undone steps do not free theirs
  StageFlow first_;            // the flow and n n·v at t_k
  mutable PhaseTimes times_;   // times are not part of the state
  StepRecord attempt_;         // of the attempt at the step from t_k
  ShiftJudge shift_judge_;     // judges the attempts at the step from t_k
  mutable Carriers carriers_;  // of the surfactants: what they hold follows from the meshes
  std::vector<Notice> notices_;
  NoticeListener listener_;
};

}  // namespace meniscus
