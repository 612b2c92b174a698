#pragma once

#include <Eigen/Core>

namespace meniscus {

/// A point or vector in space, and a 3 × 3 tensor. Rooms exchange Eigen types of fixed size only.
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

}  // namespace meniscus
