#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "meniscus/core/vec.hpp"

namespace meniscus::bem {

/// Points with vectors a_j, areas or forces, one array per component so that sums vectorise.
struct SourcePoints {
  std::vector<double> x, y, z;
  std::vector<double> ax, ay, az;

  void add(const Vec3& at, const Vec3& a);
  [[nodiscard]] std::int32_t size() const { return static_cast<std::int32_t>(x.size()); }
  [[nodiscard]] Vec3 point(std::int32_t j) const {
    const auto k = static_cast<std::size_t>(j);
    return {x[k], y[k], z[k]};
  }
};

/// A vector per source point, by component.
struct SourceVectors {
  explicit SourceVectors(std::int32_t size) { resize(size); }
  void resize(std::int32_t size) {
    for (std::vector<double>* component : {&x, &y, &z})
      component->resize(static_cast<std::size_t>(size));
  }
  [[nodiscard]] Vec3 at(std::int32_t j) const {
    const auto k = static_cast<std::size_t>(j);
    return {x[k], y[k], z[k]};
  }
  void set(std::int32_t j, const Vec3& value) {
    const auto k = static_cast<std::size_t>(j);
    x[k] = value.x();
    y[k] = value.y();
    z[k] = value.z();
  }
  std::vector<double> x, y, z;
};

/// A part of the source points.
struct SourceRange {
  std::int32_t begin = 0, end = 0;
};

/// The six entries xx, yy, zz, xy, xz, yz of a symmetric matrix.
using Symmetric = std::array<double, 6>;
[[nodiscard]] inline Vec3 operator*(const Symmetric& m, const Vec3& v) {
  return {m[0] * v[0] + m[3] * v[1] + m[4] * v[2], m[3] * v[0] + m[1] * v[1] + m[5] * v[2],
          m[4] * v[0] + m[5] * v[1] + m[2] * v[2]};
}

/// Σ_j q_j [a_j/r + r (r·a_j)/r³], r = x_j − p: the single layer of q n, times 8π; a point at p
/// itself counts nothing. About 30 flops a pair; compiled for several widths of vectors.
[[nodiscard]] Vec3 single_layer_sum(const SourcePoints& points, const std::vector<double>& q,
                                    const Vec3& p);
/// The same over a range of the points, with a q for each of the range.
[[nodiscard]] Vec3 single_layer_sum(const SourcePoints& points, SourceRange range,
                                    const std::vector<double>& q, const Vec3& p);
/// Σ_j [a_j (r² + 2 ε_j²) + r (r·a_j)]/(r² + ε_j²)^{3/2}, r = x_j − p: forces spread over the
/// radius ε, `spread` being ε².
[[nodiscard]] Vec3 spread_forces_sum(const SourcePoints& points, const std::vector<double>& spread,
                                     const Vec3& p);
/// Σ_j r (r·u_j)(r·a_j)/r⁵: the double layer of u, times −4π/6 when the kernel is −6 rrr/r⁵. What
/// u has beyond the points does not count.
[[nodiscard]] Vec3 double_layer_sum(const SourcePoints& points, const SourceVectors& u,
                                    const Vec3& p);
/// Both sums over a range of the points, for q = 1 and for u = the unit vectors.
struct ConstantLayers {
  Vec3 single = Vec3::Zero();
  Symmetric double_layer{};  ///< Σ rr (r·a_j)/r⁵
};
[[nodiscard]] ConstantLayers constant_layer_sums(const SourcePoints& points, SourceRange range,
                                                 const Vec3& p);

}  // namespace meniscus::bem
