#include "meniscus/surface/diffused.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_pieces.hpp"
#include "meniscus/mesh/surface_tree.hpp"
#include "meniscus/surface/isotropic_remesh.hpp"
#include "meniscus/surface/remesh.hpp"
#include "meniscus/surface/restore_volume.hpp"

namespace meniscus {
namespace {

constexpr double kPointsPerEdge = 2.0;
constexpr double kMostPoints = 2e6;  // 5 s, 32 MB
/// Distances are cut off at this many edges: what lies farther away has no effect.
constexpr double kReach = 2.0;
constexpr int kBorder = 3;     // lattice points beyond what is inside
constexpr double kEven = 0.7;  // edges of the result: what is left of a fold is still to be seen
constexpr double kNoCreases = 180.0;
constexpr int kBisections = 12;
constexpr double kLevelError = 1e-3;  // of the volume: a thousandth of an edge or so

Lattice signed_distance(const SurfaceMesh& mesh, double edge) {
  const SurfaceTree tree(mesh);
  const double reach = kReach * edge;
  const Vec3 extent = (tree.high() - tree.low()).array() + 2.0 * reach;
  Lattice lattice;
  lattice.spacing = std::max(edge / kPointsPerEdge, std::cbrt(extent.prod() / kMostPoints));
  lattice.low = tree.low().array() - reach - kBorder * lattice.spacing;
  for (int k = 0; k < 3; ++k)
    lattice.size[static_cast<std::size_t>(k)] =
        static_cast<int>(std::ceil(extent[k] / lattice.spacing)) + 2 * kBorder;
  lattice.values.reserve(lattice.index(0, 0, lattice.size[2]));
  for (int k = 0; k < lattice.size[2]; ++k)
    for (int j = 0; j < lattice.size[1]; ++j)
      for (int i = 0; i < lattice.size[0]; ++i) {
        const Vec3 x = lattice.position(i, j, k);
        const double distance = std::min(reach, tree.closest(x, reach).distance);
        lattice.values.push_back(encloses(tree, x) ? -distance : distance);
      }
  return lattice;
}

/// One explicit step of the heat equation along one axis: (a + 2b + c)/4 adds spacing²/2 to the
/// variance where `weight` is 1.
void diffuse_along(Lattice& lattice, std::size_t axis, double weight) {
  const std::size_t stride = axis == 0   ? 1
                             : axis == 1 ? static_cast<std::size_t>(lattice.size[0])
                                         : lattice.index(0, 0, 1);
  const std::size_t num = static_cast<std::size_t>(lattice.size[axis]);
  std::vector<double>& v = lattice.values;
  MENISCUS_ASSERT(v.size() == lattice.index(0, 0, lattice.size[2]), "{} values", v.size());
  for (std::size_t first = 0; first < v.size(); ++first) {
    if (first / stride % num != 0) continue;
    double before = v[first];
    for (std::size_t n = 0; n < num; ++n) {
      double& here = v[first + n * stride];
      const double after = n + 1 < num ? v[first + (n + 1) * stride] : here;
      const double old = here;
      here += 0.25 * weight * (before - 2.0 * old + after);
      before = old;
    }
  }
}

}  // namespace

DiffusedSurface::DiffusedSurface(const SurfaceMesh& mesh, double edge)
    : volume_(enclosed_volume(mesh)), edge_(edge), distance_(signed_distance(mesh, edge)) {
  MENISCUS_ASSERT(edge > 0.0 && volume_ > 0.0, "edge {}, volume {}", edge, volume_);
}

void DiffusedSurface::smooth_by(double variance) {
  const double step = 0.5 * distance_.spacing * distance_.spacing;
  for (; variance > 0.0; variance -= step)
    for (std::size_t axis = 0; axis < 3; ++axis)
      diffuse_along(distance_, axis, std::min(1.0, variance / step));
}

/// What is enclosed where the level keeps the volume to `kLevelError`.
SurfaceMesh DiffusedSurface::contour_of_volume() const {
  double low = -0.5 * kReach * edge_, high = 0.5 * kReach * edge_;
  SurfaceMesh surface = contour(distance_, 0.0);
  for (int i = 0; i < kBisections; ++i) {
    const double error = enclosed_volume(surface) / volume_ - 1.0;
    if (std::abs(error) < kLevelError) break;
    const double level = 0.5 * (low + high);
    surface = contour(distance_, level);
    (enclosed_volume(surface) < volume_ ? low : high) = level;
  }
  return surface;
}

std::optional<SurfaceMesh> DiffusedSurface::smoother_surface(double length, double most_lost) {
  MENISCUS_ASSERT(length >= 0.0 && most_lost > 0.0, "{} {}", length, most_lost);
  smooth_by(length * length - variance_);
  variance_ = std::max(variance_, length * length);
  std::vector<SurfaceMesh> pieces = connected_pieces(contour_of_volume());
  if (pieces.empty()) return std::nullopt;
  SurfaceMesh largest = std::move(*std::ranges::max_element(
      pieces, {}, [](const SurfaceMesh& piece) { return enclosed_volume(piece); }));
  if (std::abs(enclosed_volume(largest) / volume_ - 1.0) > most_lost) return std::nullopt;
  SurfaceMesh even = isotropic_remesh(largest, kEven * edge_, kNoCreases);
  restore_volume(even, volume_);
  return even;
}

}  // namespace meniscus
