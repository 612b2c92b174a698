#pragma once

#include <optional>

#include "meniscus/core/archive.hpp"
#include "meniscus/flow/fem/stokes_solver.hpp"

namespace meniscus::fem {

/// What is known of the preconditioner that the next solve on the same connectivity will keep.
struct KeptPreconditioner {
  /// Where the nodes were when it was made; none when the next solve is to make its own.
  std::optional<NodePositions> at;
  int iterations = 0;     ///< of the first solve with it; 0 where none was yet
  double duration = 0.0;  ///< of the stage then [1/G]; 0 without inertia
  /// The velocity past the mesh that convected then, where it matters (`StokesSolver::prepare`)
  /// [G R0].
  Field<NodeId, Vec3> convecting = {};

  /// Drops one made for a stage more than twice or less than half as long. It would be of no use:
  /// seven times the length took 2000 iterations.
  void drop_unless_of_stage(double stage_duration);
  /// After a solve: keeps it while it saves more than it costs. To make one takes as long as three
  /// or four iterations (docs/benchmark-stokes.md). `convects` is the velocity past the mesh with
  /// which the solve began, where it matters.
  void decide(const StokesProblem& problem, const StokesReport& report, bool is_kept,
              Field<NodeId, Vec3> convects);

  void save(Archive& archive) const;
};
/// The one that the saved run had, if any. Throws InvalidInput when arrays are missing.
[[nodiscard]] KeptPreconditioner load_preconditioner(const Archive& archive);

}  // namespace meniscus::fem
