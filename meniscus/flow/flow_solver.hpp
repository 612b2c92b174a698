#pragma once

#include <optional>
#include <string>
#include <vector>

#include "meniscus/core/archive.hpp"
#include "meniscus/core/timer.hpp"
#include "meniscus/flow/flow_solution.hpp"
#include "meniscus/mesh/rigid_motion.hpp"
#include "meniscus/surface/known_surfaces.hpp"
#include "meniscus/volume/moving_mesh.hpp"

namespace meniscus {

/// Where in a step a solve stands.
enum class Stage { start, middle, end };

/// When a flow is solved: at time t, in a step of length dt (0 where no step is known).
struct Instant {
  double t = 0.0;
  double dt = 0.0;
  Stage stage = Stage::start;
};

/// A bulk scalar of a scene on its volume mesh.
struct BulkScalar {
  /// T at the nodes of the solver's space: the vertices, then the middles of edges of quadratic
  /// elements.
  std::vector<double> values;
  double boundary_rate = 0.0;  ///< amount per time through the outer boundary, inwards [R0³ G]
  double source_rate = 0.0;    ///< amount per time of sources [R0³ G]
  double least = 0.0, largest = 0.0;  ///< of the values at the start and of those given since
  /// Amount per time that left each region, less its sources, by region [R0³ G]. It is empty where
  /// no step tells it: before the first, and after regions changed.
  std::vector<double> region_loss = {};
  friend bool operator==(const BulkScalar&, const BulkScalar&) = default;
};
/// By scalar of the scene; the rates are those of the last step.
using BulkScalars = std::vector<BulkScalar>;

/// An implicit stage in a step of liquids with inertia. At nodes that come from x̄ within the
/// duration, v = v̄ + duration ∂v/∂t, the rate being that at the stage's instant.
struct ImplicitStage {
  double duration = 0.0;         ///< [1/G]
  std::vector<Vec3> x, v;        ///< x̄ [R0] and v̄ [G R0], by node
  std::vector<Vec3> expected_v;  ///< at the stage's instant; a guess [G R0]
  /// By how much the interfaces' vertices came another way to where the stage has them than that
  /// velocity would have taken them [G R0].
  std::vector<VertexField<Vec3>> slowing;
};

/// What a flow solver is lent for a solve.
struct FlowDomain {
  const Scene& scene;
  const TetMesh* mesh = nullptr;  ///< of this scene; null for solvers that need none
  /// Names the connectivity of interfaces and mesh: as long as it is the same, so are they.
  std::int64_t connectivity = 0;
  const BulkScalars* scalars = nullptr;  ///< at this instant; null where there are none
  /// Of liquids with inertia: the flow at this instant, where it is known, or the stage that is to
  /// find it.
  const NodalFlow* known = nullptr;
  const ImplicitStage* stage = nullptr;
  KnownSurfaces* surfaces = nullptr;  ///< of the interfaces; null where none are known
};

/// A flow that was taken to a new mesh, or why it did not arrive.
struct [[nodiscard]] TransferredFlow : Report {
  NodalFlow flow = {};
  double momentum_lost = 0.0;  ///< |Σ∫ρv dV| lost over Σ∫ρ|v| dV
  double energy_lost = 0.0;  ///< kinetic energy, the old mesh's less the new one's [μ_out G R0³]
};

/// What evolution asks of a flow solver, be it finite elements on a volume mesh or boundary
/// integrals on the interfaces alone. A solver keeps what it derives from a domain (spaces,
/// preconditioners) while the connectivity stands, and the last solutions for first guesses beyond.
class FlowSolver {
 public:
  virtual ~FlowSolver() = default;

  /// The flow in a domain at one instant.
  virtual FlowSolution solve(const FlowDomain& domain, const Instant& instant) = 0;

  /// The mesh was made anew for this domain: what is kept of the last solution goes along. Only
  /// solvers that keep something on the mesh override it.
  virtual void follow(const MeshChange& /*change*/, const FlowDomain& /*domain*/) {}

  /// A flow with inertia on the mesh that took the place of another; `before` is the scene that the
  /// mesh before belonged to. Its velocity is without divergence there.
  virtual TransferredFlow transferred(const MeshChange& /*change*/, const Scene& /*before*/,
                                      const FlowDomain& /*domain*/, double /*t*/,
                                      const NodalFlow& flow) {
    return {{}, flow};
  }

  /// All that is needed to go on in this domain bit for bit.
  virtual void save(Archive& archive, const FlowDomain& domain) const = 0;
  /// Throws InvalidInput when the archive's state is damaged or does not fit the domain.
  virtual void load(const Archive& archive, const FlowDomain& domain) = 0;

  /// Whether the solver still represents as much of the interfaces as they are, on a mesh that has
  /// moved, as when the mesh was new.
  [[nodiscard]] virtual bool is_fit(const FlowDomain& /*moved*/) { return true; }

  [[nodiscard]] virtual const PhaseTimes& times() const = 0;
};

}  // namespace meniscus
