#pragma once

#include <array>
#include <numbers>

#include "meniscus/core/named_constant.hpp"

namespace meniscus::fem {

/// The least Jacobian allowed, over the straight cell's. Quadratic maps of cells that pass are one
/// to one in practice, and their gradients at most some ten times those of the straight cell.
inline constexpr double kLeastJacobian = 0.1;
/// The reference of `solver.rtol` is this many times the residual of the undisturbed flow, if that
/// is not more than the residual at rest; and not below what a residual's roundoff leaves, where
/// there are no drops.
inline constexpr double kMostOfDisturbance = 50.0, kLeastOfRest = 1e-6;

/// What damping adds to −Δ_s, over the squared radius of the sphere of an interface's volume: the
/// l = 2 mode of a sphere then has an error of third order 0 (docs/time-stepping.md):
///   θ (6 + k)/4 = ½ + 1/√12, θ = 1 − 1/√2.
inline constexpr double kSphereStiffness =
    4.0 * (0.5 + std::numbers::sqrt3 / 6.0) / (1.0 - std::numbers::sqrt2 / 2.0) - 6.0;

inline constexpr std::array kConstants{NamedConstant{"least-jacobian", kLeastJacobian},
                                       NamedConstant{"most-of-disturbance", kMostOfDisturbance},
                                       NamedConstant{"least-of-rest", kLeastOfRest},
                                       NamedConstant{"sphere-stiffness", kSphereStiffness}};

}  // namespace meniscus::fem
