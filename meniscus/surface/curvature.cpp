#include "meniscus/surface/curvature.hpp"

#include <cmath>
#include <vector>

#include "meniscus/surface/height_patch.hpp"
#include "meniscus/surface/rings.hpp"

namespace meniscus {
namespace {

constexpr int kLeastValence = 5;  // a paraboloid with its normal free has five unknowns
constexpr int kMaxTurns = 30;     // each turn cuts the slope by a factor of order h; ten are usual
constexpr double kSlopeAtRest = 1e-8;  // radians; curvatures are exact to its square

/// What is fitted: heights above the tangent plane, or heights of circles.
enum class Form { paraboloid, osculating };

/// Fits and turns the frame until the linear terms vanish.
std::optional<HeightPatch> turned_fit(const Vec3& x, const Vec3& normal_guess,
                                      std::span<const Vec3> points, PatchDegree degree, Form form) {
  HeightPatch frame = flat_patch(x, normal_guess);
  std::vector<Vec3> unrolled;
  std::optional<HeightPatch> patch;
  for (int turn = 0; turn < kMaxTurns; ++turn) {
    if (form == Form::osculating) unroll(points, frame, unrolled);
    patch = fit_patch(frame, form == Form::osculating ? unrolled : points, degree);
    if (!patch) return std::nullopt;
    const double slope = std::hypot(patch->c[0], patch->c[1]);
    if (slope < kSlopeAtRest) return patch;
    // A fit that would turn the normal over is not one of a smooth surface.
    if (!(slope < 1.0)) return std::nullopt;
    const Vec3 normal = patch->n - patch->c[0] * patch->t1 - patch->c[1] * patch->t2;
    frame = flat_patch(x, normal.normalized());
  }
  return patch;
}

VertexCurvature curvature_at(VertexId v, const SurfaceMesh& mesh, const SurfaceTopology& topology,
                             RingGatherer& rings, Form form) {
  const auto fit = [&](bool with_second_ring, PatchDegree degree) {
    return turned_fit(mesh.x[v], rings.normal(v), rings.gather(v, with_second_ring), degree, form);
  };
  std::optional<HeightPatch> patch;
  if (topology.valence(v) >= kLeastValence) patch = fit(false, PatchDegree::quadratic);
  if (!patch) patch = fit(true, PatchDegree::quadratic);
  // Fewer than five neighbours to be seen within two rings: solids like the tetrahedron.
  if (!patch) patch = fit(true, PatchDegree::umbilic);
  return patch ? patch->curvature() : VertexCurvature{.n = rings.normal(v)};
}

VertexField<VertexCurvature> curvatures(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                                        Form form) {
  RingGatherer rings(mesh, topology);
  VertexField<VertexCurvature> result(mesh.num_vertices());
  for (const VertexId v : mesh.x.ids()) result[v] = curvature_at(v, mesh, topology, rings, form);
  return result;
}

}  // namespace

double VertexCurvature::rms() const { return std::sqrt(0.5 * (k1 * k1 + k2 * k2)); }

VertexField<VertexCurvature> fitted_curvature(const SurfaceMesh& mesh,
                                              const SurfaceTopology& topology) {
  return curvatures(mesh, topology, Form::paraboloid);
}

VertexField<VertexCurvature> osculating_curvature(const SurfaceMesh& mesh,
                                                  const SurfaceTopology& topology) {
  return curvatures(mesh, topology, Form::osculating);
}

}  // namespace meniscus
