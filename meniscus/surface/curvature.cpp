#include "meniscus/surface/curvature.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "meniscus/surface/height_patch.hpp"
#include "meniscus/surface/rings.hpp"

namespace meniscus {
namespace {

constexpr int kLeastValence = 5;       // a paraboloid with its normal free has five unknowns
constexpr int kMaxTurns = 30;          // two are usual
constexpr double kSlopeAtRest = 1e-8;  // radians

/// What is fitted: heights above the tangent plane, or heights of circles.
enum class Form { paraboloid, osculating };

/// Fits and turns the frame until the linear terms vanish, by the secant method. A turn changes the
/// slope by itself times 1 + O(h), nearly the same each time.
std::optional<HeightPatch> turned_fit(const Vec3& x, const Vec3& normal_guess,
                                      std::span<const Vec3> points, PatchDegree degree, Form form,
                                      std::vector<Vec3>& unrolled) {
  HeightPatch frame = flat_patch(x, normal_guess);
  std::optional<HeightPatch> patch;
  Vec3 slope_before = Vec3::Zero(), turn_before = Vec3::Zero();
  for (int turn = 0; turn < kMaxTurns; ++turn) {
    if (form == Form::osculating) unroll(points, frame, unrolled);
    patch = fit_patch(frame, form == Form::osculating ? unrolled : points, degree);
    if (!patch) return std::nullopt;
    const Vec3 slope = patch->c[0] * patch->t1 + patch->c[1] * patch->t2;
    const double size = slope.norm();
    if (size < kSlopeAtRest) return patch;
    // A fit that would turn the normal over is not one of a smooth surface.
    if (!(size < 1.0)) return std::nullopt;
    double gain = 1.0;  // of slope by a turn
    if (turn > 0)
      gain =
          std::clamp((slope_before - slope).dot(turn_before) / turn_before.squaredNorm(), 0.5, 2.0);
    slope_before = slope;
    turn_before = slope / gain;
    frame = flat_patch(x, (patch->n - turn_before).normalized());
  }
  return patch;
}

VertexCurvature curvature_at(VertexId v, const SurfaceMesh& mesh, const SurfaceTopology& topology,
                             RingGatherer& rings, Form form, std::vector<Vec3>& unrolled) {
  const auto fit = [&](bool with_second_ring, PatchDegree degree) {
    return turned_fit(mesh.x[v], rings.normal(v), rings.gather(v, with_second_ring), degree, form,
                      unrolled);
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
  std::vector<Vec3> unrolled;
  VertexField<VertexCurvature> result(mesh.num_vertices());
  for (const VertexId v : mesh.x.ids())
    result[v] = curvature_at(v, mesh, topology, rings, form, unrolled);
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

VertexCurvature osculating_curvature(VertexId v, const SurfaceMesh& mesh,
                                     const SurfaceTopology& topology, RingGatherer& rings,
                                     std::vector<Vec3>& unrolled) {
  return curvature_at(v, mesh, topology, rings, Form::osculating, unrolled);
}

}  // namespace meniscus
