#include "meniscus/flow/bem/face_moments.hpp"

#include "meniscus/flow/bem/face_rules.hpp"

namespace meniscus::bem {
namespace {

/// Adds the kernels at points of a face, seen from x.
template <bool kHasDoubleLayer>
struct MomentSum {
  const Vec3& x;
  const NodeValues& q;
  FaceMoments& moments;

  void operator()(const std::array<double, 3>& b, const Vec3& y, const Vec3& area) const {
    const NodeValues values = quadratic_values(b);
    double density = 0.0;
    for (std::size_t a = 0; a < values.size(); ++a) density += values[a] * q[a];
    if constexpr (kHasDoubleLayer) {
      const LayerKernels kernels = layer_kernels(y - x, area);
      add_single(kernels.single, density);
      for (std::size_t a = 0; a < values.size(); ++a)
        add(moments.double_layer[a], values[a], kernels.double_layer);
    } else {
      add_single(single_layer_kernel(y - x, area), density);
    }
  }

  void add_single(const Vec3& kernel, double density) const {
    moments.constant += kernel;
    moments.single += density * kernel;
  }
};

}  // namespace

Vec3 single_layer_kernel(const Vec3& r, const Vec3& a) {
  const double inverse = 1.0 / r.norm();
  return inverse * a + (r.dot(a) * inverse * inverse * inverse) * r;
}

LayerKernels layer_kernels(const Vec3& r, const Vec3& a) {
  const double inverse = 1.0 / r.norm();
  const double along = r.dot(a) * inverse * inverse * inverse;
  const double factor = along * inverse * inverse;
  return {.single = inverse * a + along * r,
          .double_layer = {factor * r[0] * r[0], factor * r[1] * r[1], factor * r[2] * r[2],
                           factor * r[0] * r[1], factor * r[0] * r[2], factor * r[1] * r[2]}};
}

FaceMoments face_moments(const InterfaceElements::Face& face, std::size_t corner, const Vec3& x,
                         const NodeValues& q, bool has_double_layer) {
  FaceMoments moments;
  if (has_double_layer)
    visit_points(face, corner, x, MomentSum<true>{x, q, moments});
  else
    visit_points(face, corner, x, MomentSum<false>{x, q, moments});
  return moments;
}

}  // namespace meniscus::bem
