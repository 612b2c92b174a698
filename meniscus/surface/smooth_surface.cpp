#include "meniscus/surface/smooth_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "meniscus/core/error.hpp"
#include "meniscus/surface/rings.hpp"
#include "meniscus/surface/trust.hpp"

namespace meniscus {
namespace {

double height_above(const HeightPatch& patch, const Vec3& flat) {
  const Vec3 d = flat - patch.x;
  return patch.rolled_z(d.dot(patch.t1), d.dot(patch.t2)) - d.dot(patch.n);
}

/// How far a patch is to be trusted over the edges to its neighbours, 0 to 1.
double trust_near_edges(const HeightPatch& patch, std::span<const Vec3> neighbours) {
  double highest = 0.0;
  for (const Vec3& end : neighbours)
    highest = std::max(
        highest, std::abs(height_above(patch, 0.5 * (patch.x + end))) / (end - patch.x).norm());
  return trust(highest, kHighestMiddle);
}

/// The patch of the highest degree that the rings determine, as far as it is to be trusted. For the
/// rest, so that it follows the vertices without jumps, those of lower degrees.
HeightPatch patch_at(const HeightPatch& frame, std::span<const Vec3> rings, std::size_t valence,
                     std::vector<Vec3>& unrolled) {
  unroll(rings, frame, unrolled);
  HeightPatch result = frame;
  double missing = 1.0;
  for (const PatchDegree degree :
       {PatchDegree::cubic, PatchDegree::quadratic, PatchDegree::umbilic}) {
    const auto patch = fit_patch(frame, unrolled, degree);
    if (!patch) continue;
    const double share = missing * trust_near_edges(*patch, rings.first(valence));
    for (std::size_t k = 0; k < result.c.size(); ++k) result.c[k] += share * patch->c[k];
    missing -= share;
    if (missing == 0.0) break;
  }
  return result;
}

struct Lift {
  double height;  // of the patch above the flat point, along the patch's n
  Vec3 normal;
};

Lift lift(const HeightPatch& patch, const Vec3& flat) {
  const Vec3 d = flat - patch.x;
  const HeightPatch::Height h = patch.rolled_height(d.dot(patch.t1), d.dot(patch.t2));
  const double w = 1.0 / std::sqrt(1.0 + h.z_u * h.z_u + h.z_v * h.z_v);
  return {h.z - d.dot(patch.n), w * (patch.n - h.z_u * patch.t1 - h.z_v * patch.t2)};
}

/// What is fitted at a vertex.
struct Fit {
  VertexCurvature curvature;  // osculating
  std::array<double, 9> c{};  // of the patch over the plane normal to n of `curvature`
};
constexpr std::size_t kFitNumbers = 20;

void append(const Fit& fit, std::vector<double>& numbers) {
  const auto& [n, k1, k2, d1, d2] = fit.curvature;
  for (const Vec3& direction : {n, d1, d2})
    numbers.insert(numbers.end(), direction.begin(), direction.end());
  numbers.insert(numbers.end(), {k1, k2});
  numbers.insert(numbers.end(), fit.c.begin(), fit.c.end());
}

Fit unpacked(std::span<const double, kFitNumbers> numbers) {
  const auto direction = [&](std::size_t k) { return Vec3(&numbers[3 * k]); };
  Fit fit{.curvature = {.n = direction(0),
                        .k1 = numbers[9],
                        .k2 = numbers[10],
                        .d1 = direction(1),
                        .d2 = direction(2)}};
  std::ranges::copy(numbers.last<9>(), fit.c.begin());
  return fit;
}

/// The fits at the vertices from number `first` to before `end`.
std::vector<double> fits(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                         std::size_t first, std::size_t end) {
  RingGatherer rings(mesh, topology);
  std::vector<double> numbers;
  numbers.reserve(kFitNumbers * (end - first));
  std::vector<Vec3> unrolled;
  for (std::size_t k = first; k < end; ++k) {
    const VertexId v{static_cast<std::int32_t>(k)};
    Fit fit{.curvature = osculating_curvature(v, mesh, topology, rings, unrolled)};
    fit.c = patch_at(flat_patch(mesh.x[v], fit.curvature.n), rings.gather(v, true),
                     topology.ring(v).size(), unrolled)
                .c;
    append(fit, numbers);
  }
  return numbers;
}

}  // namespace

SmoothSurface::SmoothSurface(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                             const ShareNumbers& share)
    : curvature_(mesh.num_vertices()),
      patches_(mesh.num_vertices()),
      normals_(mesh.num_vertices()),
      faces_(mesh.faces) {
  const auto count = static_cast<std::size_t>(mesh.num_vertices());
  const std::vector<double> found =
      share(count, kFitNumbers,
            [&](std::size_t first, std::size_t end) { return fits(mesh, topology, first, end); });
  MENISCUS_ASSERT(found.size() == kFitNumbers * count, "{} {}", found.size(), count);
  for (const VertexId v : mesh.x.ids()) {
    const Fit fit = unpacked(std::span(found)
                                 .subspan(kFitNumbers * static_cast<std::size_t>(v.value))
                                 .first<kFitNumbers>());
    curvature_[v] = fit.curvature;
    HeightPatch& patch = patches_[v];
    patch = flat_patch(mesh.x[v], fit.curvature.n);
    patch.c = fit.c;
    normals_[v] = (patch.n - patch.c[0] * patch.t1 - patch.c[1] * patch.t2).normalized();
  }
}

SmoothSurface SmoothSurface::scaled(const Dilation& dilation) const {
  SmoothSurface result = *this;
  for (VertexCurvature& each : result.curvature_) {
    each.k1 /= dilation.factor;
    each.k2 /= dilation.factor;
  }
  for (HeightPatch& patch : result.patches_) patch = meniscus::scaled(patch, dilation);
  return result;
}

Vec3 SmoothSurface::flat_point(const SurfacePoint& location) const {
  const FaceVertices& v = faces_[location.face];
  return location.weights[0] * patches_[v[0]].x + location.weights[1] * patches_[v[1]].x +
         location.weights[2] * patches_[v[2]].x;
}

SmoothSurface::PointNormal SmoothSurface::at(const SurfacePoint& location) const {
  const FaceVertices& v = faces_[location.face];
  const Vec3 flat = flat_point(location);
  const Vec3 squares = location.weights.cwiseProduct(location.weights);
  const double total = squares.sum();
  MENISCUS_ASSERT(!(total <= 0.0), "no weights on face {}", location.face.value);
  PointNormal result{.x = flat, .n = Vec3::Zero()};
  for (int k = 0; k < 3; ++k) {
    if (squares[k] == 0.0) continue;
    const HeightPatch& patch = patches_[v[static_cast<std::size_t>(k)]];
    const Lift lifted = lift(patch, flat);
    const double w = squares[k] / total;
    result.x += w * lifted.height * patch.n;
    result.n += w * lifted.normal;
  }
  result.n.normalize();
  return result;
}

Vec3 SmoothSurface::point(const SurfacePoint& location) const {
  const FaceVertices& v = faces_[location.face];
  const Vec3 flat = flat_point(location);
  const Vec3 squares = location.weights.cwiseProduct(location.weights);
  Vec3 lift = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    if (squares[k] == 0.0) continue;
    const HeightPatch& patch = patches_[v[static_cast<std::size_t>(k)]];
    lift += squares[k] * height_above(patch, flat) * patch.n;
  }
  return flat + lift / squares.sum();
}

Vec3 SmoothSurface::edge_point(VertexId a, VertexId b, double s) const {
  const HeightPatch &pa = patches_[a], &pb = patches_[b];
  const Vec3 flat = (1.0 - s) * pa.x + s * pb.x;
  const double wa = (1.0 - s) * (1.0 - s), wb = s * s;
  return flat +
         (wa * height_above(pa, flat) * pa.n + wb * height_above(pb, flat) * pb.n) / (wa + wb);
}

}  // namespace meniscus
