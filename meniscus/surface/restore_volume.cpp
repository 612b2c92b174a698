#include "meniscus/surface/restore_volume.hpp"

#include <cmath>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {
namespace {

constexpr double kFlatTolerance = 1e-14;  // relative; a decade below what is promised
constexpr int kMaxNewtonSteps = 20;       // V(s) is a cubic: a small shift takes two or three

constexpr double kCurvedTolerance = 1e-12;  // relative
// The first shift leaves the O(h²) part by which curved and flat volumes answer it differently, a
// hundredth or so. From then on the secant knows it.
constexpr int kMostShifts = 30;
// What is left of the missing volume after the shifts is made up for by a change of scale. That is
// exact and costs no more middles.
constexpr double kLeftToScale = 0.1;

double restore_flat_volume(SurfaceMesh& mesh, double volume) {
  return restore_volume(mesh, volume, VertexField<double>(mesh.num_vertices(), 1.0));
}

/// Changes the scale about the centroid until the curved surface has its volume. The middles move
/// as the vertices do, so that V ∝ scale³ exactly. Returns how far the surface moves on average,
/// (scale − 1) 3V/A.
double scale_to_volume(SurfaceMesh& mesh, double from, double to, SurfaceShape shape,
                       KnownSurfaces& surfaces) {
  // A surface far off is crumpled; its curved volume says nothing.
  if (!(from > 0.5 * to && from < 2.0 * to)) return 0.0;
  const double scale = std::cbrt(to / from), area = surface_area(mesh);
  surfaces.scale(mesh, shape, {enclosed_centroid(mesh), scale});
  return (scale - 1.0) * 3.0 * from / area;
}

}  // namespace

double restore_volume(SurfaceMesh& mesh, double volume, SurfaceShape shape,
                      KnownSurfaces& surfaces) {
  MENISCUS_ASSERT(volume > 0.0, "volume = {}", volume);
  if (shape == SurfaceShape::faceted) return restore_flat_volume(mesh, volume);
  const auto volume_of = [&](const SurfaceMesh& at) { return surfaces.of(at, shape)->volume(); };
  double enclosed = volume_of(mesh);
  const double first = std::abs(volume - enclosed);
  double shift = 0.0;
  double gain = 1.0;  // what flat faces must gain for the curved ones to gain one
  for (int step = 0; step < kMostShifts; ++step) {
    const double missing = volume - enclosed;
    if (std::abs(missing) <= kCurvedTolerance * volume) return shift;
    if (step > 0 && std::abs(missing) <= kLeftToScale * first) break;
    const VertexField<Vec3> before = mesh.x;
    const double wanted = enclosed_volume(mesh) + gain * missing;
    if (!(wanted > 0.0)) break;  // crumpled faces
    const double moved = restore_flat_volume(mesh, wanted);
    const double shifted = volume_of(mesh), left = volume - shifted;
    if (!(std::abs(left) < std::abs(missing))) {
      mesh.x = before;
      break;
    }
    gain *= missing / (missing - left);
    shift += moved;
    enclosed = shifted;
  }
  return shift + scale_to_volume(mesh, enclosed, volume, shape, surfaces);
}

double restore_volume(SurfaceMesh& mesh, double volume, SurfaceShape shape) {
  KnownSurfaces surfaces;
  return restore_volume(mesh, volume, shape, surfaces);
}

double restore_volume(SurfaceMesh& mesh, double volume, const VertexField<double>& weights) {
  MENISCUS_ASSERT(volume > 0.0, "volume = {}", volume);
  MENISCUS_ASSERT(weights.size() == mesh.num_vertices(), "{} weights of {} vertices",
                  weights.size(), mesh.num_vertices());
  VertexField<Vec3> direction = vertex_area_vectors(mesh);
  for (const VertexId v : direction.ids()) direction[v] *= weights[v] / direction[v].norm();
  const VertexField<Vec3> start = mesh.x;
  double shift = 0.0;
  double error = enclosed_volume(mesh) - volume;
  for (int step = 0; step < kMaxNewtonSteps && std::abs(error) > kFlatTolerance * volume; ++step) {
    const VertexField<Vec3> area = vertex_area_vectors(mesh);
    double derivative = 0.0;  // dV/ds = Σ A_i·d_i
    for (const VertexId v : mesh.x.ids()) derivative += area[v].dot(direction[v]);
    shift -= error / derivative;
    for (const VertexId v : mesh.x.ids()) mesh.x[v] = start[v] + shift * direction[v];
    const double last = std::abs(error);
    error = enclosed_volume(mesh) - volume;
    if (std::abs(error) >= last && last <= 1e-13 * volume) break;  // round-off reached
  }
  return shift;
}

}  // namespace meniscus
