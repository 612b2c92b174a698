#include "meniscus/volume/tet_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "meniscus/core/error.hpp"
#include "meniscus/geometry/tetrahedron.hpp"
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

/// What a half space leaves of a tetrahedron.
enum class Cut { none, part_left, nothing_left };
Cut cut_of(const HalfSpaceTet& tet, std::size_t k, const TetCorners& x) {
  std::size_t num_in = 0, num_out = 0;
  for (const Vec3& corner : x) {
    const double depth = tet.depth(k, corner);
    num_in += depth >= 0.0 ? 1 : 0;
    num_out += depth <= 0.0 ? 1 : 0;
  }
  if (num_out == 4) return Cut::nothing_left;
  return num_in == 4 ? Cut::none : Cut::part_left;
}

/// Leaves of the pieces what lies in a half space; `scratch` is room to work in.
void clip(const HalfSpaceTet& tet, std::size_t k, Pieces& pieces, Pieces& scratch) {
  scratch.size = 0;
  for (std::size_t i = 0; i < pieces.size; ++i) {
    std::array<double, 4> depth{};
    for (std::size_t j = 0; j < 4; ++j) depth[j] = tet.depth(k, pieces.tets[i][j]);
    add_positive_part(pieces.tets[i], depth, scratch);
  }
  std::copy_n(scratch.tets.begin(), scratch.size, pieces.tets.begin());
  pieces.size = scratch.size;
}

}  // namespace

VolumeMoments tet_moments(const TetCorners& tet) {
  const double volume = std::abs(six_volumes(tet)) / 6.0;
  return {volume, 0.25 * volume * (tet[0] + tet[1] + tet[2] + tet[3])};
}

HalfSpaceTet::HalfSpaceTet(const TetCorners& tet) : corners_(tet) {
  for (std::size_t k = 0; k < 4; ++k) {
    const auto& f = kFacets[k];
    inward_[k] = -(tet[f[1]] - tet[f[0]]).cross(tet[f[2]] - tet[f[0]]);
    offset_[k] = inward_[k].dot(tet[f[0]]);
  }
}

VolumeMoments tet_overlap(const HalfSpaceTet& a, const HalfSpaceTet& b) {
  std::array<Cut, 4> of_a, of_b;
  for (std::size_t k = 0; k < 4; ++k) {
    of_b[k] = cut_of(b, k, a.corners());
    if (of_b[k] == Cut::nothing_left) return {};
  }
  for (std::size_t k = 0; k < 4; ++k) {
    of_a[k] = cut_of(a, k, b.corners());
    if (of_a[k] == Cut::nothing_left) return {};
  }
  const auto is_none = [](Cut cut) { return cut == Cut::none; };
  if (std::ranges::all_of(of_a, is_none)) return tet_moments(b.corners());
  Pieces kept, cut;
  kept.tets[kept.size++] = a.corners();
  for (std::size_t k = 0; k < 4; ++k)
    if (of_b[k] != Cut::none) clip(b, k, kept, cut);
  VolumeMoments sum;
  for (std::size_t i = 0; i < kept.size; ++i) {
    const VolumeMoments piece = tet_moments(kept.tets[i]);
    sum.volume += piece.volume;
    sum.moment += piece.moment;
  }
  return sum;
}

TetPoint closest_point(const TetCorners& tet, const Vec3& p) {
  TetPoint inside{p, barycentric_coordinates(tet, p)};
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
