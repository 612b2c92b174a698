#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "meniscus/core/fault.hpp"
#include "meniscus/mesh/tet_mesh.hpp"

namespace meniscus {

/// The energy balance of one solution, all in [μ_out G² R0³]. in − dissipation − kinetic_rate is
/// what the interfaces' energy gains per time when nothing is lost.
struct Power {
  /// Reaction of the outer boundary times its velocity, plus body force times velocity.
  double in = 0.0;
  double dissipation = 0.0;   ///< ∫2μ D:D plus the stabilisation's share
  double kinetic_rate = 0.0;  ///< ∫ρv·Dv/Dt, what the liquids' kinetic energy gains per time
  friend bool operator==(const Power&, const Power&) = default;
};

/// The nodes at the middles of the edges of a surface's curved faces: by face, edge k leaving its
/// corner k.
struct MiddleNodes {
  FaceField<std::array<Vec3, 3>> x, v;  ///< [R0], [G R0]
};

/// v and p on the volume mesh.
struct BulkFlow {
  Field<TetVertexId, Vec3> v;  ///< [G R0]
  /// And at the middles of edges, in the order of the solver's space; empty for linear elements.
  std::vector<Vec3> v_at_edges = {};
  /// By cell corner (|C| × 4), as pressure is double valued on interfaces [μ_out G].
  std::vector<double> corner_pressure;
};

/// The flow of liquids with inertia on the nodes of the solver's space: the vertices, then the
/// middles of edges. Its velocity is what a step begins with.
struct NodalFlow {
  std::vector<Vec3> x;    ///< [R0]
  std::vector<Vec3> v;    ///< [G R0]
  std::vector<double> p;  ///< at the nodes of the pressure [μ_out G]
  Power power = {};       ///< when it was found
  friend bool operator==(const NodalFlow&, const NodalFlow&) = default;
};

/// What the liquid of one region has by its motion.
struct RegionMotion {
  Vec3 momentum = Vec3::Zero();       ///< ∫ρv dV [μ_out R0²]
  double kinetic_energy = 0.0;        ///< ½∫ρv² dV [μ_out G R0³]
  Vec3 mean_velocity = Vec3::Zero();  ///< [G R0]
};

/// The flow at one instant, or why there is none. Failure is an outcome that evolution answers.
struct [[nodiscard]] FlowSolution : Report {
  int iterations = 0;                      ///< linear iterations, all Newton steps together
  std::vector<std::string> warnings = {};  ///< what was done in another way than asked for

  std::vector<VertexField<Vec3>> velocity = {};  ///< of the liquid at each interface's vertices
  /// And at the middles of the faces' edges; empty where faces are flat.
  std::vector<MiddleNodes> middles = {};
  /// None where the flow fills an unbounded space: its power and dissipation are infinite.
  std::optional<Power> power = {};
  /// ∫2(μ(γ̇) − μ)D over the liquid of each region, μ its own viscosity: what a law adds to the
  /// stress in it [μ_out G R0³]. Empty where all liquids are Newtonian.
  std::vector<Mat3> excess_stress = {};
  /// The smallest viscosity in each region [μ_out]. Empty where all liquids are Newtonian.
  std::vector<double> least_viscosity = {};
  std::optional<BulkFlow> bulk = {};       ///< where there is a volume mesh
  std::optional<NodalFlow> nodal = {};     ///< of liquids with inertia
  std::vector<RegionMotion> motions = {};  ///< theirs, by region
};

/// A solution that was not found.
[[nodiscard]] inline FlowSolution failed_flow(Fault fault, int iterations = 0) {
  FlowSolution solution;
  solution.fault = std::move(fault);
  solution.iterations = iterations;
  return solution;
}

}  // namespace meniscus
