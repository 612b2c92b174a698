#include "meniscus/topology/necks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/repair/face_patch.hpp"
#include "meniscus/topology/constants.hpp"
#include "meniscus/topology/cut_off.hpp"
#include "meniscus/topology/thread_search.hpp"

namespace meniscus {
namespace {

/// Threads are followed to this multiple of the radius below which necks are cut. It is beyond
/// kProminence times it, so that a neck at the limit is still seen to be one.
constexpr double kWidest = 1.5;
/// Faces that a section must cross at least: five edges around and five up or down. With fewer its
/// perimeter is no measure of a thread, and what seems a neck may be the corner of an edge.
constexpr std::size_t kFewestFaces = 10;
constexpr double kApart = 4.0;  // radii between two cuts: what lies between is a drop, not a slice
bool comes_before(const Vec3& a, const Vec3& b) {
  return std::tie(a.x(), a.y(), a.z()) < std::tie(b.x(), b.y(), b.z());
}

/// Whether all faces that a section crosses meet in one vertex: it is the end of a point.
bool is_around_vertex(const SurfaceMesh& mesh, const Section& section) {
  MENISCUS_ASSERT(!section.faces.empty());
  const FaceVertices& first = mesh.faces[section.faces.front()];
  return std::ranges::any_of(first, [&](VertexId v) {
    return std::ranges::all_of(section.faces, [&](FaceId f) {
      return std::ranges::find(mesh.faces[f], v) != mesh.faces[f].end();
    });
  });
}

/// Whether a section cuts no more off than the end of a point or the rim of a lens. Of the outer
/// liquid that is the bottom of a dent. When half of the liquid around the cut has gone, then less
/// than a ball as wide as the neck is left. Or what is left does not go on as far.
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
  MENISCUS_ASSERT(k >= 0 && k < size && std::abs(step) == 1, "{} of {}, {}", k, size, step);
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
Section thinnest_section(const SurfaceMesh& mesh, const SurfaceTree& tree, const Section& rough) {
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

/// The necks, in rising order of radius, without those that lie close to a thinner one.
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

}  // namespace

std::vector<Neck> find_necks(const SurfaceMesh& mesh, const SurfaceTree& tree, Side side,
                             double radius, const SurfaceMotion& motion) {
  MENISCUS_ASSERT(radius > 0.0, "radius = {}", radius);
  const FaceNeighbours neighbours = face_neighbours(mesh, SurfaceTopology(mesh));
  const FoundThreads found = find_threads(mesh, tree, side, kWidest * radius);
  std::vector<Neck> necks;
  for (const Thread& thread : found.threads)
    for (int k = 0; k < static_cast<int>(thread.sections.size()); ++k) {
      const Section& section = thread.sections[static_cast<std::size_t>(k)];
      if (section.radius >= radius || !widens(thread, k, 1) || !widens(thread, k, -1)) continue;
      const Section thinnest = thinnest_section(mesh, tree, section);
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
