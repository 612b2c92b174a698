#pragma once
// Private header of this room.

#include <Eigen/Core>

#include "meniscus/linear/communicator.hpp"
#include "meniscus/linear/saddle_system.hpp"

namespace meniscus::linear {

/// The part of an inverse that a few functions span: Z (ZᵀKZ)⁺ Zᵀ for a symmetric K ≥ 0. Added to
/// a preconditioner it corrects what that makes of these functions.
class CoarseSpace {
 public:
  /// `functions` are the columns of Z as rows, with this rank's entries. K acts once on each; what
  /// rounding leaves of its asymmetry is dropped. Collective.
  CoarseSpace(Communicator communicator, const CsrView& functions, const LinearOperator& K);
  /// Adds s Z (ZᵀKZ)⁺ Zᵀ r to z. Collective.
  void add(std::span<const double> r, double s, std::span<double> z) const;

 private:
  /// Zᵀ r of all ranks.
  [[nodiscard]] Eigen::VectorXd products_with(std::span<const double> r) const;

  Communicator communicator_;
  CsrMatrix functions_;
  Eigen::MatrixXd inverse_;
};

}  // namespace meniscus::linear
