#include "meniscus/topology/necks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>

#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/topology/constants.hpp"
#include "meniscus/topology/cut_off.hpp"
#include "meniscus/topology/face_patch.hpp"
#include "meniscus/topology/thread.hpp"

namespace meniscus {
namespace {

/// Threads are followed to this multiple of the radius below which necks are cut: beyond
/// kProminence times it, so that a neck at the limit is still seen to be one.
constexpr double kWidest = 1.5;
/// Faces that a section must cross at least: five edges around and five up or down. With fewer its
/// perimeter is no measure of a thread, and what seems a neck may be the corner of an edge.
constexpr std::size_t kFewestFaces = 10;
constexpr double kApart = 4.0;  // radii between two cuts: what lies between is a drop, not a slice
/// Thicknesses around a place without a thread within which others are taken to have none: a
/// quarter of the radius, which is how far the sections of a thread are apart.
constexpr double kLikewise = 0.125;
/// Least thickness, in the widest radius followed, of a place that answers for others: where the
/// liquid is thinner, a guess of the axis may fail beside a thread.
constexpr double kThick = 1.0;

/// A place where the liquid is thin: half-way from a vertex to the surface opposite.
struct ThinPlace {
  double thickness;
  Vec3 middle;
};

bool comes_before(const Vec3& a, const Vec3& b) {
  return std::tie(a.x(), a.y(), a.z()) < std::tie(b.x(), b.y(), b.z());
}

/// In an order that does not depend on how vertices are numbered.
std::vector<ThinPlace> thin_places(const SurfaceMesh& mesh, const SurfaceTree& tree, Side side,
                                   double widest) {
  std::vector<ThinPlace> places;
  const VertexField<Vec3> area = vertex_area_vectors(mesh);
  const double skip = 1e-3 * widest;  // leaves the faces at the vertex behind
  // A section's mean radius may be less than half of what one vertex sees across it.
  const double farthest = 2.5 * widest;
  for (const VertexId v : mesh.x.ids()) {
    const Vec3 across = sign_of(side) * area[v].normalized();
    const auto hit = tree.first_hit(mesh.x[v] + skip * across, across, farthest);
    if (!hit) continue;
    places.push_back({hit->distance, 0.5 * (mesh.x[v] + hit->point)});
  }
  std::ranges::sort(places, [](const ThinPlace& a, const ThinPlace& b) {
    return a.thickness != b.thickness ? a.thickness < b.thickness
                                      : comes_before(a.middle, b.middle);
  });
  return places;
}

/// Whether all faces that a section crosses meet in one vertex: it is the end of a point.
bool is_around_vertex(const SurfaceMesh& mesh, const Section& section) {
  const FaceVertices& first = mesh.faces[section.faces.front()];
  return std::ranges::any_of(first, [&](VertexId v) {
    return std::ranges::all_of(section.faces, [&](FaceId f) {
      return std::ranges::find(mesh.faces[f], v) != mesh.faces[f].end();
    });
  });
}

/// Whether a section cuts no more off than the end of a point or the rim of a lens, or, of the
/// outer liquid, the bottom of a dent: what is left when half of the liquid around the cut has gone
/// is less than a ball as wide as the neck, or does not go on as far.
bool is_near_end(const SurfaceMesh& mesh, const FaceNeighbours& neighbours,
                 const Section& section) {
  constexpr double kBeyond = 1.5;  // radii; a ball as wide as the thread reaches 1.9
  const double least = kLeastEnd * std::pow(section.radius, 3);
  return std::ranges::any_of(std::array{1.0, -1.0}, [&](double side) {
    const CutOff part = cut_off(mesh, neighbours, section, side);
    return part.reach < kBeyond * section.radius || part.volume < least;
  });
}

/// Whether a thread widens enough, beyond index k in the direction `step`, before it thins.
bool widens(const Thread& thread, int k, int step) {
  const auto size = static_cast<int>(thread.sections.size());
  const ThreadEnd end = step > 0 ? thread.back : thread.front;
  const double radius = thread.sections[static_cast<std::size_t>(k)].radius;
  for (int n = 1, i = k + step; n < size; ++n, i += step) {
    if (i < 0 || i >= size) {
      if (end != ThreadEnd::ring) break;
      i = (i + size) % size;
    }
    const double there = thread.sections[static_cast<std::size_t>(i)].radius;
    if (there < radius) return false;
    if (there > kProminence * radius) return true;
  }
  return end == ThreadEnd::wide || end == ThreadEnd::ring;
}

/// The mean velocity away from the centre, over the section's length.
double widening_rate(const Section& section, const SurfaceMotion& motion) {
  double sum = 0.0, length = 0.0;
  for (std::size_t k = 0; k < section.points.size(); ++k) {
    const Vec3 &a = section.points[k], &b = section.points[(k + 1) % section.points.size()];
    const double part = (b - a).norm();
    const Vec3 middle = 0.5 * (a + b), out = (middle - section.center).normalized();
    sum += part * out.dot(motion.at(middle));
    length += part;
  }
  return length > 0.0 ? sum / length : 0.0;
}

/// The thinnest section between the neighbours of section k: golden-section search along the line
/// of their centroids.
Section refined(const SurfaceMesh& mesh, const SurfaceTree& tree, const Section& rough) {
  constexpr double kGolden = 0.6180339887498949;
  constexpr int kSteps = 12;  // the bracket of half a radius shrinks by 300
  Section best = rough;
  const auto radius_at = [&](double s) {
    const SectionResult result =
        section_around(mesh, tree, rough.center + s * rough.axis, rough.axis, 4.0 * rough.radius);
    if (result.kind != SectionKind::closed) return std::numeric_limits<double>::infinity();
    if (result.section.radius < best.radius) best = result.section;
    return result.section.radius;
  };
  double low = -0.25 * rough.radius, high = -low;
  double s = high - kGolden * (high - low), t = low + kGolden * (high - low);
  double at_s = radius_at(s), at_t = radius_at(t);
  for (int i = 0; i < kSteps; ++i) {
    if (at_s < at_t) {
      high = std::exchange(t, s);
      at_t = at_s;
      at_s = radius_at(s = high - kGolden * (high - low));
    } else {
      low = std::exchange(s, t);
      at_s = at_t;
      at_t = radius_at(t = low + kGolden * (high - low));
    }
  }
  return best;
}

bool is_near(const Thread& thread, const Vec3& x) {
  return std::ranges::any_of(thread.sections, [&](const Section& section) {
    return (x - section.center).norm() < 1.3 * section.radius;
  });
}

bool is_near(const ThinPlace& threadless, const Vec3& x) {
  return (x - threadless.middle).norm() < kLikewise * threadless.thickness;
}

/// Of necks in rising order of radius, those that no thinner one lies close to.
std::vector<Neck> well_apart(std::vector<Neck> necks) {
  std::ranges::sort(necks, [](const Neck& a, const Neck& b) {
    return a.radius != b.radius ? a.radius < b.radius : comes_before(a.center, b.center);
  });
  std::vector<Neck> kept;
  for (Neck& neck : necks) {
    const bool is_close = std::ranges::any_of(kept, [&](const Neck& other) {
      return (other.center - neck.center).norm() < kApart * neck.radius;
    });
    if (!is_close) kept.push_back(std::move(neck));
  }
  return kept;
}

/// Looks for the threads of a surface, from the thinnest place up.
class ThreadSearch {
 public:
  ThreadSearch(const SurfaceMesh& mesh, const SurfaceTree& tree, Side side, double widest)
      : mesh_(mesh), tree_(tree), side_(side), widest_(widest) {}

  void visit(const ThinPlace& place) {
    const auto is_known = [&](const auto& other) { return is_near(other, place.middle); };
    if (std::ranges::any_of(threads_, is_known)) return;
    if (std::ranges::any_of(threadless_, is_known)) {
      skipped_.push_back(place);
      return;
    }
    Thread thread = traced(place);
    if (thread.sections.empty()) {
      if (side_ == Side::inside && place.thickness >= kThick * widest_)
        threadless_.push_back(place);
      return;
    }
    add_from_skipped(thread);
    if (std::ranges::none_of(threads_, is_known)) threads_.push_back(std::move(thread));
  }
  [[nodiscard]] const std::vector<Thread>& threads() const { return threads_; }

 private:
  [[nodiscard]] Thread traced(const ThinPlace& place) const {
    return traced_thread(mesh_, tree_, place.middle, side_, widest_);
  }
  /// A thread that a place found was in reach of a thinner place, if one that was skipped finds it:
  /// that one's sections count, as if none had been skipped.
  void add_from_skipped(const Thread& thread) {
    std::vector<ThinPlace> others;
    for (const ThinPlace& place : std::exchange(skipped_, {})) {
      const auto is_known = [&](const Thread& other) { return is_near(other, place.middle); };
      if (std::ranges::any_of(threads_, is_known)) continue;
      if (!is_near(thread, place.middle)) {
        others.push_back(place);
        continue;
      }
      if (Thread found = traced(place); !found.sections.empty())
        threads_.push_back(std::move(found));
    }
    skipped_ = std::move(others);
  }

  const SurfaceMesh& mesh_;
  const SurfaceTree& tree_;
  Side side_;
  double widest_;
  std::vector<Thread> threads_;
  std::vector<ThinPlace> threadless_, skipped_;
};

}  // namespace

std::vector<Neck> find_necks(const SurfaceMesh& mesh, const SurfaceTree& tree, Side side,
                             double radius, const SurfaceMotion& motion) {
  const double widest = kWidest * radius;
  const FaceNeighbours neighbours = face_neighbours(mesh, SurfaceTopology(mesh));
  ThreadSearch search(mesh, tree, side, widest);
  for (const ThinPlace& place : thin_places(mesh, tree, side, widest)) search.visit(place);
  std::vector<Neck> necks;
  for (const Thread& thread : search.threads())
    for (int k = 0; k < static_cast<int>(thread.sections.size()); ++k) {
      const Section& section = thread.sections[static_cast<std::size_t>(k)];
      if (section.radius >= radius || !widens(thread, k, 1) || !widens(thread, k, -1)) continue;
      const Section thinnest = refined(mesh, tree, section);
      if (thinnest.faces.size() < kFewestFaces || is_around_vertex(mesh, thinnest) ||
          is_near_end(mesh, neighbours, thinnest))
        continue;
      const double rate = widening_rate(thinnest, motion);
      if (rate < 0.0 || motion.is_unknown())
        necks.push_back(
            {thinnest.center, thinnest.axis, thinnest.radius, thinnest.area, rate, thinnest.faces});
    }
  return well_apart(std::move(necks));
}

}  // namespace meniscus
