#include "meniscus/flow/bem/face_moments.hpp"

#include <cmath>

#include "meniscus/core/error.hpp"
#include "meniscus/geometry/quadrature.hpp"

namespace meniscus::bem {
namespace {

using Face = InterfaceElements::Face;
using Part = std::array<Vec3, 3>;  // barycentric corners of a part of a face

/// Largest size of a part over its distance. The seven-point rule then integrates both kernels to
/// about 1e-4 of their size.
constexpr double kSizePerDistance = 1.0;
constexpr int kMostQuarterings = 14;  // parts of 6e-5 of the face: surfaces that all but touch

using Values = std::array<double, kQuadraticNodes>;

/// The face's six functions at the points of the rule.
constexpr std::array<Values, kTriangleRule5.size()> kRuleValues = [] {
  std::array<Values, kTriangleRule5.size()> values{};
  for (std::size_t q = 0; q < values.size(); ++q)
    values[q] = quadratic_values(kTriangleRule5[q].barycentric);
  return values;
}();

void add_kernels(const Values& values, const LayerKernels& kernels, FaceMoments& moments) {
  for (std::size_t a = 0; a < values.size(); ++a) {
    moments.single[a] += values[a] * kernels.single;
    add(moments.double_layer[a], values[a], kernels.double_layer);
  }
}

void add_point(const Face& face, const QuadraturePoint<3>& point, const Vec3& x,
               FaceMoments& moments) {
  const TriangleShape<kQuadraticNodes> shape = quadratic_shape(point.barycentric);
  add_kernels(shape.value,
              layer_kernels(weighted_sum(shape.value, face.nodes) - x,
                            point.share * tangents(shape, face.nodes).area()),
              moments);
}

Vec3 point_of(const Face& face, const Vec3& b) {
  return weighted_sum(quadratic_values({b[0], b[1], b[2]}), face.nodes);
}

bool is_small_beside(double size, double distance) { return size <= kSizePerDistance * distance; }

FaceMoments no_moments() {
  FaceMoments moments;
  moments.single.fill(Vec3::Zero());
  return moments;
}

void add_part(const Face& face, const Part& b, int depth, const Vec3& x, FaceMoments& moments) {
  const double size = std::ldexp(face.size, -depth);
  const Vec3 middle = (b[0] + b[1] + b[2]) / 3.0;
  const double distance = (point_of(face, middle) - x).norm();
  if (!is_small_beside(size, distance) && depth < kMostQuarterings) {
    const Part half = {0.5 * (b[1] + b[2]), 0.5 * (b[2] + b[0]), 0.5 * (b[0] + b[1])};
    for (const Part& part : {Part{b[0], half[2], half[1]}, Part{half[2], b[1], half[0]},
                             Part{half[1], half[0], b[2]}, half})
      add_part(face, part, depth + 1, x, moments);
    return;
  }
  const double share = std::ldexp(1.0, -2 * depth);
  for (const auto& [w, part] : kTriangleRule5) {
    const Vec3 at = w[0] * b[0] + w[1] * b[1] + w[2] * b[2];
    add_point(face, {{at[0], at[1], at[2]}, share * part}, x, moments);
  }
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

FaceMoments corner_moments(const Face& face, std::size_t corner) {
  MENISCUS_ASSERT(corner < 3, "corner {}", corner);
  FaceMoments moments = no_moments();
  const Vec3& x = face.nodes[corner];
  for (const QuadraturePoint<3>& point : corner_rule(corner)) add_point(face, point, x, moments);
  return moments;
}

FaceMoments near_moments(const Face& face, const Vec3& x) {
  FaceMoments moments = no_moments();
  if (is_small_beside(face.size, (face.points[0].x - x).norm())) {  // the first point is the middle
    for (std::size_t q = 0; q < face.points.size(); ++q)
      add_kernels(kRuleValues[q], layer_kernels(face.points[q].x - x, face.points[q].area),
                  moments);
    return moments;
  }
  add_part(face, {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}, 0, x, moments);
  return moments;
}

}  // namespace meniscus::bem
