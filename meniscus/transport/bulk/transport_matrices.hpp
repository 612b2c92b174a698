#pragma once

#include <vector>

#include "meniscus/transport/bulk/scalar_space.hpp"

namespace meniscus::bulk {

/// Values on a space's graph.
using MatrixValues = std::vector<double>;

/// What a liquid does to a scalar, by region.
struct Coefficients {
  std::vector<double> capacity;      ///< γ
  std::vector<double> conductivity;  ///< k/Pe [G R0²]
  std::vector<double> source;        ///< q [G]
};

/// ∫ s γ φ_i φ_j, s by region. With s the nominal volume over that of the elements, a constant's
/// amount does not depend on how well the elements fill the regions.
struct MassMatrix {
  MatrixValues values;
  std::vector<double> rows;  ///< ∫ s γ φ_i: the amount of a field is the sum of rows times values
};
[[nodiscard]] MassMatrix mass_matrix(const Scene& scene, const TetMesh& mesh,
                                     const ScalarSpace& space, const NodePositions& positions,
                                     std::span<const double> capacity);

/// ∫ k ∇φ_i·∇φ_j, k by region.
[[nodiscard]] MatrixValues stiffness_matrix(const TetMesh& mesh, const ScalarSpace& space,
                                            const NodePositions& positions,
                                            std::span<const double> conductivity);

/// The liquid's velocity relative to a moving mesh, u + ∇ψ, ψ in the scalars' space. With it the
/// weak divergence of γ u is that of the mesh's own volumes, but for `defect`:
///   ∫γ(u + ∇ψ)·∇φ_i − ∮γ φ_i v·n dS = (m1_i − m0_i)/Δt + defect_i,
/// m the rows of the mass matrices before and after the motion. The defects sum to zero.
struct TransportVelocity {
  Field<NodeId, Vec3> u;           ///< [G R0]
  std::vector<double> potential;   ///< ψ [G R0²]
  std::vector<double> defect;      ///< [G R0³]
  double normal_correction = 0.0;  ///< added to v·n, so that the boundary has no net flux
  bool crosses_boundary = false;
};
/// `u` is the liquid's velocity less the mesh's at positions half way; `v` the liquid's.
[[nodiscard]] TransportVelocity transport_velocity(const TetMesh& mesh, const ScalarSpace& space,
                                                   const NodePositions& positions,
                                                   Field<NodeId, Vec3> u,
                                                   const Field<NodeId, Vec3>& v,
                                                   std::span<const double> capacity,
                                                   std::span<const double> growth);

/// The operators of one step.
struct TransportMatrices {
  /// L: ∫γφ_j(u + ∇ψ)·∇φ_i − ∫(k/Pe)∇φ_j·∇φ_i − ∮γφ_iφ_j v·n dS, and the stabilisation's part,
  /// whose columns sum to zero.
  MatrixValues rates;
  MatrixValues boundary;  ///< −∮γφ_iφ_j v·n dS alone; empty where nothing crosses
  /// ∫τγ(u + ∇ψ)·∇φ_i φ_j: what the stabilisation adds to the mass matrix.
  MatrixValues streamline;
  std::vector<double> sources;  ///< ∫q φ_i, and the stabilisation's part, whose sum is zero
};
[[nodiscard]] TransportMatrices transport_matrices(const TetMesh& mesh, const ScalarSpace& space,
                                                   const NodePositions& positions,
                                                   const TransportVelocity& velocity,
                                                   const Coefficients& coefficients,
                                                   double duration);

/// y = A x, A on the space's graph.
[[nodiscard]] std::vector<double> product(const ScalarSpace& space, const MatrixValues& values,
                                          std::span<const double> x);

}  // namespace meniscus::bulk
