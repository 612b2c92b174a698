#pragma once

#include <span>
#include <vector>

#include "meniscus/core/archive.hpp"
#include "meniscus/core/timer.hpp"
#include "meniscus/flow/flow_solver.hpp"

namespace meniscus {

/// A way of the mesh, of one connectivity, and the flow that convects on it.
struct ScalarPath {
  FlowDomain start, end;
  double duration = 0.0;
  const FlowSolution& flow;  ///< of the whole way: of its middle, or the mean over it
  /// Rates of adsorption [G] that the surfactants at the end hold already, by interface; empty
  /// where nothing is exchanged.
  std::span<const VertexField<double>> expected_adsorption = {};
};

/// The content of one region.
struct ScalarContent {
  double amount = 0.0;  ///< ∫γT dV [R0³]
  double volume = 0.0;  ///< [R0³]
};
/// An interface as a scalar sees it.
struct ScalarExchange {
  double outflow = 0.0;       ///< −∮k ∂T/∂n dS, n out of the drop [R0]
  double area = 0.0;          ///< [R0²]
  double mean_outside = 0.0;  ///< mean of c on the outer side
};
/// What tables say of one scalar at one instant.
struct ScalarMeasures {
  std::vector<ScalarContent> regions;
  std::vector<ScalarExchange> interfaces;
  double least = 0.0, largest = 0.0;  ///< of T at the nodes
  double reference = 0.0;  ///< mean over the patches with a given value, else over the matrix
};

/// A way that was gone, or why not.
struct [[nodiscard]] ScalarAdvance : Report {
  /// ∮φ_v j dS by interface: what its surfactant took up per time at each vertex, in the mean;
  /// empty where nothing is exchanged [G R0²].
  std::vector<VertexField<double>> uptake = {};
  /// How far a step of first order would have led a scalar from there, the largest of all. The
  /// masses' mean square of the difference over that of a field's change across the domain.
  double error = 0.0;
};

/// What evolution asks of whatever convects and diffuses the bulk scalars of a scene.
class ScalarSolver {
 public:
  virtual ~ScalarSolver() = default;

  /// The scalars as the liquids' initial profiles say. Where liquids meet the amount decides.
  virtual Report initial(const FlowDomain& domain, BulkScalars& scalars) = 0;
  /// How many values a scalar has on a domain.
  virtual std::size_t num_values(const FlowDomain& domain) = 0;
  /// Convects and diffuses the scalars along a path. Amounts change by what boundaries and sources
  /// give; a constant stays.
  virtual ScalarAdvance advance(const ScalarPath& path, BulkScalars& scalars) = 0;
  /// The mesh was moved a little without time passing: amounts stay.
  virtual void ride(const FlowDomain& from, const FlowDomain& to, BulkScalars& scalars) = 0;
  /// The scalars on the mesh that took the place of another (`MeshChange`); the amount of each
  /// stays. `before` is the scene that the mesh before belonged to.
  virtual BulkScalars follow(const MeshChange& change, const Scene& before,
                             const FlowDomain& domain, const BulkScalars& scalars) = 0;
  [[nodiscard]] virtual std::vector<ScalarMeasures> measures(const FlowDomain& domain,
                                                             const BulkScalars& scalars) = 0;

  [[nodiscard]] virtual const PhaseTimes& times() const = 0;
};

}  // namespace meniscus
