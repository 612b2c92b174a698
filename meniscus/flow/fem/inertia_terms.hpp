#pragma once

#include <array>
#include <span>
#include <vector>

#include "meniscus/flow/fem/face_elements.hpp"

namespace meniscus::fem {

/// The nodes of a linear or a quadratic face: three or six.
class FaceNodes {
 public:
  explicit FaceNodes(std::span<const NodeId> nodes);
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] NodeId operator[](std::size_t i) const { return nodes_[i]; }
  [[nodiscard]] auto begin() { return nodes_.begin(); }
  [[nodiscard]] auto begin() const { return nodes_.begin(); }
  [[nodiscard]] auto end() { return begin() + static_cast<std::ptrdiff_t>(size_); }
  [[nodiscard]] auto end() const { return begin() + static_cast<std::ptrdiff_t>(size_); }

 private:
  std::array<NodeId, 6> nodes_;
  std::size_t size_;
};

/// A factor times ∫∇_sφ_i·∇_sφ_j of a face; zero beyond its nodes.
struct FaceStiffness {
  FaceNodes nodes;
  Eigen::Matrix<double, 6, 6> values = Eigen::Matrix<double, 6, 6>::Zero();

  /// What node j does to node i.
  [[nodiscard]] Mat3 block(std::size_t i, std::size_t j) const {
    return values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) * Mat3::Identity();
  }
};
/// That of the nodes of one face at x.
[[nodiscard]] FaceStiffness face_stiffness(const Field<NodeId, Vec3>& x,
                                           std::span<const NodeId> nodes, double factor);

/// ∫E (∇_s·φ_i e_a)(∇_s·φ_j e_b) of a face, E linear on it, the three components side by side at
/// each node; zero beyond its nodes.
struct FaceElasticity {
  FaceNodes nodes;
  Eigen::Matrix<double, 18, 18> values = Eigen::Matrix<double, 18, 18>::Zero();

  [[nodiscard]] Mat3 block(std::size_t i, std::size_t j) const {
    return values.block<3, 3>(3 * static_cast<Eigen::Index>(i), 3 * static_cast<Eigen::Index>(j));
  }

  /// The mean over the three components of what a component does to itself.
  [[nodiscard]] Eigen::Matrix<double, 6, 6> mean_of_components() const;
};
/// That of the nodes of one face at x, E being given at its corners.
[[nodiscard]] FaceElasticity face_elasticity(const Field<NodeId, Vec3>& x,
                                             std::span<const NodeId> nodes, const Vec3& E);

/// What inertia adds to a problem, in an implicit stage of length τ: to the momentum
///   ∫ρ((v − v̄)/τ + (v − w)·∇v)·φ + τσ∮∇_s(v − v*):∇_sφ + τ∮E ∇_s·(v − v*) ∇_s·φ,
/// v̄ being the velocity that the nodes had at the other end of τ, and w their own. The interface
/// is where v* took it, and so is its surfactant. The last two terms are what tension does on the
/// way that v takes them beyond. It acts by its own curvature (bansch2001), and by the surfactant
/// that is spread or gathered, of Gibbs elasticity E.
struct InertiaTerms {
  double duration = 1.0;                        ///< τ [1/G]
  CellField<double> density = {};               ///< ρ [μ_out/(G R0²)]
  Field<NodeId, Vec3> before = {};              ///< v̄ [G R0]
  Field<NodeId, Vec3> mesh_velocity = {};       ///< w [G R0]
  Field<NodeId, Vec3> interface_went = {};      ///< v*; zero off the interfaces [G R0]
  std::vector<FaceStiffness> tension = {};      ///< τσ∮∇_sφ_i·∇_sφ_j by face
  std::vector<FaceElasticity> elasticity = {};  ///< τE by face, of interfaces with surfactant
  /// Linear elements: what the stabilisation goes on with of ∫∇·v̄ over each cell where its nodes
  /// were (`remember_divergence`); empty: nothing [G R0³].
  CellField<double> remembered_divergence = {};

  /// Adds τσ∮∇_sv:∇_sφ + τ∮E ∇_s·v ∇_s·φ, the components side by side at each node.
  void add_tension(std::span<const double> v, std::span<double> momentum) const;
};

}  // namespace meniscus::fem
