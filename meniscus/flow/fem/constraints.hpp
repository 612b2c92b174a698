#pragma once

#include <array>
#include <span>
#include <vector>

#include "meniscus/flow/fem/spaces.hpp"

namespace meniscus::fem {

/// The prescribed part of the velocity at one node: its components `is_fixed` in the orthonormal
/// frame whose axes are the columns of `frame`.
struct NodeConstraint {
  NodeId node;
  Mat3 frame = Mat3::Identity();
  std::array<bool, 3> is_fixed = {false, false, false};
  Vec3 value = Vec3::Zero();  ///< Cartesian; only its fixed components count [G R0]

  [[nodiscard]] bool is_rotated() const { return frame != Mat3::Identity(); }
  /// The part of a Cartesian vector along the fixed axes.
  [[nodiscard]] Vec3 fixed_part(const Vec3& x) const;
};

/// All strong conditions of a problem, at most one per node.
class Constraints {
 public:
  explicit Constraints(std::int32_t num_nodes) : index_(num_nodes, -1) {}

  /// v = value; replaces the constraint that the node had.
  void fix(NodeId i, const Vec3& value);
  /// n·v = 0 for each of the unit normals (linearly dependent ones count once). Axes that lie along
  /// a coordinate axis leave the frame Cartesian.
  void forbid_penetration(NodeId i, std::span<const Vec3> normals);

  /// Gives node i the constraint of a node of another space.
  void copy(NodeId i, const NodeConstraint& constraint) {
    NodeConstraint& copied = at(i);
    copied = constraint;
    copied.node = i;
  }

  [[nodiscard]] std::span<const NodeConstraint> all() const { return constraints_; }
  /// Null for a free node.
  [[nodiscard]] const NodeConstraint* find(NodeId i) const {
    const std::int32_t k = index_[i];
    return k < 0 ? nullptr : &constraints_[static_cast<std::size_t>(k)];
  }
  /// Overwrites the fixed components of a velocity field.
  void impose(Field<NodeId, Vec3>& v) const;

 private:
  NodeConstraint& at(NodeId i);
  Field<NodeId, std::int32_t> index_;
  std::vector<NodeConstraint> constraints_;
};

}  // namespace meniscus::fem
