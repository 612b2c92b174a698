#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "meniscus/core/archive.hpp"
#include "meniscus/core/timer.hpp"
#include "meniscus/scene/scene.hpp"

namespace meniscus {

/// How a solve ended. Failure is an outcome that evolution answers, not an exception.
struct [[nodiscard]] FlowReport {
  bool ok = true;
  std::string failure;
  int iterations = 0;                      ///< linear iterations, all Newton steps together
  std::vector<std::string> warnings = {};  ///< what was done in another way than asked for
};

/// The energy books of one solution, all in [μ_out G² R0³]; power_in − dissipation is what the
/// interfaces' area gains when nothing is lost.
struct Power {
  double in =
      0.0;  ///< reaction of the outer boundary times its velocity, plus body force times velocity
  double dissipation = 0.0;  ///< ∫2μ D:D plus the stabilisation's share
};

/// What evolution asks of a flow solver, be it finite elements on a volume mesh or boundary
/// integrals on the interfaces alone. The scene's interfaces may move between calls; `rebuild` must
/// be called whenever their connectivity has changed.
class FlowSolver {
 public:
  virtual ~FlowSolver() = default;

  /// Makes whatever the solver derives from the interfaces (a volume mesh) afresh.
  virtual FlowReport rebuild(const Scene& scene) = 0;
  /// Velocity on every interface, for the interfaces as the scene has them at time t.
  virtual FlowReport solve(const Scene& scene, double t) = 0;
  /// Fluid velocity at the vertices of each interface, from the last solve [G R0].
  [[nodiscard]] virtual std::span<const VertexField<Vec3>> velocity() const = 0;
  /// Empty where the flow fills an unbounded space: its power and dissipation are infinite.
  [[nodiscard]] virtual std::optional<Power> power() const = 0;

  /// ∫2(μ(γ̇) − μ)D over the liquid of each region, μ its own viscosity: what a law adds to the
  /// stress in it [μ_out G R0³]. Empty where all liquids are Newtonian.
  [[nodiscard]] virtual std::span<const Mat3> excess_stress() const { return {}; }

  /// Remembers the derived mesh as it is at the start of a step (Ω_t of the paper's Table 1).
  virtual void mark(const Scene& scene) = 0;
  /// Carries the derived mesh from the marked state by dt under the last solution: interface
  /// vertices with `interface_motion`, the rest by the solver's own rule. The scene is the marked
  /// one (not moved yet). Not ok when a cell would be inverted; the mesh is then as marked.
  virtual FlowReport move_from_mark(const Scene& marked,
                                    std::span<const VertexField<Vec3>> interface_motion,
                                    double dt) = 0;

  /// Shortest edge of the derived mesh, or infinity where there is none.
  [[nodiscard]] virtual double shortest_mesh_edge() const = 0;
  /// The derived volume mesh, or null.
  [[nodiscard]] virtual const TetMesh* volume_mesh() const { return nullptr; }
  /// v and p at the vertices of the volume mesh, for output; empty where there is none. Pressure is
  /// given per cell corner (|C| × 4), being double valued on interfaces.
  [[nodiscard]] virtual std::span<const Vec3> mesh_velocity() const { return {}; }
  [[nodiscard]] virtual std::span<const double> corner_pressure() const { return {}; }

  /// All that is needed to go on bit for bit.
  virtual void save(Archive& archive) const = 0;
  virtual void load(const Archive& archive, const Scene& scene) = 0;

  [[nodiscard]] virtual const PhaseTimes& times() const = 0;
};

}  // namespace meniscus
