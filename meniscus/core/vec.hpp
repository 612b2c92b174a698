#pragma once

#include <Eigen/Core>

namespace meniscus {

/// A point or vector in space, and a 3 × 3 tensor. Eigen's types; only fixed sizes cross a room's
/// door.
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

}  // namespace meniscus
