#pragma once

#include <span>
#include <vector>

#include "meniscus/flow/fem/node_positions.hpp"

namespace meniscus::fem {

/// A force on the nodes of surfaces that resists a change of their normal speeds n_i·v_i from s_i,
///   −n_i Σ_j K_ij (n_j·v_j − s_j),   K_ij = Σ_surfaces τσ∫(∇_sφ_i·∇_sφ_j + k φ_iφ_j) dS.
/// For normal displacements u_i and k = 0, Σ u_i K_ij u_j/τ is the second variation of σ times the
/// area less ∫2σκ1κ2u² dS. It is never negative; for k = 0 it is zero where u is the same
/// everywhere.
struct SurfaceDamping {
  struct Entry {
    NodeId row, column;
    double weight;  ///< one face's part of K_ij [μ_out R0]
  };
  Field<NodeId, Vec3> normal;   ///< n_i; zero off the surfaces
  Field<NodeId, double> speed;  ///< s_i [G R0]
  std::vector<Entry> entries;

  [[nodiscard]] bool is_none() const { return entries.empty(); }
};

/// A surface's nodes, its τσ [μ_out R0] and its k [1/R0²].
struct DampedSurface {
  const FaceNodeTable& faces;
  double strength;
  double k = 0.0;
};

/// Damping of all surfaces, s = 0. Normals are those of Σ_faces ∫φ_i² n dS, which weighs the
/// corners of quadratic faces too.
[[nodiscard]] SurfaceDamping surface_damping(std::span<const DampedSurface> surfaces,
                                             const NodePositions& positions);

/// n_i·v_i of every node; zero off the surfaces.
[[nodiscard]] Field<NodeId, double> normal_speeds(const SurfaceDamping& damping,
                                                  const Field<NodeId, Vec3>& v);

/// Adds n_i Σ_j K_ij (n_j·v_j − s_j) to a residual of the momentum.
void add_resistance(const SurfaceDamping& damping, const Field<NodeId, Vec3>& v,
                    Field<NodeId, Vec3>& momentum);

}  // namespace meniscus::fem
