#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include "meniscus/scene/scene.hpp"
#include "meniscus/topology/surface_motion.hpp"
#include "meniscus/topology/thread.hpp"

namespace meniscus {

/// The closest place of a film: where two interfaces, or two parts of one, face each other.
struct Gap {
  std::size_t a = 0, b = 0;   ///< interfaces of the scene; equal for two parts of one
  Side side = Side::outside;  ///< on which side of a the film lies
  double width = 0.0;         ///< [R0]
  Vec3 from = Vec3::Zero();   ///< on a
  Vec3 to = Vec3::Zero();     ///< on b
  /// Points of either surface across from which this film is thinner than the limit.
  std::vector<Vec3> patch = {};

  [[nodiscard]] Vec3 middle() const { return 0.5 * (from + to); }
};

/// Distances of facing surfaces below `limit`, in rising order, whose surfaces approach each other:
///   v(from)·m(from) + v(to)·m(to) > 0,  m the normal into the film.
/// Facing: the normals into the film are opposed to within 60°, and the line between the points is
/// within 60° of both. Two parts of one surface count as facing only if no faces within 3 `limit`
/// of the middle join them. Neither the rim of a film nor a neck is a gap. Of places within 6
/// limits of each other only the closest is given. Places of one film are joined by steps of 6
/// limits or three mean edges. O(n log n) in the number of drops as long as few are near each one.
[[nodiscard]] std::vector<Gap> find_gaps(const Scene& scene, double limit,
                                         const SurfaceMotion& motion);

/// Finds the gaps of a scene while events change it: only what they changed is searched again.
/// While this lives the id of a drop stands for one mesh.
class GapSearch {
 public:
  GapSearch(double limit, const SurfaceMotion& motion);
  ~GapSearch();
  GapSearch(const GapSearch&) = delete;
  GapSearch& operator=(const GapSearch&) = delete;

  /// The gaps that `find_gaps` gives.
  [[nodiscard]] std::vector<Gap> gaps(const Scene& scene);
  /// How many drops and pairs of them have been searched: what it costs.
  [[nodiscard]] std::int64_t num_searches() const { return num_searches_; }

 private:
  struct Surface;
  [[nodiscard]] const Surface& surface_of(const Interface& interface);
  /// Between two interfaces or, given the same twice, two parts of it; a and b of each are unset.
  [[nodiscard]] std::span<const Gap> gaps_of(const Interface& a, const Interface& b);

  /// Two drops' ids, and on which sides of them the film lies: an event may change that too.
  using Key = std::tuple<int, int, Side, Side>;
  double limit_;
  const SurfaceMotion& motion_;
  std::map<int, std::unique_ptr<Surface>> surfaces_;
  std::map<Key, std::vector<Gap>> known_;
  std::int64_t num_searches_ = 0;
};

/// The width of the film beyond a vertex of a closed surface whose two sides face each other across
/// it. It is infinite where it is no film thinner than `limit`.
[[nodiscard]] double film_width(const SurfaceMesh& mesh, const SurfaceTree& tree, const Vec3& x,
                                const Vec3& into_film, double limit);

}  // namespace meniscus
