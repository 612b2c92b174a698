#include "meniscus/volume/tet_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "meniscus/core/error.hpp"
#include "meniscus/geometry/triangle.hpp"

namespace meniscus {
namespace {

// The facet opposite corner k, counter-clockwise seen from outside.
constexpr std::size_t kFacets[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
// A cut leaves at most three tetrahedra of one: 3⁴ after four cuts.
constexpr std::size_t kMostPieces = 81;

double six_volumes(const TetCorners& x) {
  return (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]);
}

/// Tetrahedra of either orientation on the stack.
struct Pieces {
  std::array<TetCorners, kMostPieces> tets;
  std::size_t size = 0;
  void add(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    MENISCUS_ASSERT(size < kMostPieces, "{} pieces", size);
    tets[size++] = {a, b, c, d};
  }
};

/// Three tetrahedra of the prism whose triangles a and b have corresponding corners.
void add_prism(const Triangle& a, const Triangle& b, Pieces& pieces) {
  pieces.add(a[0], a[1], a[2], b[2]);
  pieces.add(a[0], a[1], b[1], b[2]);
  pieces.add(a[0], b[0], b[1], b[2]);
}

/// Adds the part of a tetrahedron where the linear function with these corner values is positive.
void add_positive_part(const TetCorners& x, const std::array<double, 4>& value, Pieces& pieces) {
  std::array<std::size_t, 4> order{};
  std::size_t num_in = 0, num_out = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    if (value[k] > 0.0)
      order[num_in++] = k;
    else
      order[3 - num_out++] = k;
  }
  const auto cut = [&](std::size_t in, std::size_t out) -> Vec3 {
    const std::size_t i = order[in], o = order[out];
    return x[i] + value[i] / (value[i] - value[o]) * (x[o] - x[i]);
  };
  const auto at = [&](std::size_t k) -> const Vec3& { return x[order[k]]; };
  if (num_in == 4)
    pieces.add(x[0], x[1], x[2], x[3]);
  else if (num_in == 3)
    add_prism({at(0), at(1), at(2)}, {cut(0, 3), cut(1, 3), cut(2, 3)}, pieces);
  else if (num_in == 2)
    add_prism({at(0), cut(0, 2), cut(0, 3)}, {at(1), cut(1, 2), cut(1, 3)}, pieces);
  else if (num_in == 1)
    pieces.add(at(0), cut(0, 1), cut(0, 2), cut(0, 3));
}

}  // namespace

VolumeMoments tet_moments(const TetCorners& tet) {
  const double volume = std::abs(six_volumes(tet)) / 6.0;
  return {volume, 0.25 * volume * (tet[0] + tet[1] + tet[2] + tet[3])};
}

VolumeMoments tet_overlap(const TetCorners& a, const TetCorners& b) {
  Pieces kept, cut;
  kept.tets[kept.size++] = a;
  for (const auto& f : kFacets) {
    const Vec3& o = b[f[0]];
    const Vec3 inward = -(b[f[1]] - o).cross(b[f[2]] - o);
    cut.size = 0;
    for (std::size_t i = 0; i < kept.size; ++i) {
      std::array<double, 4> value{};
      for (std::size_t k = 0; k < 4; ++k) value[k] = inward.dot(kept.tets[i][k] - o);
      add_positive_part(kept.tets[i], value, cut);
    }
    if (cut.size == 0) return {};
    std::copy_n(cut.tets.begin(), cut.size, kept.tets.begin());
    kept.size = cut.size;
  }
  VolumeMoments sum;
  for (std::size_t i = 0; i < kept.size; ++i) {
    const VolumeMoments piece = tet_moments(kept.tets[i]);
    sum.volume += piece.volume;
    sum.moment += piece.moment;
  }
  return sum;
}

TetPoint closest_point(const TetCorners& tet, const Vec3& p) {
  const double whole = six_volumes(tet);
  MENISCUS_ASSERT(whole != 0.0, "a tetrahedron without volume");
  TetPoint inside{p, {}};
  for (std::size_t k = 0; k < 4; ++k) {
    TetCorners part = tet;
    part[k] = p;
    inside.weights[k] = six_volumes(part) / whole;
  }
  if (std::ranges::min(inside.weights) >= 0.0) return inside;
  TetPoint nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& f : kFacets) {
    const TrianglePoint q = closest_point(Triangle{tet[f[0]], tet[f[1]], tet[f[2]]}, p);
    const double squared = (q.point - p).squaredNorm();
    if (squared >= least) continue;
    least = squared;
    nearest.point = q.point;
    nearest.weights = {};
    for (int i = 0; i < 3; ++i) nearest.weights[f[i]] = q.weights[i];
  }
  return nearest;
}

}  // namespace meniscus
