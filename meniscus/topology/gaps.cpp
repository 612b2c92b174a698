#include "meniscus/topology/gaps.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/box_tree.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_tree.hpp"
#include "meniscus/surface/repair/face_patch.hpp"

namespace meniscus {
namespace {

constexpr double kFacing = 0.5;    // cosine of 60°
constexpr double kSameFilm = 6.0;  // limits: closer places of one film are one
constexpr double kNearby = 3.0;    // limits: radius of the ball that must not join two parts
constexpr double kLink = 3.0;      // mean edges: vertices this close look across one film

/// One interface while gaps are looked for.
struct Sheet {
  const SurfaceMesh& mesh;
  const SurfaceTree& tree;
  const VertexField<Vec3>& area;

  [[nodiscard]] Vec3 normal(VertexId v) const { return area[v].normalized(); }
  [[nodiscard]] Vec3 normal(FaceId f) const { return face_area_vector(mesh, f).normalized(); }
};

/// A vertex of a with the nearest point across the film.
struct Contact {
  double width;
  Vec3 from, to;
  Vec3 into_from, into_to;  // normals into the film
};

/// The side of each of two interfaces on which they bound the same liquid.
std::optional<std::array<Side, 2>> common_film(const Interface& a, const Interface& b) {
  for (const Side s : {Side::outside, Side::inside})
    for (const Side t : {Side::outside, Side::inside})
      if ((s == Side::outside ? a.outside : a.inside) ==
          (t == Side::outside ? b.outside : b.inside))
        return std::array<Side, 2>{s, t};
  return std::nullopt;
}

bool is_facing(const Contact& c) {
  const Vec3 across = c.to - c.from;
  return c.into_from.dot(c.into_to) < -kFacing && across.dot(c.into_from) > kFacing * c.width &&
         across.dot(c.into_to) < -kFacing * c.width;
}

void add_contacts(const Sheet& a, Side side_a, const Sheet& b, Side side_b, double limit,
                  bool is_swapped, std::vector<Contact>& contacts) {
  const Vec3 low = b.tree.low().array() - limit, high = b.tree.high().array() + limit;
  for (const VertexId v : a.mesh.x.ids()) {
    const Vec3& x = a.mesh.x[v];
    if ((x.array() < low.array()).any() || (x.array() > high.array()).any()) continue;
    const SurfaceTree::Hit hit = b.tree.closest(x, limit);
    if (!hit.face.is_valid()) continue;
    Contact c{hit.distance, x, hit.point, sign_of(side_a) * a.normal(v),
              sign_of(side_b) * b.normal(hit.face)};
    if (!is_facing(c)) continue;
    if (is_swapped) {
      std::swap(c.from, c.to);
      std::swap(c.into_from, c.into_to);
    }
    contacts.push_back(c);
  }
}

/// The face a ray meets across a film, and how far away.
std::optional<SurfaceTree::Hit> across_film(const SurfaceMesh& mesh, const SurfaceTree& tree,
                                            const Vec3& x, const Vec3& into, double limit) {
  const double skip = 1e-3 * limit;  // leaves the faces at the vertex behind
  auto hit = tree.first_hit(x + skip * into, into, limit);
  if (!hit) return std::nullopt;
  hit->distance += skip;
  if (hit->distance >= limit) return std::nullopt;
  // A film's far side is met from within the film, so that its normal into it is opposed.
  const Vec3 n = face_area_vector(mesh, hit->face).normalized();
  if (std::abs(n.dot(into)) < kFacing) return std::nullopt;
  return hit;
}

std::vector<Contact> own_contacts(const Sheet& a, Side side, double limit) {
  std::vector<Contact> contacts;
  for (const VertexId v : a.mesh.x.ids()) {
    const Vec3 into = sign_of(side) * a.normal(v);
    const auto hit = across_film(a.mesh, a.tree, a.mesh.x[v], into, limit);
    if (!hit) continue;
    const Contact c{hit->distance, a.mesh.x[v], hit->point, into,
                    sign_of(side) * a.normal(hit->face)};
    if (is_facing(c)) contacts.push_back(c);
  }
  return contacts;
}

/// Looks for faces that join the two sides of a film around its middle.
class JoinSearch {
 public:
  explicit JoinSearch(const Sheet& sheet)
      : sheet_(sheet),
        neighbours_(face_neighbours(sheet.mesh, SurfaceTopology(sheet.mesh))),
        seen_in_(sheet.mesh.num_faces(), 0) {}

  /// Whether faces within `radius` of the middle join the two sides.
  [[nodiscard]] bool are_joined(const Contact& c, double radius) {
    const Vec3 middle = 0.5 * (c.from + c.to);
    const FaceId start = sheet_.tree.closest(c.from).face, goal = sheet_.tree.closest(c.to).face;
    ++search_;
    front_.assign(1, start);
    seen_in_[start] = search_;
    for (std::size_t k = 0; k < front_.size(); ++k) {
      if (front_[k] == goal) return true;
      for (const FaceId f : neighbours_[front_[k]])
        if (std::exchange(seen_in_[f], search_) != search_ && distance(f, middle) < radius)
          front_.push_back(f);
    }
    return false;
  }

 private:
  [[nodiscard]] double distance(FaceId f, const Vec3& x) const {
    const FaceVertices& v = sheet_.mesh.faces[f];
    const Triangle corners{sheet_.mesh.x[v[0]], sheet_.mesh.x[v[1]], sheet_.mesh.x[v[2]]};
    return (closest_point(corners, x).point - x).norm();
  }

  const Sheet& sheet_;
  FaceNeighbours neighbours_;
  FaceField<int> seen_in_;  // the last search that came to the face
  int search_ = 0;
  std::vector<FaceId> front_;
};

bool comes_before(const Contact& c, const Contact& d) {
  const Vec3 m = c.from + c.to, n = d.from + d.to;
  return std::make_tuple(c.width, m.x(), m.y(), m.z()) <
         std::make_tuple(d.width, n.x(), n.y(), n.z());
}

bool approaches(const Contact& c, const SurfaceMotion& motion) {
  return motion.is_unknown() ||
         motion.at(c.from).dot(c.into_from) + motion.at(c.to).dot(c.into_to) > 0.0;
}

/// Numbers the films that contacts are in. Those of one film lead to each other by steps no longer
/// than `link`.
std::vector<int> film_numbers(const std::vector<Contact>& contacts, double link) {
  std::vector<Box> places;
  places.reserve(contacts.size());
  for (const Contact& c : contacts) places.emplace_back(Vec3(0.5 * (c.from + c.to)));
  const BoxTree tree(places);
  std::vector<int> number(contacts.size(), -1);
  int films = 0;
  for (std::size_t first = 0; first < number.size(); ++first) {
    if (number[first] >= 0) continue;
    std::vector<std::size_t> front{first};
    number[first] = films;
    while (!front.empty()) {
      const Box here = places[front.back()];
      front.pop_back();
      tree.visit_within(here, link, [&](std::size_t next) {
        if (number[next] >= 0) return;
        number[next] = films;
        front.push_back(next);
      });
    }
    ++films;
  }
  return number;
}

/// The gaps of films: the closest places that the surfaces approach at. `is_film` has the last word
/// on a place.
template <class IsFilm>
void collect(std::vector<Contact> contacts, Gap gap, double limit, double mean_edge,
             const SurfaceMotion& motion, const IsFilm& is_film, std::vector<Gap>& gaps) {
  std::ranges::sort(contacts, comes_before);
  const std::vector<int> film =
      film_numbers(contacts, std::max(kSameFilm * limit, kLink * mean_edge));
  std::vector<Gap> found;
  std::vector<int> film_of_found;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact& c = contacts[i];
    gap.width = c.width;
    gap.from = c.from;
    gap.to = c.to;
    const bool is_known = std::ranges::any_of(found, [&](const Gap& other) {
      return (other.middle() - gap.middle()).norm() < kSameFilm * limit;
    });
    if (is_known || !approaches(c, motion) || !is_film(c)) continue;
    found.push_back(gap);
    film_of_found.push_back(film[i]);
  }
  for (std::size_t k = 0; k < found.size(); ++k) {
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      if (film[i] != film_of_found[k]) continue;
      found[k].patch.push_back(contacts[i].from);
      found[k].patch.push_back(contacts[i].to);
    }
    gaps.push_back(std::move(found[k]));
  }
}

std::vector<Gap> gaps_between(const Sheet& a, const Sheet& b, const std::array<Side, 2>& film,
                              double limit, const SurfaceMotion& motion) {
  std::vector<Contact> contacts;
  add_contacts(a, film.front(), b, film.back(), limit, false, contacts);
  add_contacts(b, film.back(), a, film.front(), limit, true, contacts);
  std::vector<Gap> gaps;
  collect(
      std::move(contacts), {.side = film.front()}, limit,
      std::max(mean_edge(a.mesh), mean_edge(b.mesh)), motion, [](const Contact&) { return true; },
      gaps);
  return gaps;
}

std::vector<Gap> gaps_within(const Sheet& sheet, double limit, const SurfaceMotion& motion) {
  std::vector<Gap> gaps;
  std::optional<JoinSearch> joins;
  for (const Side side : {Side::outside, Side::inside}) {
    std::vector<Contact> contacts = own_contacts(sheet, side, limit);
    if (contacts.empty()) continue;
    if (!joins) joins.emplace(sheet);
    const auto is_film = [&](const Contact& c) { return !joins->are_joined(c, kNearby * limit); };
    collect(std::move(contacts), {.side = side}, limit, mean_edge(sheet.mesh), motion, is_film,
            gaps);
  }
  return gaps;
}

}  // namespace

double film_width(const SurfaceMesh& mesh, const SurfaceTree& tree, const Vec3& x,
                  const Vec3& into_film, double limit) {
  const auto hit = across_film(mesh, tree, x, into_film, limit);
  return hit ? hit->distance : std::numeric_limits<double>::infinity();
}

struct GapSearch::Surface {
  explicit Surface(const SurfaceMesh& mesh) : tree(mesh), area(vertex_area_vectors(mesh)) {}
  [[nodiscard]] Box box() const { return {tree.low(), tree.high()}; }
  SurfaceTree tree;
  VertexField<Vec3> area;
};

GapSearch::GapSearch(double limit, const SurfaceMotion& motion) : limit_(limit), motion_(motion) {}
GapSearch::~GapSearch() = default;

const GapSearch::Surface& GapSearch::surface_of(const Interface& interface) {
  std::unique_ptr<Surface>& known = surfaces_[interface.drop];
  if (!known) known = std::make_unique<Surface>(interface.mesh);
  const Surface& surface = *known;
  MENISCUS_ASSERT(surface.area.size() == interface.mesh.num_vertices(),
                  "drop {} has another mesh than before", interface.drop);
  return surface;
}

std::span<const Gap> GapSearch::gaps_of(const Interface& a, const Interface& b) {
  const bool is_one = a.drop == b.drop;
  const auto film = is_one ? std::array<Side, 2>{} : common_film(a, b);
  if (!film) return {};
  const auto [known, is_new] = known_.try_emplace({a.drop, b.drop, film->front(), film->back()});
  if (!is_new) return known->second;
  ++num_searches_;
  const Surface &first = surface_of(a), &second = surface_of(b);
  const Sheet sheet{a.mesh, first.tree, first.area};
  known->second =
      is_one ? gaps_within(sheet, limit_, motion_)
             : gaps_between(sheet, {b.mesh, second.tree, second.area}, *film, limit_, motion_);
  return known->second;
}

std::vector<Gap> GapSearch::gaps(const Scene& scene) {
  std::vector<Box> bounds;
  bounds.reserve(scene.interfaces.size());
  for (const Interface& interface : scene.interfaces) bounds.push_back(surface_of(interface).box());
  const BoxTree boxes(bounds);
  std::vector<Gap> gaps;
  const auto add = [&](std::size_t a, std::size_t b) {
    for (Gap gap : gaps_of(scene.interfaces[a], scene.interfaces[b])) {
      gap.a = a;
      gap.b = b;
      gaps.push_back(std::move(gap));
    }
  };
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
    for (const std::size_t j : boxes.earlier_within(i, limit_)) add(j, i);
    add(i, i);
  }
  std::ranges::sort(gaps, [](const Gap& a, const Gap& b) {
    const Vec3 m = a.middle(), n = b.middle();
    return std::make_tuple(a.width, m.x(), m.y(), m.z()) <
           std::make_tuple(b.width, n.x(), n.y(), n.z());
  });
  return gaps;
}

std::vector<Gap> find_gaps(const Scene& scene, double limit, const SurfaceMotion& motion) {
  return GapSearch(limit, motion).gaps(scene);
}

}  // namespace meniscus
