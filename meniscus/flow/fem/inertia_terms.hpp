#pragma once

#include <array>
#include <vector>

#include "meniscus/flow/fem/face_elements.hpp"

namespace meniscus::fem {

/// A factor times ∫∇_sφ_i·∇_sφ_j of a quadratic face.
struct FaceStiffness {
  std::array<NodeId, 6> nodes;
  Eigen::Matrix<double, 6, 6> values = Eigen::Matrix<double, 6, 6>::Zero();
};
/// That of the nodes of one face at x.
[[nodiscard]] FaceStiffness face_stiffness(const Field<NodeId, Vec3>& x,
                                           std::span<const NodeId> nodes, double factor);

/// ∫E (∇_s·φ_i e_a)(∇_s·φ_j e_b) of a quadratic face, E linear on it, the three components side by
/// side at each node.
struct FaceElasticity {
  std::array<NodeId, 6> nodes;
  Eigen::Matrix<double, 18, 18> values = Eigen::Matrix<double, 18, 18>::Zero();

  /// The mean over the three components of what a component does to itself.
  [[nodiscard]] Eigen::Matrix<double, 6, 6> mean_of_components() const;
};
/// That of the nodes of one face at x, E being given at its corners.
[[nodiscard]] FaceElasticity face_elasticity(const Field<NodeId, Vec3>& x,
                                             std::span<const NodeId> nodes, const Vec3& E);

/// What inertia adds to a problem, in an implicit stage of length τ: to the momentum
///   ∫ρ((v − v̄)/τ + (v − w)·∇v)·φ + τσ∮∇_s(v − v*):∇_sφ + τ∮E ∇_s·(v − v*) ∇_s·φ,
/// v̄ being the velocity that the nodes had at the other end of τ, and w their own. The interface is
/// where v* took it, and so is its surfactant. The last two terms are what tension does on the way
/// that v takes them beyond: its own curvature (bansch2001), and the surfactant that is spread or
/// gathered, by its Gibbs elasticity E.
struct InertiaTerms {
  double duration = 1.0;                        ///< τ [1/G]
  CellField<double> density = {};               ///< ρ [μ_out/(G R0²)]
  Field<NodeId, Vec3> before = {};              ///< v̄ [G R0]
  Field<NodeId, Vec3> mesh_velocity = {};       ///< w [G R0]
  Field<NodeId, Vec3> interface_went = {};      ///< v*; zero off the interfaces [G R0]
  std::vector<FaceStiffness> tension = {};      ///< τσ∮∇_sφ_i·∇_sφ_j by face
  std::vector<FaceElasticity> elasticity = {};  ///< τE by face, of interfaces with surfactant
};

}  // namespace meniscus::fem
