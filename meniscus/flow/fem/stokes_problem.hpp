#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "meniscus/flow/fem/constraints.hpp"
#include "meniscus/flow/fem/inertia_terms.hpp"
#include "meniscus/flow/fem/node_positions.hpp"
#include "meniscus/scene/viscosity.hpp"

namespace meniscus::fem {

struct Partition;

/// One instant of two-phase Stokes flow, ready to discretise:
///   ∫(−p∇·φ + 2μ D(v):D(φ)) − ∫f·φ − F(φ) = 0   for every φ that vanishes where v is fixed,
///   −∫ψ∇·v − Σ_K τ∫∇ψ·(∇p − f) = 0                 for every ψ
/// (eqs 10, 11 of hooper2001 with 2μ D:D and a consistent stabilisation; τ = 0 for P2). Where μ
/// depends on the rate of shear so does τ. With inertia ρDv/Dt comes to −f in both, and
/// −θ∫ψ∇·v̄, θ = τρ/T, to the second (`InertiaTerms`).
struct StokesProblem {
  StokesProblem(const TetMesh& on, const FlowSpace& in, NodePositions at)
      : mesh(on),
        space(in),
        positions(std::move(at)),
        viscosity(on.num_cells(), 1.0),
        body_force(on.num_cells(), Vec3::Zero()),
        force(in.velocity.num_nodes, Vec3::Zero()),
        constraints(in.velocity.num_nodes) {}

  const TetMesh& mesh;
  const FlowSpace& space;
  NodePositions positions;
  CellField<double> viscosity;  ///< [μ_out]; constant in each region on linear elements
  /// How the viscosity depends on the rate of shear, by region; empty: all are Newtonian.
  Field<RegionId, ViscosityLaw> laws;
  CellField<Vec3> body_force;  ///< f [μ_out G / R0]
  Field<NodeId, Vec3> force;   ///< F: further forces on the fluid, by node [μ_out G R0²]
  Constraints constraints;
  std::optional<InertiaTerms> inertia = {};  ///< none: Stokes flow
  /// The flow without drops, every liquid being the outer one; empty: not known.
  Field<NodeId, Vec3> undisturbed = {};
  const Partition* partition =
      nullptr;                     ///< the rank's, where the problem is its part of a global one
  bool has_open_boundary = false;  ///< otherwise the pressure is known up to a constant

  [[nodiscard]] bool is_generalised() const { return !std::ranges::all_of(laws, is_newtonian); }
  /// Null in a Newtonian liquid.
  [[nodiscard]] const ViscosityLaw* law(CellId c) const {
    if (laws.empty()) return nullptr;
    const ViscosityLaw& law = laws[mesh.region[c]];
    return is_newtonian(law) ? nullptr : &law;
  }
};

/// v at the nodes of the velocity, p at those of the pressure.
struct StokesState {
  Field<NodeId, Vec3> v;  ///< [G R0]
  std::vector<double> p;  ///< [μ_out G]
};

/// The components of vectors, side by side.
[[nodiscard]] inline std::span<const double> numbers(const Field<NodeId, Vec3>& vectors) {
  return {vectors.span().front().data(), 3 * vectors.span().size()};
}
[[nodiscard]] inline std::span<double> numbers(Field<NodeId, Vec3>& vectors) {
  return {vectors.span().front().data(), 3 * vectors.span().size()};
}

[[nodiscard]] inline StokesState state_at_rest(const FlowSpace& space) {
  return {Field<NodeId, Vec3>(space.velocity.num_nodes, Vec3::Zero()),
          std::vector<double>(space.pressure.vertex.size(), 0.0)};
}

}  // namespace meniscus::fem
