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

/// What inertia adds to a problem, in an implicit stage of length τ: to the momentum
///   ∫ρ((v − v̄)/τ + (v − w)·∇v)·φ + τσ∮∇_s(v − v*):∇_sφ,
/// v̄ being the velocity that the nodes had at the other end of τ, and w their own. The interface is
/// where v* took it; the last term is the tension of the way that v takes it beyond (bansch2001).
struct InertiaTerms {
  double duration = 1.0;                    ///< τ [1/G]
  CellField<double> density = {};           ///< ρ [μ_out/(G R0²)]
  Field<NodeId, Vec3> before = {};          ///< v̄ [G R0]
  Field<NodeId, Vec3> mesh_velocity = {};   ///< w [G R0]
  Field<NodeId, Vec3> interface_went = {};  ///< v*; zero off the interfaces [G R0]
  std::vector<FaceStiffness> tension = {};  ///< τσ∮∇_sφ_i·∇_sφ_j by face
};

}  // namespace meniscus::fem
