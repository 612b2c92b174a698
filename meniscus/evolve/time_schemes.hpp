#pragma once

#include <functional>
#include <numbers>
#include <optional>
#include <span>

#include "meniscus/evolve/chebyshev.hpp"
#include "meniscus/evolve/interface_motion.hpp"
#include "meniscus/evolve/shape_motion.hpp"
#include "meniscus/evolve/surfactant_motion.hpp"
#include "meniscus/evolve/wave_damping.hpp"
#include "meniscus/flow/flow_solver.hpp"

namespace meniscus {

/// The flow at one stage of a step, and the velocity with which it moves the interfaces' vertices.
struct StageFlow : Report {
  FlowSolution flow = {};
  /// Of a whole step: the velocity in the bulk that carries scalars, where it is not that of
  /// `flow`. It is the mean over the step, of the order of the scheme.
  std::optional<FlowSolution> carrier = {};
  InterfaceMotion motion = {};
  InterfaceNormals normals = {};   ///< n at the vertices
  NormalSpeeds normal_speed = {};  ///< n·v at the vertices
  /// What `motion` is made of; empty where the scheme moves vertices along normals alone.
  ShapeMotion shape = {};
  SurfactantTransport surfactant = {};  ///< at this instant
  /// With which the amounts of surfactant change where the vertices move with `motion`.
  AmountRates amount_rates = {};
  /// Σ tension · dS/dt of the triangulations as they move at this stage. Of a whole step it is the
  /// mean over the step, of the order of the scheme [μ_out G² R0³].
  double surface_rate = 0.0;
  /// Whether the scheme damps waves faster than it resolves, so that it is stable at any step.
  bool damps_waves = false;
  double error = 0.0;  ///< of a whole step: the estimate of `step_error`; 0 where there is none
};

/// A step of length dt from t; `start` is the scene at t.
struct Step {
  const Scene& start;
  double t = 0.0;
  double dt = 0.0;
  Carriers& carriers;  ///< of the surfactants
  /// c of the species beside soluble ones at t (`species_beside`); empty where none is soluble.
  std::span<const VertexField<double>> species = {};
};
/// The way on which a motion takes the surfactants for `duration`.
[[nodiscard]] SurfactantPath surfactant_path(const Step& step, const InterfaceMotion& motion,
                                             double duration);

/// Moves the interfaces `duration` from where the step began, with the motion of a stage and the
/// mesh with them, and solves the flow there.
using StageSolver =
    std::function<StageFlow(const StageFlow& stage, double duration, const Instant& instant)>;

/// The same for an implicit stage of liquids with inertia.
using ImplicitSolver =
    std::function<StageFlow(const StageFlow& stage, double duration, const Instant& instant,
                            const ImplicitStage& implicit)>;

/// Damps the normal speeds that the shapes of a stage have beyond their rigid motions about others,
/// where the stage's interfaces are.
using StageDamper = std::function<void(StageFlow& stage, const NormalSpeeds& about)>;
/// What tension would change in a duration (`damped_speeds`). A rigid motion meets no resistance
/// of it.
void damp(StageFlow& stage, const Scene& scene, const NormalSpeeds& about, const Damping& damping);
/// What tension changes in an implicit stage (`expected_speeds`).
void slow_down(StageFlow& stage, const Scene& scene, const NormalSpeeds& about, double duration);

/// Damps rates of concentrations along a path about others, by the viscosities of a stage.
using ConcentrationDamper = std::function<ConcentrationRates(
    const StageFlow& stage, const SurfactantPath& path, const ConcentrationRates& rates,
    const ConcentrationRates& about)>;
/// What the elasticity would change in a duration (`damped_concentration_rates`).
[[nodiscard]] ConcentrationRates damped(const StageFlow& stage, const SurfactantPath& path,
                                        const ConcentrationRates& rates,
                                        const ConcentrationRates& about, const Damping& damping);

/// How a step is damped.
struct StageDampers {
  StageDamper speeds;
  ConcentrationDamper concentrations;
};

// One step: the stage whose motion takes the interfaces from the step's beginning to its end.
// `first` is the flow at t.

/// Explicit, of first order. There is no estimate.
[[nodiscard]] StageFlow euler_step(const StageFlow& first, const Step& step);
/// The midpoint rule (first lines of Table 1 of hooper2001).
[[nodiscard]] StageFlow midpoint_step(const StageFlow& first, const Step& step,
                                      const StageSolver& solve);
/// The midpoint rule, both of whose stages are damped: of second order whatever the damping is
/// (docs/time-stepping.md).
[[nodiscard]] StageFlow semi_implicit_step(const StageFlow& first, const Step& step,
                                           const StageSolver& solve, const StageDampers& damp);
/// Liquids with inertia: diagonally implicit, of second order, with γ = 1 − 1/√2 at both of its
/// stages, γΔt and Δt after t (alexander1977). It damps what is fast. The velocity at the end is
/// that of the second stage, at the mesh that the motion expected of it leads to. The interfaces go
/// on to where its own leads. `expect` slows expected speeds by what tension will do in a stage.
/// Surfactants go with the transport of the stages, in the shares that the motion takes them.
[[nodiscard]] StageFlow implicit_step(const StageFlow& first, const Step& step,
                                      const ImplicitSolver& solve, const StageDamper& expect);
/// γ.
inline constexpr double kImplicitShare = 1.0 - 0.5 * std::numbers::sqrt2;

/// Runge–Kutta–Chebyshev (chebyshev.hpp). The motion of first order that the
/// estimate takes is the line through the stage j next to the middle, at c_j of the step. It is its
/// difference over 1 − c_j. Short waves, which the stages damp, enter it at no more than a few
/// times their height.
[[nodiscard]] StageFlow chebyshev_step(const StageFlow& first, const Step& step,
                                       const ChebyshevScheme& scheme, const StageSolver& solve);

/// max_v dt |n·v − n·v*| / l_v over all vertices, l_v the shortest edge at the vertex when the step
/// began. This is how far steps of second and of first order take a vertex apart along its normal,
/// in edges. What takes a drop apart from itself as a whole is measured in the mean edge of the
/// scene's coarsest drop. It is its own radius if that is less. The path of a satellite need not be
/// known better than that of its parents. The result is Δt²|n·ẍ|/2 to leading order. The error of
/// the step, of third order, is smaller; that at a fixed time is proportional to it.
[[nodiscard]] double step_error(const Step& step, const NormalSpeeds& second,
                                const NormalSpeeds& first);

}  // namespace meniscus
