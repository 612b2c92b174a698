#include "meniscus/flow/bem/layer_sums.hpp"

#include <cmath>

#include "meniscus/core/error.hpp"
#include "meniscus/core/vector_clones.hpp"

// The sums are reassociated (omp simd), in an order that only the width of the vectors decides.

namespace meniscus::bem {
namespace {

struct Sum3 {
  double x = 0.0, y = 0.0, z = 0.0;
};

struct Point {
  double x, y, z;
};

struct Arrays {
  const double* __restrict__ x, * __restrict__ y, * __restrict__ z;
  const double* __restrict__ ax, * __restrict__ ay, * __restrict__ az;
};

Arrays arrays(const SourcePoints& points, std::size_t first) {
  return {points.x.data() + first,  points.y.data() + first,  points.z.data() + first,
          points.ax.data() + first, points.ay.data() + first, points.az.data() + first};
}

MENISCUS_VECTOR_CLONES
Sum3 single_layer(Arrays s, const double* __restrict__ q, std::size_t n, Point p) {
  double x = 0.0, y = 0.0, z = 0.0;
#pragma omp simd reduction(+ : x, y, z)
  for (std::size_t j = 0; j < n; ++j) {
    const double rx = s.x[j] - p.x, ry = s.y[j] - p.y, rz = s.z[j] - p.z;
    const double squared = rx * rx + ry * ry + rz * rz;
    const double inverse = squared > 0.0 ? 1.0 / std::sqrt(squared) : 0.0;
    const double along = (rx * s.ax[j] + ry * s.ay[j] + rz * s.az[j]) * inverse * inverse;
    const double factor = q[j] * inverse;
    x += factor * (s.ax[j] + along * rx);
    y += factor * (s.ay[j] + along * ry);
    z += factor * (s.az[j] + along * rz);
  }
  return {x, y, z};
}

MENISCUS_VECTOR_CLONES
Sum3 spread_forces(Arrays s, const double* __restrict__ spread, std::size_t n, Point p) {
  double x = 0.0, y = 0.0, z = 0.0;
#pragma omp simd reduction(+ : x, y, z)
  for (std::size_t j = 0; j < n; ++j) {
    const double rx = s.x[j] - p.x, ry = s.y[j] - p.y, rz = s.z[j] - p.z;
    const double squared = rx * rx + ry * ry + rz * rz + spread[j];
    const double inverse = 1.0 / std::sqrt(squared);
    const double inverse3 = inverse * inverse * inverse;
    const double along = (rx * s.ax[j] + ry * s.ay[j] + rz * s.az[j]) * inverse3;
    const double across = (squared + spread[j]) * inverse3;
    x += across * s.ax[j] + along * rx;
    y += across * s.ay[j] + along * ry;
    z += across * s.az[j] + along * rz;
  }
  return {x, y, z};
}

MENISCUS_VECTOR_CLONES
Sum3 double_layer(Arrays s, const double* __restrict__ ux, const double* __restrict__ uy,
                  const double* __restrict__ uz, std::size_t n, Point p) {
  double x = 0.0, y = 0.0, z = 0.0;
#pragma omp simd reduction(+ : x, y, z)
  for (std::size_t j = 0; j < n; ++j) {
    const double rx = s.x[j] - p.x, ry = s.y[j] - p.y, rz = s.z[j] - p.z;
    const double squared = rx * rx + ry * ry + rz * rz;
    const double inverse = squared > 0.0 ? 1.0 / std::sqrt(squared) : 0.0;
    const double inverse2 = inverse * inverse;
    const double factor = (rx * s.ax[j] + ry * s.ay[j] + rz * s.az[j]) *
                          (rx * ux[j] + ry * uy[j] + rz * uz[j]) * (inverse2 * inverse2 * inverse);
    x += factor * rx;
    y += factor * ry;
    z += factor * rz;
  }
  return {x, y, z};
}

MENISCUS_VECTOR_CLONES
void constant_layers(Arrays s, std::size_t n, Point p, double* sums) {
  double x = 0.0, y = 0.0, z = 0.0, xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0, xz = 0.0, yz = 0.0;
#pragma omp simd reduction(+ : x, y, z, xx, yy, zz, xy, xz, yz)
  for (std::size_t j = 0; j < n; ++j) {
    const double rx = s.x[j] - p.x, ry = s.y[j] - p.y, rz = s.z[j] - p.z;
    const double squared = rx * rx + ry * ry + rz * rz;
    const double inverse = squared > 0.0 ? 1.0 / std::sqrt(squared) : 0.0;
    const double inverse2 = inverse * inverse;
    const double along = (rx * s.ax[j] + ry * s.ay[j] + rz * s.az[j]) * inverse * inverse2;
    x += inverse * s.ax[j] + along * rx;
    y += inverse * s.ay[j] + along * ry;
    z += inverse * s.az[j] + along * rz;
    const double factor = along * inverse2;
    xx += factor * rx * rx;
    yy += factor * ry * ry;
    zz += factor * rz * rz;
    xy += factor * rx * ry;
    xz += factor * rx * rz;
    yz += factor * ry * rz;
  }
  const double all[] = {x, y, z, xx, yy, zz, xy, xz, yz};
  for (int k = 0; k < 9; ++k) sums[k] = all[k];
}

}  // namespace

void SourcePoints::add(const Vec3& at, const Vec3& a) {
  x.push_back(at.x());
  y.push_back(at.y());
  z.push_back(at.z());
  ax.push_back(a.x());
  ay.push_back(a.y());
  az.push_back(a.z());
}

Vec3 single_layer_sum(const SourcePoints& points, const std::vector<double>& q, const Vec3& p) {
  return single_layer_sum(points, {.begin = 0, .end = points.size()}, q, p);
}

Vec3 single_layer_sum(const SourcePoints& points, SourceRange range, const std::vector<double>& q,
                      const Vec3& p) {
  MENISCUS_ASSERT(q.size() == static_cast<std::size_t>(range.end - range.begin),
                  "{} densities of {} points", q.size(), range.end - range.begin);
  const Sum3 sum = single_layer(arrays(points, static_cast<std::size_t>(range.begin)), q.data(),
                                q.size(), {p.x(), p.y(), p.z()});
  return {sum.x, sum.y, sum.z};
}

Vec3 spread_forces_sum(const SourcePoints& points, const std::vector<double>& spread,
                       const Vec3& p) {
  MENISCUS_ASSERT(spread.size() == points.x.size(), "{} lengths of {} points", spread.size(),
                  points.x.size());
  const Sum3 sum =
      spread_forces(arrays(points, 0), spread.data(), spread.size(), {p.x(), p.y(), p.z()});
  return {sum.x, sum.y, sum.z};
}

Vec3 double_layer_sum(const SourcePoints& points, const SourceVectors& u, const Vec3& p) {
  const Sum3 sum = double_layer(arrays(points, 0), u.x.data(), u.y.data(), u.z.data(),
                                points.x.size(), {p.x(), p.y(), p.z()});
  return {sum.x, sum.y, sum.z};
}

ConstantLayers constant_layer_sums(const SourcePoints& points, SourceRange range, const Vec3& p) {
  std::array<double, 9> sums{};
  constant_layers(arrays(points, static_cast<std::size_t>(range.begin)),
                  static_cast<std::size_t>(range.end - range.begin), {p.x(), p.y(), p.z()},
                  sums.data());
  return {.single = {sums[0], sums[1], sums[2]},
          .double_layer = {sums[3], sums[4], sums[5], sums[6], sums[7], sums[8]}};
}

}  // namespace meniscus::bem
