#include "meniscus/flow/bem/face_moments.hpp"

#include "meniscus/flow/bem/face_rules.hpp"

namespace meniscus::bem {
namespace {

/// Adds the kernels at points of a face, seen from x, times the face's functions.
struct MomentSum {
  const Vec3& x;
  FaceMoments& moments;

  void operator()(const std::array<double, 3>& b, const Vec3& y, const Vec3& area) const {
    const std::array<double, kQuadraticNodes> values = quadratic_values(b);
    const LayerKernels kernels = layer_kernels(y - x, area);
    for (std::size_t a = 0; a < values.size(); ++a) {
      moments.single[a] += values[a] * kernels.single;
      add(moments.double_layer[a], values[a], kernels.double_layer);
    }
  }
};

FaceMoments no_moments() {
  FaceMoments moments;
  moments.single.fill(Vec3::Zero());
  return moments;
}

}  // namespace

LayerKernels layer_kernels(const Vec3& r, const Vec3& a) {
  const double inverse = 1.0 / r.norm();
  const double along = r.dot(a) * inverse * inverse * inverse;
  const double factor = along * inverse * inverse;
  return {.single = inverse * a + along * r,
          .double_layer = {factor * r[0] * r[0], factor * r[1] * r[1], factor * r[2] * r[2],
                           factor * r[0] * r[1], factor * r[0] * r[2], factor * r[1] * r[2]}};
}

FaceMoments corner_moments(const InterfaceElements::Face& face, std::size_t corner) {
  FaceMoments moments = no_moments();
  visit_corner_points(face, corner, MomentSum{face.nodes[corner], moments});
  return moments;
}

FaceMoments near_moments(const InterfaceElements::Face& face, const Vec3& x) {
  FaceMoments moments = no_moments();
  visit_near_points(face, x, MomentSum{x, moments});
  return moments;
}

}  // namespace meniscus::bem
