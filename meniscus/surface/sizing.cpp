#include "meniscus/surface/sizing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/constants.hpp"
#include "meniscus/surface/gap.hpp"

namespace meniscus {
namespace {

/// Altitude over longest edge below which a face is a needle, whose normals say nothing of the
/// curvature across it.
constexpr double kNeedle = 0.2;

/// The normals interpolated linearly over a face turn by dn = W dx. These are half the trace of W,
/// its determinant, and the area of the smooth surface (a sphere to fourth order). On a sphere both
/// are exact, and K times the area sums to 4π as the Gauss map goes round once.
struct FaceTurn {
  double H, K, area;
};
FaceTurn face_turn(const FaceVertices& v, const SurfaceMesh& mesh, const SmoothSurface& surface) {
  const auto& n = surface.vertex_normals();
  const Vec3 e1 = mesh.x[v[1]] - mesh.x[v[0]], e2 = mesh.x[v[2]] - mesh.x[v[0]];
  const Vec3 n1 = n[v[1]] - n[v[0]], n2 = n[v[2]] - n[v[0]];
  const Vec3 a = e1.cross(e2);
  const double squared = a.squaredNorm(), norm = std::sqrt(squared);
  const double turning = n1.squaredNorm() + n2.squaredNorm() + (n2 - n1).squaredNorm();
  const double area = 0.5 * norm * (1.0 + turning / 24.0);
  const double longest = std::max({e1.squaredNorm(), e2.squaredNorm(), (e2 - e1).squaredNorm()});
  if (norm > kNeedle * longest)
    return {0.5 * (n1.dot(e2.cross(a)) + n2.dot(a.cross(e1))) / squared,
            n1.cross(n2).dot(a) / squared, area};
  FaceTurn turn{0.0, 0.0, area};
  for (const VertexId w : v) {
    const VertexCurvature& c = surface.vertex_curvature()[w];
    turn.H += c.half_sum() / 3.0;
    turn.K += c.k1 * c.k2 / 3.0;
  }
  return turn;
}

/// Means of what the faces hold over the cells of the vertices, which keep the integral.
class CellMeans {
 public:
  CellMeans(const SurfaceMesh& mesh, const FaceField<FaceTurn>& turns)
      : mesh_(mesh), turns_(turns), area_(mesh.num_vertices(), 0.0) {
    for (const FaceId f : mesh.faces.ids())
      for (const VertexId v : mesh.faces[f]) area_[v] += turns[f].area;
  }
  [[nodiscard]] VertexField<double> of(const FaceField<double>& values) const {
    VertexField<double> means(area_.size(), 0.0);
    for (const FaceId f : values.ids())
      for (const VertexId v : mesh_.faces[f]) means[v] += turns_[f].area * values[f];
    for (const VertexId v : means.ids()) means[v] /= area_[v];
    return means;
  }

 private:
  const SurfaceMesh& mesh_;
  const FaceField<FaceTurn>& turns_;
  VertexField<double> area_;
};

/// The mean over the corners of each face.
FaceField<double> corner_means(const VertexField<double>& values, const SurfaceMesh& mesh) {
  FaceField<double> means;
  for (const FaceVertices& v : mesh.faces)
    means.add((values[v[0]] + values[v[1]] + values[v[2]]) / 3.0);
  return means;
}

/// How much the value of each face exceeds the mean over its corners' cells.
FaceField<double> excess(const FaceField<double>& values, const VertexField<double>& cell_means,
                         const SurfaceMesh& mesh) {
  FaceField<double> result = corner_means(cell_means, mesh);
  for (const FaceId f : values.ids()) result[f] = values[f] - result[f];
  return result;
}

/// ⟨κ⟩² = 2H² − K at the vertices, ∮⟨κ⟩² dS as its faces have it. Q is what exceeds the mean over
/// the corners' cells.
///   On faces   H ← H + QH/8 + 1.2 Q²H,   ⟨κ⟩² = 2(H² + Σ(H_k − mean)²/12) − K,
/// H_k the means over the corners' cells. H as it comes is that of the edges. For a peak ½r² it is
/// h²/6 above the face's centre, and the face's mean is h²/12. Then QH = −2h²/3: hence 1/8. The
/// normals of the patches lose the curvature of waves by its fourth order. 1.2 makes ∮⟨κ⟩² right on
/// the mean over random smooth surfaces. 0.8 does it for waves of five edges on an even lattice.
///   At vertices   q ← q + 5/8 d · d²/(d² + (q̄/10)²),   q the mean over the cell.
/// d = q − q̄ is what it exceeds the mean of these over the cell by. For a peak this leads back from
/// that mean, 5h²/12 above the vertex's value, that of face means 2h²/3. A d of a few per cent is
/// noise of the fits, which would only make coarse meshes uneven.
struct CellCurvature {
  VertexField<double> squared_rms;  // ⟨κ⟩²
  VertexField<double> gaussian;     // K
};
CellCurvature cell_curvature(const SurfaceMesh& mesh, const SmoothSurface& surface) {
  constexpr double kFirst = 1.0 / 8.0, kSecond = 1.2, kSharper = 5.0 / 8.0, kNoise = 0.1;
  FaceField<FaceTurn> turns;
  FaceField<double> H, K;
  for (const FaceVertices& v : mesh.faces) {
    const FaceTurn turn = face_turn(v, mesh, surface);
    turns.add(turn);
    H.add(turn.H);
    K.add(turn.K);
  }
  const CellMeans cells(mesh, turns);
  const VertexField<double> corner_H = cells.of(H);
  const FaceField<double> first = excess(H, corner_H, mesh),
                          second = excess(first, cells.of(first), mesh);
  FaceField<double> squared(H.size());
  for (const FaceId f : H.ids()) {
    const double mean = H[f] - first[f];
    double variance = 0.0;
    for (const VertexId v : mesh.faces[f])
      variance += (corner_H[v] - mean) * (corner_H[v] - mean) / 12.0;
    H[f] += kFirst * first[f] + kSecond * second[f];
    squared[f] = 2.0 * (H[f] * H[f] + variance) - turns[f].K;
  }
  VertexField<double> result = cells.of(squared);
  const VertexField<double> blurred = cells.of(corner_means(result, mesh)), least = cells.of(H);
  for (const VertexId v : result.ids()) {
    const double more = result[v] - blurred[v], noise = kNoise * blurred[v];
    if (more != 0.0) result[v] += kSharper * more * more * more / (more * more + noise * noise);
    // No shape operator has less: noise of K must not feign a flat place.
    result[v] = std::max(result[v], least[v] * least[v]);
  }
  return {std::move(result), cells.of(K)};
}

/// Determinant over squared trace below which a ring shows a slope in one direction only.
constexpr double kRegular = 1e-3;

/// Ceiling over floor less 1, below which edges are even.
constexpr double kEqualBounds = 1e-6;

/// The floor, lowered so far that it leaves a small drop its fewest vertices.
double lowered_floor(double area, const RemeshOptions& options) {
  return std::min(options.edge_floor, 0.5 * length_of_density(options.min_vertices / area));
}

/// C0 and the floor, raised and lowered so far that they leave a small or round drop its fewest
/// vertices.
struct Allowance {
  double C0, edge_floor;
};
Allowance allowance(const VertexField<double>& squared_curvature, const SurfaceMesh& mesh,
                    const RemeshOptions& options) {
  const VertexField<double> areas = vertex_areas(mesh);
  double area = 0.0, integral = 0.0;
  for (const VertexId v : mesh.x.ids()) {
    area += areas[v];
    integral += areas[v] * squared_curvature[v];
  }
  return {std::max(options.C0, options.min_vertices / integral), lowered_floor(area, options)};
}

/// Lowers rest lengths on necks and threads, k1 being the largest principal curvature:
///   l0 ← l0^(1−w) min(l0, 2π/(n k1))^w,   w = 1 − 2K/⟨κ⟩² within [0, 1].
/// w is 1 on cylinders and saddles, and 0 where the smaller principal curvature is more than
/// 0.27 of the larger one.
void bound_by_necks(VertexField<double>& length, const CellCurvature& curvature,
                    double neck_edges) {
  for (const VertexId v : length.ids()) {
    const double squared = curvature.squared_rms[v];
    if (!(squared > 0.0)) continue;
    const double K = std::clamp(curvature.gaussian[v], -squared, squared);
    const double k1 = std::sqrt(0.5 * (squared + K)) + std::sqrt(0.5 * (squared - K));
    const double w = std::clamp(1.0 - 2.0 * K / squared, 0.0, 1.0);
    const double bound = 2.0 * std::numbers::pi / (neck_edges * k1);
    if (bound < length[v]) length[v] *= std::pow(bound / length[v], w);
  }
}

}  // namespace

double density_of_length(double rest_length) {
  return 2.0 / (std::numbers::sqrt3 * rest_length * rest_length);
}

double length_of_density(double density) {
  return std::sqrt(2.0 / (std::numbers::sqrt3 * density));
}

void limit_gradation(VertexField<double>& length, const SurfaceMesh& mesh,
                     const SurfaceTopology& topology, double gradation) {
  bool changed = true;
  while (changed) {
    changed = false;
    for (const SurfaceEdge& e : topology.edges()) {
      double &a = length[e.a], &b = length[e.b];
      const double reach = gradation * (mesh.x[e.a] - mesh.x[e.b]).norm();
      const double bound_a = b + reach, bound_b = a + reach;
      if (a > bound_a * (1.0 + 1e-12)) {
        a = bound_a;
        changed = true;
      } else if (b > bound_b * (1.0 + 1e-12)) {
        b = bound_b;
        changed = true;
      }
    }
  }
}

VertexField<Vec3> length_slopes(const VertexField<double>& length, const SurfaceMesh& mesh,
                                const SurfaceTopology& topology, const VertexField<Vec3>& normals) {
  VertexField<Vec3> slopes(length.size());
  for (const VertexId v : length.ids()) {
    const Vec3 &n = normals[v], t1 = n.unitOrthogonal(), t2 = n.cross(t1);
    double uu = 0.0, uv = 0.0, vv = 0.0, ru = 0.0, rv = 0.0;
    for (const VertexId w : topology.ring(v)) {
      const Vec3 d = mesh.x[w] - mesh.x[v];
      const double weight = 1.0 / d.squaredNorm(), a = d.dot(t1), b = d.dot(t2);
      const double rise = weight * (length[w] - length[v]);
      uu += weight * a * a;
      uv += weight * a * b;
      vv += weight * b * b;
      ru += rise * a;
      rv += rise * b;
    }
    const double det = uu * vv - uv * uv;
    const double regular = kRegular * (uu + vv) * (uu + vv);
    slopes[v] = det > regular ? Vec3(((vv * ru - uv * rv) * t1 + (uu * rv - uv * ru) * t2) / det)
                              : Vec3::Zero();
  }
  return slopes;
}

VertexField<double> rest_lengths(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                                 const SmoothSurface& surface, const RemeshOptions& options) {
  // Between equal bounds no curvature matters.
  if (const double least = lowered_floor(surface_area(mesh), options);
      options.edge_ceiling <= least * (1.0 + kEqualBounds))
    return {mesh.num_vertices(), least};
  const CellCurvature curvature = cell_curvature(mesh, surface);
  const VertexField<double>& squared = curvature.squared_rms;
  const auto [C0, edge_floor] = allowance(squared, mesh, options);
  VertexField<double> length(mesh.num_vertices());
  for (const VertexId v : mesh.x.ids()) {
    double l = std::min(length_of_density(C0 * squared[v]), options.edge_ceiling);
    if (options.size_bound) l = std::min(l, options.size_bound(mesh.x[v]));
    length[v] = l;
  }
  if (options.neck_edges > 0.0) {
    bound_by_necks(length, curvature, options.neck_edges);
    limit_gradation(length, mesh, topology, std::min(options.gradation, kNeckGradation));
  }
  if (options.gap_layers > 0.0)
    bound_by_gaps(length, mesh, surface.vertex_normals(), options.gap_layers, options.neighbours);
  for (double& l : length) l = std::max(l, edge_floor);
  limit_gradation(length, mesh, topology, options.gradation);
  return length;
}

}  // namespace meniscus
