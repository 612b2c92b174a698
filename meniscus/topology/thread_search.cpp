#include "meniscus/topology/thread_search.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {
namespace {

/// Thicknesses around a place without a thread within which others are taken to have none. It is a
/// quarter of the radius, which is how far the sections of a thread are apart.
constexpr double kLikewise = 0.125;
/// Least thickness, in the widest radius followed, of a place that answers for all others there.
/// Where the liquid is thinner, a guess of the axis may fail beside a thread.
constexpr double kThick = 1.0;
/// How near, in that radius, a place in a thinner sheet of the drop answers for one that is no more
/// than so much thicker. Sheets of any number of vertices thus have a bounded number of places.
constexpr double kBeside = 0.1, kAlike = 1.25;

/// A place where the liquid is thin: half-way from a vertex to the surface opposite.
struct ThinPlace {
  double thickness;
  Vec3 middle;
};

/// The thin places of a surface, in an order that does not depend on how vertices are numbered.
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
                                      : std::tie(a.middle.x(), a.middle.y(), a.middle.z()) <
                                            std::tie(b.middle.x(), b.middle.y(), b.middle.z());
  });
  return places;
}

bool is_near(const Thread& thread, const Vec3& x) {
  return std::ranges::any_of(thread.sections, [&](const Section& section) {
    return (x - section.center).norm() < 1.3 * section.radius;
  });
}

/// Looks for the threads of a surface, from the thinnest place up.
class ThreadSearch {
 public:
  ThreadSearch(const SurfaceMesh& mesh, const SurfaceTree& tree, Side side, double widest)
      : mesh_(mesh), tree_(tree), side_(side), widest_(widest) {}

  void visit(const ThinPlace& place) {
    const auto is_known = [&](const Thread& other) { return is_near(other, place.middle); };
    if (std::ranges::any_of(threads_, is_known)) return;
    if (side_ == Side::inside && std::ranges::any_of(threadless_, [&](const ThinPlace& other) {
          return answers_for(other, place);
        })) {
      skipped_.push_back(place);
      return;
    }
    ++num_tried_;
    Thread thread = thread_at(place);
    if (!is_near(thread, place.middle)) threadless_.push_back(place);
    if (thread.sections.empty()) return;
    add_from_skipped(thread);
    if (std::ranges::none_of(threads_, is_known)) threads_.push_back(std::move(thread));
  }
  [[nodiscard]] FoundThreads take() { return {std::move(threads_), num_tried_}; }

 private:
  /// Whether a place without a thread shows that another, no thinner one is without as well.
  [[nodiscard]] bool answers_for(const ThinPlace& threadless, const ThinPlace& other) const {
    const double distance = (other.middle - threadless.middle).norm();
    if (threadless.thickness >= kThick * widest_)
      return distance < kLikewise * threadless.thickness;
    return distance < kBeside * widest_ && other.thickness < kAlike * threadless.thickness;
  }
  [[nodiscard]] Thread thread_at(const ThinPlace& place) const {
    return thread_through(mesh_, tree_, place.middle, side_, widest_);
  }
  /// A thread that a place found was in reach of a thinner place, if one that was skipped finds it.
  /// That one's sections count, as if none had been skipped.
  void add_from_skipped(const Thread& thread) {
    std::vector<ThinPlace> others;
    for (const ThinPlace& place : std::exchange(skipped_, {})) {
      const auto is_known = [&](const Thread& other) { return is_near(other, place.middle); };
      if (std::ranges::any_of(threads_, is_known)) continue;
      if (!is_near(thread, place.middle)) {
        others.push_back(place);
        continue;
      }
      if (Thread found = thread_at(place); !found.sections.empty())
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
  int num_tried_ = 0;
};

}  // namespace

FoundThreads find_threads(const SurfaceMesh& mesh, const SurfaceTree& tree, Side side,
                          double widest) {
  MENISCUS_ASSERT(widest > 0.0, "threads no wider than {}", widest);
  ThreadSearch search(mesh, tree, side, widest);
  for (const ThinPlace& place : thin_places(mesh, tree, side, widest)) search.visit(place);
  return search.take();
}

}  // namespace meniscus
