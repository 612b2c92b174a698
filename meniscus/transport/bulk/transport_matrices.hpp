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
  /// What one cell of a drop adds to a row.
  struct Part {
    std::int32_t region = 0, node = 0;
    double value = 0.0;
  };
  std::vector<Part> of_drops;
  std::vector<double> volumes;  ///< ∫ s of every region [R0³]
};
[[nodiscard]] MassMatrix mass_matrix(const Scene& scene, const TetMesh& mesh,
                                     const ScalarSpace& space, const NodePositions& positions,
                                     std::span<const double> capacity);
/// ∫γT dV of every region [R0³].
[[nodiscard]] std::vector<double> region_amounts(const MassMatrix& mass,
                                                 std::span<const double> values);

/// ∫ k ∇φ_i·∇φ_j, k by region.
[[nodiscard]] MatrixValues stiffness_matrix(const TetMesh& mesh, const ScalarSpace& space,
                                            const NodePositions& positions,
                                            std::span<const double> conductivity);

/// How the liquid moves relative to the mesh.
struct RelativeFlow {
  const Field<NodeId, Vec3>& u;  ///< the liquid's velocity less the mesh's [G R0]
  const Field<NodeId, Vec3>& v;  ///< the liquid's
  /// By how much the rows of the mass matrix grow per time, (m1 − m0)/Δt.
  std::span<const double> growth;
};

/// The operators of one step, on positions half way. The discrete u has another divergence than the
/// mesh's volumes say; a potential ψ in the scalars' space corrects that. Its part of the
/// convection ∫γφ_j(u + ∇ψ)·∇φ_i is K_ij(ψ_j − ψ_i)/2 for i ≠ j, K_ij = ∫γ∇φ_i·∇φ_j, and the sum of
/// these for i = j. With these differences columns add up to zero.
struct TransportMatrices {
  /// L: ∫γφ_j(u + ∇ψ)·∇φ_i − ∫(k/Pe)∇φ_j·∇φ_i − ∮γφ_iφ_j v·n dS, and the stabilisation's part,
  /// whose columns sum to zero. The rows of a constant sum to (m1_i − m0_i)/Δt + defect_i.
  MatrixValues rates;
  /// −∮γφ_j v·n dS: the rate of the amount by what crosses the boundary; empty where nothing does.
  std::vector<double> inflow;
  /// ∫τγu·∇φ_i φ_j: what the stabilisation adds to the mass matrix.
  MatrixValues streamline;
  std::vector<double> sources;  ///< ∫q φ_i, and the stabilisation's part, whose sum is zero
  std::vector<double> defect;   ///< what the potential leaves [G R0³]; its sum is zero
};
[[nodiscard]] TransportMatrices transport_matrices(const TetMesh& mesh, const ScalarSpace& space,
                                                   const NodePositions& positions,
                                                   const RelativeFlow& flow,
                                                   const Coefficients& coefficients,
                                                   double duration);

/// y = A x, A on the space's graph.
[[nodiscard]] std::vector<double> product(const ScalarSpace& space, const MatrixValues& values,
                                          std::span<const double> x);

}  // namespace meniscus::bulk
