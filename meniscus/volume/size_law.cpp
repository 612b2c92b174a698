#include "meniscus/volume/size_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {
namespace {

/// Layers of the surfaces' own edges that a gap may hold and still count as one: above 1/kGapEdge,
/// the width that the surfaces have been remeshed for, by more than the error of the distances (a
/// fifth); low enough that a sphere of 110 vertices, 5.5 edges across, is none for three layers.
constexpr double kNarrow = 1.75;

VertexField<double> mean_edge_at_vertices(const SurfaceMesh& mesh) {
  VertexField<double> sum(mesh.num_vertices(), 0.0), count(mesh.num_vertices(), 0.0);
  for (const FaceVertices& v : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = v[k], b = v[(k + 1) % 3];
      const double length = (mesh.x[b] - mesh.x[a]).norm();
      for (const VertexId end : {a, b}) {
        sum[end] += length;
        count[end] += 1.0;
      }
    }
  for (const VertexId v : mesh.x.ids()) sum[v] /= std::max(1.0, count[v]);
  return sum;
}

/// The surface that encloses each interface: interface i where its outside is region i + 1, the
/// outer boundary (numbered after the interfaces) where it is the matrix.
std::vector<std::size_t> containers(const Scene& scene) {
  std::vector<std::size_t> result;
  for (const Interface& interface : scene.interfaces)
    result.push_back(interface.outside == RegionId{0}
                         ? scene.interfaces.size()
                         : static_cast<std::size_t>(interface.outside.value - 1));
  return result;
}

std::size_t depth(const std::vector<std::size_t>& container, std::size_t i) {
  std::size_t steps = 0;
  for (; i < container.size() && steps <= container.size(); i = container[i]) ++steps;
  return steps;
}

}  // namespace

double graded_size(Grading grading, double h_s, double d_s, double h_b, double d_b) {
  const double s = d_s + d_b > 0.0 ? d_s / (d_s + d_b) : 0.0;
  switch (grading) {
    case Grading::linear:
      return h_s + (h_b - h_s) * s;
    case Grading::exponential:
      return h_s * std::pow(h_b / h_s, s);
    case Grading::gaussian:
      return h_b + (h_s - h_b) * (std::exp(-4.5 * s * s) - std::exp(-4.5)) / (1.0 - std::exp(-4.5));
  }
  return h_s;
}

double gap_size(double width, double layers, double h) {
  if (width > kNarrow * layers * h) return std::numeric_limits<double>::infinity();
  return std::max(kGapEdge * width / layers, h);
}

SizeLaw::Sized::Sized(const SurfaceMesh& surface, double gap_layers)
    : mesh(&surface), tree(surface), size(mean_edge_at_vertices(surface)) {
  if (gap_layers == 0.0) return;
  VertexField<Vec3> normals = vertex_area_vectors(surface);
  for (Vec3& n : normals) n.normalize();
  VertexField<double> reach = size;
  for (double& r : reach) r *= kNarrow * gap_layers;
  gaps = own_gaps(surface, tree, normals, reach);
}

SizeLaw::Sized::Nearest SizeLaw::Sized::nearest(const Vec3& x) const {
  // A fifth is within what a mesher makes of a wanted size, and costs half of an exact search.
  constexpr double kSlack = 0.2;
  const SurfaceTree::Hit hit = tree.closest(x, std::numeric_limits<double>::infinity(), kSlack);
  Nearest result{hit.distance, 0.0};
  for (std::size_t k = 0; k < 3; ++k)
    result.size += hit.weights[static_cast<int>(k)] * size[mesh->faces[hit.face][k]];
  if (gaps.inside.empty()) return result;
  const auto narrowest = [&](const VertexField<double>& widths) {
    const FaceVertices& v = mesh->faces[hit.face];
    return std::min({widths[v[0]], widths[v[1]], widths[v[2]]});
  };
  result.inside = narrowest(gaps.inside);
  result.outside = narrowest(gaps.outside);
  return result;
}

SizeLaw::SizeLaw(const Scene& scene, const VolumeMeshOptions& options)
    : options_(options), container_(containers(scene)), inside_first_(scene.interfaces.size()) {
  surfaces_.reserve(scene.interfaces.size() + 1);
  for (const Interface& interface : scene.interfaces)
    surfaces_.emplace_back(interface.mesh, options.gap_layers);
  surfaces_.emplace_back(scene.boundary.mesh, 0.0);  // convex or far: it has no gap of its own
  std::iota(inside_first_.begin(), inside_first_.end(), std::size_t{0});
  std::ranges::stable_sort(inside_first_, std::greater<>(),
                           [&](std::size_t i) { return depth(container_, i); });
}

std::size_t SizeLaw::enclosing_surface(const Vec3& x) const {
  const auto innermost = std::ranges::find_if(
      inside_first_, [&](std::size_t i) { return encloses(surfaces_[i].tree, x); });
  return innermost == inside_first_.end() ? container_.size() : *innermost;
}

double SizeLaw::bounded_by_gap(double size, const Sized::Nearest& a,
                               const Sized::Nearest& b) const {
  return std::min(size,
                  gap_size(a.distance + b.distance, options_.gap_layers, std::min(a.size, b.size)));
}

double SizeLaw::operator()(const Vec3& x) const {
  const bool with_gaps = options_.gap_layers > 0.0;
  const std::size_t enclosing = enclosing_surface(x);
  const Sized::Nearest outer = surfaces_[enclosing].nearest(x);
  bool has_inner = false;
  double size = outer.size + options_.interior_growth * outer.distance;
  double bound = std::numeric_limits<double>::infinity();
  if (with_gaps && enclosing < container_.size())
    bound = gap_size(outer.inside, options_.gap_layers, outer.size);
  std::vector<Sized::Nearest> inners;
  for (std::size_t i = 0; i < container_.size(); ++i) {
    if (container_[i] != enclosing) continue;
    const Sized::Nearest inner = surfaces_[i].nearest(x);
    const double law =
        graded_size(options_.grading, inner.size, inner.distance, outer.size, outer.distance);
    size = has_inner ? std::min(size, law) : law;
    has_inner = true;
    if (!with_gaps) continue;
    bound = std::min(bound, gap_size(inner.outside, options_.gap_layers, inner.size));
    bound = bounded_by_gap(bound, inner, outer);
    for (const Sized::Nearest& other : inners) bound = bounded_by_gap(bound, inner, other);
    inners.push_back(inner);
  }
  return std::min(size, bound);
}

}  // namespace meniscus
