#include "meniscus/mesh/contour.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <unordered_map>
#include <utility>

#include <Eigen/Geometry>

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

/// Least distance of a vertex from the ends of its lattice edge, in lengths of the edge. Closer to
/// them, triangles shrink to nothing where the surface passes through a lattice point.
constexpr double kClearance = 0.05;

/// The lattice points of one tetrahedron.
using Corners = std::array<std::array<int, 3>, 4>;

class Contour {
 public:
  Contour(const Lattice& lattice, double level) : lattice_(lattice), level_(level) {}

  void add_tetrahedron(Corners corners) {
    const auto outside = std::ranges::stable_partition(
        corners, [&](const auto& c) { return lattice_.values[index(c)] < level_; });
    const auto num_inside = 4 - std::ssize(outside);
    if (num_inside == 0 || num_inside == 4) return;
    const auto position = [&](std::size_t k) {
      return lattice_.position(corners[k][0], corners[k][1], corners[k][2]);
    };
    const bool is_right_handed = (position(1) - position(0))
                                     .cross(position(2) - position(0))
                                     .dot(position(3) - position(0)) > 0.0;
    const auto at = [&](std::size_t a, std::size_t b) { return vertex(corners[a], corners[b]); };
    if (num_inside == 1) {
      add({at(0, 1), at(0, 2), at(0, 3)}, is_right_handed);
    } else if (num_inside == 3) {
      add({at(0, 3), at(1, 3), at(2, 3)}, is_right_handed);
    } else {
      const VertexId a = at(0, 2), b = at(0, 3), c = at(1, 3), d = at(1, 2);
      add({a, b, c}, is_right_handed);
      add({a, c, d}, is_right_handed);
    }
  }
  [[nodiscard]] SurfaceMesh take() { return std::move(surface_); }

 private:
  [[nodiscard]] std::size_t index(const std::array<int, 3>& c) const {
    return lattice_.index(c[0], c[1], c[2]);
  }
  void add(FaceVertices f, bool is_outward) {
    if (!is_outward) std::swap(f[1], f[2]);
    surface_.faces.add(f);
  }
  /// The vertex on the edge of two lattice points, the first of them inside.
  VertexId vertex(const std::array<int, 3>& in, const std::array<int, 3>& out) {
    const std::uint64_t key = edge_key(in, out);
    const auto [found, is_new] = known_.try_emplace(key);
    if (!is_new) return found->second;
    const double a = lattice_.values[index(in)], b = lattice_.values[index(out)];
    MENISCUS_ASSERT(a < level_ && b >= level_, "{} and {} about {}", a, b, level_);
    const double t = std::clamp((level_ - a) / (b - a), kClearance, 1.0 - kClearance);
    const Vec3 from = lattice_.position(in[0], in[1], in[2]),
               to = lattice_.position(out[0], out[1], out[2]);
    return found->second = surface_.x.add(from + t * (to - from));
  }
  /// Edges run from the lower of their ends by 0 or 1 along each axis.
  [[nodiscard]] std::uint64_t edge_key(const std::array<int, 3>& a,
                                       const std::array<int, 3>& b) const {
    const std::uint64_t i = index(a), j = index(b);
    std::uint64_t direction = 0;
    for (std::size_t k = 0; k < 3; ++k) direction = 2 * direction + (a[k] != b[k] ? 1 : 0);
    return 8 * std::min(i, j) + direction;
  }

  const Lattice& lattice_;
  double level_;
  SurfaceMesh surface_;
  std::unordered_map<std::uint64_t, VertexId> known_;
};

/// The paths along the edges of a cube from its lowest corner to its highest, as orders of axes.
/// There is one tetrahedron each, the same on both sides of every square.
constexpr std::array<std::array<std::size_t, 3>, 6> kPaths{
    {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};

}  // namespace

SurfaceMesh contour(const Lattice& lattice, double level) {
  MENISCUS_ASSERT(lattice.values.size() == lattice.index(0, 0, lattice.size[2]), "{} values",
                  lattice.values.size());
  Contour surface(lattice, level);
  for (int k = 0; k + 1 < lattice.size[2]; ++k)
    for (int j = 0; j + 1 < lattice.size[1]; ++j)
      for (int i = 0; i + 1 < lattice.size[0]; ++i)
        for (const auto& path : kPaths) {
          Corners corners;
          corners[0] = {i, j, k};
          for (std::size_t n = 0; n < 3; ++n) {
            corners[n + 1] = corners[n];
            ++corners[n + 1][path[n]];
          }
          surface.add_tetrahedron(corners);
        }
  return surface.take();
}

}  // namespace meniscus
