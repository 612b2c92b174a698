#pragma once

#include <array>

#include "meniscus/flow/bem/interface_elements.hpp"
#include "meniscus/flow/bem/layer_sums.hpp"

namespace meniscus::bem {

/// The kernels of both layers at r = y − x for the area vector a = n dS.
struct LayerKernels {
  Vec3 single;             ///< a/r + r (r·a)/r³
  Symmetric double_layer;  ///< rr (r·a)/r⁵
};
[[nodiscard]] LayerKernels layer_kernels(const Vec3& r, const Vec3& a);

inline void add(Symmetric& sum, double factor, const Symmetric& term) {
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += factor * term[k];
}

/// Integrals of the kernels over a face, times the face's six functions.
struct FaceMoments {
  std::array<Vec3, kQuadraticNodes> single;
  std::array<Symmetric, kQuadraticNodes> double_layer{};
};

/// Moments seen from a vertex of the face itself (`corner` 0, 1, 2).
[[nodiscard]] FaceMoments corner_moments(const InterfaceElements::Face& face, std::size_t corner);
/// Moments seen from a point off the face. It is quartered until every part is small beside its
/// distance: the error is about the same at any distance.
[[nodiscard]] FaceMoments near_moments(const InterfaceElements::Face& face, const Vec3& x);

}  // namespace meniscus::bem
