#include "meniscus/flow/fem/constraints.hpp"

#include <cmath>

#include <Eigen/Geometry>

#include "meniscus/core/error.hpp"

namespace meniscus::fem {
namespace {

// Normals closer than this to the span of the others add nothing. 1e-6 is far above the roundoff of
// a normal and far below any corner one would draw.
constexpr double dependent = 1e-6;

/// Orthonormal vectors, at most three.
struct Basis {
  std::array<Vec3, 3> vectors;
  std::size_t size = 0;

  [[nodiscard]] std::span<const Vec3> all() const { return std::span(vectors).first(size); }
};

/// The span of the normals.
Basis orthonormal_basis(std::span<const Vec3> normals) {
  Basis basis;
  for (Vec3 n : normals) {
    for (const Vec3& e : basis.all()) n -= e.dot(n) * e;
    if (basis.size < 3 && n.norm() > dependent) basis.vectors[basis.size++] = n.normalized();
  }
  return basis;
}

/// The axis, among those not taken, that a direction is nearest to.
std::size_t nearest_axis(const Vec3& direction, const std::array<bool, 3>& is_taken) {
  std::size_t best = 3;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto component = static_cast<Eigen::Index>(k);
    if (!is_taken[k] && (best == 3 || std::abs(direction[component]) >
                                          std::abs(direction[static_cast<Eigen::Index>(best)])))
      best = k;
  }
  return best;
}

/// Fills the columns of the frame that are not taken, as near to the coordinate axes as they can.
void complete(Mat3& frame, std::array<bool, 3> is_taken) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (is_taken[k]) continue;
    Vec3 axis = Vec3::Zero();
    double longest = -1.0;
    for (Eigen::Index unit = 0; unit < 3; ++unit) {
      Vec3 candidate = Vec3::Unit(unit);
      for (std::size_t j = 0; j < 3; ++j)
        if (is_taken[j]) {
          const Vec3 taken = frame.col(static_cast<Eigen::Index>(j));
          candidate -= taken.dot(candidate) * taken;
        }
      // 0.5: its own axis unless that is nearly spanned already.
      const double preference = unit == static_cast<Eigen::Index>(k) ? 0.5 : 0.0;
      if (candidate.norm() + preference > longest) {
        longest = candidate.norm() + preference;
        axis = candidate.normalized();
      }
    }
    frame.col(static_cast<Eigen::Index>(k)) = axis;
    is_taken[k] = true;
  }
}

bool is_axis_aligned(std::span<const Vec3> basis) {
  for (const Vec3& e : basis)
    if (e.cwiseAbs().maxCoeff() < 1.0 - 1e-14) return false;
  return true;
}

}  // namespace

Vec3 NodeConstraint::fixed_part(const Vec3& x) const {
  Vec3 local = frame.transpose() * x;
  for (std::size_t k = 0; k < 3; ++k)
    if (!is_fixed[k]) local[static_cast<Eigen::Index>(k)] = 0.0;
  return frame * local;
}

NodeConstraint& Constraints::at(NodeId i) {
  if (index_[i] < 0) {
    index_[i] = static_cast<std::int32_t>(constraints_.size());
    constraints_.push_back({});
  }
  NodeConstraint& constraint = constraints_[static_cast<std::size_t>(index_[i])];
  constraint = NodeConstraint{};
  constraint.node = i;
  return constraint;
}

void Constraints::fix(NodeId i, const Vec3& value) {
  NodeConstraint& constraint = at(i);
  constraint.is_fixed = {true, true, true};
  MENISCUS_ASSERT(value.allFinite(), "node {}", i.value);
  constraint.value = value;
}

void Constraints::forbid_penetration(NodeId i, std::span<const Vec3> normals) {
  const Basis basis = orthonormal_basis(normals);
  NodeConstraint& constraint = at(i);
  if (basis.size == 3) {
    constraint.is_fixed = {true, true, true};
    return;
  }
  const bool is_aligned = is_axis_aligned(basis.all());
  for (const Vec3& e : basis.all()) {
    const std::size_t slot = nearest_axis(e, constraint.is_fixed);
    MENISCUS_ASSERT(slot < 3, "node {}", i.value);
    constraint.is_fixed[slot] = true;
    if (!is_aligned) constraint.frame.col(static_cast<Eigen::Index>(slot)) = e;
  }
  if (!is_aligned) complete(constraint.frame, constraint.is_fixed);
}

void Constraints::impose(Field<NodeId, Vec3>& v) const {
  for (const NodeConstraint& constraint : constraints_)
    v[constraint.node] += constraint.fixed_part(constraint.value - v[constraint.node]);
}

}  // namespace meniscus::fem
