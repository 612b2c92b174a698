#include "meniscus/volume/size_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "meniscus/linear/shared_work.hpp"
#include "meniscus/mesh/sphere_radius.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/sizing.hpp"

namespace meniscus {
namespace {

/// Layers of the surfaces' own edges that a gap may hold and still count as one. The surfaces have
/// been remeshed for the width 1/kGapEdge. This is above it by more than the error of the distances
/// (a fifth). It is low enough that a sphere of 110 vertices, 5.5 edges across, is none for three
/// layers.
constexpr double kNarrow = 1.75;
/// Volume of the cells at the finest places, over that elsewhere at the same edge.
constexpr double kFineVolume = 2.0;
constexpr double kRoundOff = 1.0 + 1e-12;  // of bounds that may leave surfaces out

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

/// The surface that encloses each interface: interface i where its outside is region i + 1. It is
/// the outer boundary, numbered after the interfaces, where that is the matrix.
std::vector<std::size_t> containers(const Scene& scene) {
  std::vector<std::size_t> result;
  result.reserve(scene.interfaces.size());
  for (const Interface& interface : scene.interfaces)
    result.push_back(interface.outside == RegionId{0}
                         ? scene.interfaces.size()
                         : static_cast<std::size_t>(interface.outside.value - 1));
  return result;
}

/// Edge of the sphere of an interface's volume and resolution [R0].
double even_edge(const Interface& interface) {
  return length_of_density(interface.C0) * sphere_radius(enclosed_volume(interface.mesh));
}

std::size_t depth(const std::vector<std::size_t>& container, std::size_t i) {
  std::size_t steps = 0;
  for (; i < container.size() && steps <= container.size(); i = container[i]) ++steps;
  return steps;
}

}  // namespace

double least_growth(double C0) {
  constexpr double kMost = 1.0 / 3.0, kOf = 200.0 / (4.0 * std::numbers::pi);
  return kMost * std::min(1.0, std::sqrt(kOf / C0));
}

double fineness(double edge, double even_edge) {
  constexpr double kFrom = 1.0 / 3.0, kWhole = 1.0 / 6.0;
  return std::clamp((kFrom - edge / even_edge) / (kFrom - kWhole), 0.0, 1.0);
}

double graded_size(Grading grading, double h_s, double d_s, double h_b, double d_b,
                   const LeastSize& least) {
  const double s = d_s + d_b > 0.0 ? d_s / (d_s + d_b) : 0.0;
  switch (grading) {
    case Grading::linear:
      return h_s + (h_b - h_s) * s;
    case Grading::exponential:
      return h_s * std::pow(h_b / h_s, s);
    case Grading::gaussian:
      return std::max(
          h_b + (h_s - h_b) * (std::exp(-4.5 * s * s) - std::exp(-4.5)) / (1.0 - std::exp(-4.5)),
          std::min(least.start + least.growth * d_s, h_b));
  }
  return h_s;
}

double gap_size(double width, double layers, double h) {
  if (width > kNarrow * layers * h) return std::numeric_limits<double>::infinity();
  return std::max(kGapEdge * width / layers, h);
}

SizeLaw::Sized::Sized(const SurfaceMesh& surface, double gap_layers, double growth,
                      double even_edge)
    : mesh(&surface), tree(surface), size(mean_edge_at_vertices(surface)), least_growth(growth) {
  start = VertexField<double>(size.size(), 0.0);
  for (const VertexId v : size.ids()) {
    const double share = even_edge > 0.0 ? fineness(size[v], even_edge) : 0.0;
    size[v] *= std::cbrt(1.0 + share * (kFineVolume - 1.0));
    start[v] = share * size[v];
  }
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
  for (std::size_t k = 0; k < 3; ++k) {
    const double weight = hit.weights[static_cast<int>(k)];
    result.size += weight * size[mesh->faces[hit.face][k]];
    result.start += weight * start[mesh->faces[hit.face][k]];
  }
  if (gaps.inside.empty()) return result;
  const auto narrowest = [&](const VertexField<double>& widths) {
    const FaceVertices& v = mesh->faces[hit.face];
    return std::min({widths[v[0]], widths[v[1]], widths[v[2]]});
  };
  result.inside = narrowest(gaps.inside);
  result.outside = narrowest(gaps.outside);
  return result;
}

bool SizeLaw::Sized::has_outside_gap() const {
  return std::ranges::any_of(gaps.outside, [](double width) { return std::isfinite(width); });
}

SizeLaw::Inner::Inner(std::span<const Sized> surfaces, std::vector<std::size_t> of)
    : members(std::move(of)), boxes(boxes_of(surfaces, members)) {
  for (std::size_t position = 0; position < members.size(); ++position) {
    const Sized& surface = surfaces[members[position]];
    const auto [least, largest] = std::ranges::minmax(surface.size);
    least_size = std::min(least_size, least);
    largest_size = std::max(largest_size, largest);
    least_growth = std::min(least_growth, surface.least_growth);
    if (surface.has_outside_gap()) folded.push_back(position);
  }
}

BoxTree SizeLaw::boxes_of(std::span<const Sized> surfaces, std::span<const std::size_t> members) {
  std::vector<Box> boxes;
  for (const std::size_t i : members) boxes.push_back(surfaces[i].box());
  return BoxTree(boxes);
}

SizeLaw::SizeLaw(const Scene& scene, const VolumeMeshOptions& options)
    : options_(options), container_(containers(scene)), inside_first_(scene.interfaces.size()) {
  surfaces_.reserve(scene.interfaces.size() + 1);
  for (const Interface& interface : scene.interfaces)
    surfaces_.emplace_back(interface.mesh, options.gap_layers, least_growth(interface.C0),
                           options.grading == Grading::gaussian ? even_edge(interface) : 0.0);
  surfaces_.emplace_back(scene.boundary.mesh, 0.0);  // convex or far: it has no gap of its own
  std::iota(inside_first_.begin(), inside_first_.end(), std::size_t{0});
  std::ranges::stable_sort(inside_first_, std::greater<>(),
                           [&](std::size_t i) { return depth(container_, i); });
  boxes_ = boxes_of(surfaces_, inside_first_);
  std::vector<std::vector<std::size_t>> members(surfaces_.size());
  for (std::size_t i = 0; i < container_.size(); ++i) members[container_[i]].push_back(i);
  for (std::vector<std::size_t>& each : members) inner_.emplace_back(surfaces_, std::move(each));
}

std::size_t SizeLaw::enclosing_surface(const Vec3& x, std::size_t on) const {
  std::vector<std::size_t> around;
  boxes_.visit_within(Box(x), 0.0, [&](std::size_t rank) { around.push_back(rank); });
  std::ranges::sort(around);
  const auto innermost = std::ranges::find_if(around, [&](std::size_t rank) {
    return inside_first_[rank] != on && encloses(surfaces_[inside_first_[rank]].tree, x);
  });
  return innermost == around.end() ? container_.size() : inside_first_[*innermost];
}

SizeLaw::Sized::Nearest SizeLaw::ask(std::size_t surface, const Vec3& x) const {
  ++num_searches_;
  return surfaces_[surface].nearest(x);
}

const SizeLaw::Sized::Nearest& SizeLaw::ask_member(std::size_t position, Around& around) const {
  const auto known = std::ranges::find(around.asked, position, &Asked::position);
  if (known != around.asked.end()) return known->nearest;
  return around.asked.emplace_back(position, ask(around.inner->members[position], around.x))
      .nearest;
}

double SizeLaw::least_law(Around& around) const {
  const Inner& inner = *around.inner;
  const Sized::Nearest& outer = around.outer;
  if (inner.members.empty()) return outer.size + options_.interior_growth * outer.distance;
  // The law rises with the size and the distance of the inner surface if that is the finer one.
  const bool is_finer = inner.least_size <= outer.size;
  return inner.boxes.least(
      around.x,
      [&](double distance) {
        return is_finer ? graded_size(options_.grading, inner.least_size, distance, outer.size,
                                      outer.distance, {0.0, inner.least_growth}) /
                              kRoundOff
                        : 0.0;
      },
      [&](std::size_t position) {
        const Sized::Nearest at = ask_member(position, around);
        return graded_size(options_.grading, at.size, at.distance, outer.size, outer.distance,
                           {at.start, surfaces_[inner.members[position]].least_growth});
      });
}

void SizeLaw::ask_sides_of_gaps(double widest, Around& around) const {
  const Inner& inner = *around.inner;
  for (const std::size_t position : inner.folded) ask_member(position, around);
  struct Side {
    double distance;  // at least
    std::size_t position;
  };
  std::vector<Side> sides;
  const Box at(around.x);
  inner.boxes.visit_within(at, widest, [&](std::size_t position) {
    sides.push_back({inner.boxes.distance(position, around.x), position});
  });
  std::ranges::sort(sides, {},
                    [](const Side& side) { return std::pair(side.distance, side.position); });
  for (std::size_t i = 0; i < sides.size(); ++i) {
    double opposite = around.outer.distance;
    for (std::size_t j = 0; j < sides.size(); ++j)
      if (j != i) opposite = std::min(opposite, sides[j].distance);
    if (sides[i].distance + opposite > widest) continue;
    sides[i].distance = ask_member(sides[i].position, around).distance;
  }
}

double SizeLaw::size_in_gap(double size, const Sized::Nearest& a, const Sized::Nearest& b) const {
  return std::min(size,
                  gap_size(a.distance + b.distance, options_.gap_layers, std::min(a.size, b.size)));
}

double SizeLaw::size_in_gaps(double size, Around& around) const {
  const double layers = options_.gap_layers;
  const Sized::Nearest& outer = around.outer;
  if (around.enclosing < container_.size())
    size = std::min(size, gap_size(outer.inside, layers, outer.size));
  // By gap_size no wider gap asks for less than `size`, or for anything.
  ask_sides_of_gaps(
      kRoundOff * layers * std::min(kNarrow * around.inner->largest_size, size / kGapEdge), around);
  for (std::size_t i = 0; i < around.asked.size(); ++i) {
    const Sized::Nearest& inner = around.asked[i].nearest;
    size = std::min(size, gap_size(inner.outside, layers, inner.size));
    size = size_in_gap(size, inner, outer);
    for (std::size_t j = 0; j < i; ++j) size = size_in_gap(size, inner, around.asked[j].nearest);
  }
  return size;
}

double SizeLaw::distance_from_surfaces(Around& around) const {
  if (around.inner->members.empty()) return around.outer.distance;
  return std::min(around.outer.distance,
                  around.inner->boxes.least(
                      around.x, [](double distance) { return distance; },
                      [&](std::size_t position) { return ask_member(position, around).distance; }));
}

SizeLaw::Around SizeLaw::surroundings(const Vec3& x, std::size_t on) const {
  const std::size_t enclosing = enclosing_surface(x, on);
  return {x, enclosing, &inner_[enclosing], ask(enclosing, x), {}};
}

double SizeLaw::size(Around& around) const {
  const double size = least_law(around);
  return options_.gap_layers > 0.0 ? size_in_gaps(size, around) : size;
}

double SizeLaw::operator()(const Vec3& x) const {
  Around around = surroundings(x);
  return size(around);
}

std::vector<double> SizeLaw::at_surface_vertices() const {
  struct OnSurface {
    Vec3 x;
    std::size_t surface;
  };
  std::vector<OnSurface> all;
  for (std::size_t i = 0; i < surfaces_.size(); ++i)
    for (const Vec3& x : surfaces_[i].mesh->x) all.push_back({x, i});
  return linear::shared_numbers(communicator(), all.size(), 1,
                                [&](std::size_t first, std::size_t end) {
                                  std::vector<double> sizes;
                                  for (std::size_t k = first; k < end; ++k) {
                                    Around around = surroundings(all[k].x, all[k].surface);
                                    sizes.push_back(size(around));
                                  }
                                  return sizes;
                                });
}

SizeAt SizeLaw::at(const Vec3& x) const {
  Around around = surroundings(x);
  const double size_there = size(around);
  return {size_there, distance_from_surfaces(around)};
}

}  // namespace meniscus
