#pragma once

#include <array>

#include "meniscus/flow/bem/interface_elements.hpp"
#include "meniscus/flow/bem/layer_sums.hpp"

namespace meniscus::bem {

/// The kernel of the single layer at r = y − x for the area vector a = n dS: a/r + r (r·a)/r³.
[[nodiscard]] Vec3 single_layer_kernel(const Vec3& r, const Vec3& a);

/// The kernels of both layers at r = y − x for the area vector a = n dS.
struct LayerKernels {
  Vec3 single;             ///< a/r + r (r·a)/r³
  Symmetric double_layer;  ///< rr (r·a)/r⁵
};
[[nodiscard]] LayerKernels layer_kernels(const Vec3& r, const Vec3& a);

inline void add(Symmetric& sum, double factor, const Symmetric& term) {
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += factor * term[k];
}

/// Integrals of the kernels over a face.
struct FaceMoments {
  Vec3 constant = Vec3::Zero();                           ///< the single layer of 1
  Vec3 single = Vec3::Zero();                             ///< the single layer of q
  std::array<Symmetric, kQuadraticNodes> double_layer{};  ///< times the face's six functions
};

/// Moments seen from x, the vertex `corner` of the face, or a point off the face where `corner`
/// is 3. `q` is the density of the single layer. Those of the double layer stay zero unless asked
/// for.
[[nodiscard]] FaceMoments face_moments(const InterfaceElements::Face& face, std::size_t corner,
                                       const Vec3& x, const NodeValues& q, bool has_double_layer);

}  // namespace meniscus::bem
