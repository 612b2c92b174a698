#include <cmath>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/remesh.hpp"

namespace meniscus {
namespace {

constexpr double kVolumeTolerance = 1e-14;  // relative; a decade below what is promised
constexpr int kMaxNewtonSteps = 20;         // V(s) is a cubic: a small shift takes two or three

}  // namespace

double restore_volume(SurfaceMesh& mesh, double volume) {
  return restore_volume(mesh, volume, VertexField<double>(mesh.num_vertices(), 1.0));
}

double restore_volume(SurfaceMesh& mesh, double volume, const VertexField<double>& weights) {
  MENISCUS_ASSERT(volume > 0.0, "volume = {}", volume);
  VertexField<Vec3> direction = vertex_area_vectors(mesh);
  for (const VertexId v : direction.ids()) direction[v] *= weights[v] / direction[v].norm();
  const VertexField<Vec3> start = mesh.x;
  double shift = 0.0;
  double error = enclosed_volume(mesh) - volume;
  for (int step = 0; step < kMaxNewtonSteps && std::abs(error) > kVolumeTolerance * volume;
       ++step) {
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
