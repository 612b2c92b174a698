#pragma once

#include <array>
#include <span>
#include <vector>

#include "meniscus/mesh/tet_mesh.hpp"

namespace meniscus::fem {

/// What is prescribed of the velocity at one vertex: the components `is_fixed` in the orthonormal
/// frame whose axes are the columns of `frame`.
struct NodeConstraint {
  TetVertexId vertex;
  Mat3 frame = Mat3::Identity();
  std::array<bool, 3> is_fixed = {false, false, false};
  Vec3 value = Vec3::Zero();  ///< Cartesian; only its fixed components count [G R0]

  [[nodiscard]] bool is_rotated() const { return frame != Mat3::Identity(); }
  /// The part of a Cartesian vector along the fixed axes.
  [[nodiscard]] Vec3 fixed_part(const Vec3& x) const;
};

/// All strong conditions of a problem, at most one per vertex.
class Constraints {
 public:
  explicit Constraints(std::int32_t num_vertices) : index_(num_vertices, -1) {}

  /// v = value; replaces whatever was asked of the vertex before.
  void fix(TetVertexId v, const Vec3& value);
  /// n·v = 0 for each of the unit normals (linearly dependent ones count once). Axes that lie along
  /// a coordinate axis leave the frame Cartesian.
  void forbid_penetration(TetVertexId v, std::span<const Vec3> normals);

  [[nodiscard]] std::span<const NodeConstraint> all() const { return constraints_; }
  /// Null for a free vertex.
  [[nodiscard]] const NodeConstraint* find(TetVertexId v) const {
    const std::int32_t i = index_[v];
    return i < 0 ? nullptr : &constraints_[static_cast<std::size_t>(i)];
  }
  /// Overwrites the fixed components of a velocity field.
  void impose(Field<TetVertexId, Vec3>& v) const;

 private:
  NodeConstraint& at(TetVertexId v);
  Field<TetVertexId, std::int32_t> index_;
  std::vector<NodeConstraint> constraints_;
};

}  // namespace meniscus::fem
