#pragma once

#include <array>

#include "meniscus/core/named_constant.hpp"

namespace meniscus::fem {

/// The least Jacobian allowed, over the straight cell's. Quadratic maps of cells that pass are one
/// to one in practice, and their gradients at most some ten times those of the straight cell.
inline constexpr double kLeastJacobian = 0.1;
/// The reference of `solver.rtol` is this many times the residual of the undisturbed flow, if that
/// is not more than the residual at rest. Where there are no drops it is not below what a
/// residual's roundoff leaves.
inline constexpr double kMostOfDisturbance = 50.0, kLeastOfRest = 1e-6;

inline constexpr std::array kConstants{NamedConstant{"least-jacobian", kLeastJacobian},
                                       NamedConstant{"most-of-disturbance", kMostOfDisturbance},
                                       NamedConstant{"least-of-rest", kLeastOfRest}};

}  // namespace meniscus::fem
