#include "meniscus/flow/bem/face_moments.hpp"

#include "meniscus/flow/bem/face_rules.hpp"

namespace meniscus::bem {
namespace {

using Face = InterfaceElements::Face;
using Part = std::array<Vec3, 3>;  // barycentric corners of a part of a face

/// Largest size of a part over its distance. The seven-point rule then integrates both kernels to
/// about 1e-4 of their size.
constexpr double kSizePerDistance = 1.0;
constexpr int kMostQuarterings = 14;  // parts of 6e-5 of the face: surfaces that all but touch

void add_point(const Face& face, const RulePoint& point, const Vec3& x, FaceMoments& moments) {
  const FacePoint at = face_point(face.nodes, point.weights);
  const LayerKernels kernels = layer_kernels(at.x - x, point.share * at.area);
  const NodeValues shape = quadratic_shape(point.weights);
  for (std::size_t a = 0; a < shape.size(); ++a) {
    moments.single[a] += shape[a] * kernels.single;
    add(moments.dual[a], shape[a], kernels.dual);
  }
}

FaceMoments no_moments() {
  FaceMoments moments;
  moments.single.fill(Vec3::Zero());
  return moments;
}

void add_part(const Face& face, const Part& b, int depth, const Vec3& x, FaceMoments& moments) {
  const double size = std::ldexp(face.size, -depth);
  const Vec3 middle = (b[0] + b[1] + b[2]) / 3.0;
  const double distance = (face_point(face.nodes, middle).x - x).norm();
  if (size > kSizePerDistance * distance && depth < kMostQuarterings) {
    const Part half = {0.5 * (b[1] + b[2]), 0.5 * (b[2] + b[0]), 0.5 * (b[0] + b[1])};
    for (const Part& part : {Part{b[0], half[2], half[1]}, Part{half[2], b[1], half[0]},
                             Part{half[1], half[0], b[2]}, half})
      add_part(face, part, depth + 1, x, moments);
    return;
  }
  const double share = std::ldexp(1.0, -2 * depth);
  for (const RulePoint& point : smooth_rule())
    add_point(face,
              {point.weights[0] * b[0] + point.weights[1] * b[1] + point.weights[2] * b[2],
               share * point.share},
              x, moments);
}

}  // namespace

LayerKernels layer_kernels(const Vec3& r, const Vec3& a) {
  const double inverse = 1.0 / r.norm();
  const double along = r.dot(a) * inverse * inverse * inverse;
  const double factor = along * inverse * inverse;
  return {.single = inverse * a + along * r,
          .dual = {factor * r[0] * r[0], factor * r[1] * r[1], factor * r[2] * r[2],
                   factor * r[0] * r[1], factor * r[0] * r[2], factor * r[1] * r[2]}};
}

FaceMoments corner_moments(const Face& face, int corner) {
  FaceMoments moments = no_moments();
  const Vec3& x = face.nodes[static_cast<std::size_t>(corner)];
  for (const RulePoint& point : corner_rule(corner)) add_point(face, point, x, moments);
  return moments;
}

FaceMoments near_moments(const Face& face, const Vec3& x) {
  FaceMoments moments = no_moments();
  add_part(face, {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}, 0, x, moments);
  return moments;
}

}  // namespace meniscus::bem
