// Nearest points and rays: SurfaceTree against CGAL's AABB_tree over the same triangles, with the
// project's kernel and with plain doubles. Times by turns in one process, of its CPU.
//
//     surface_tree_against_cgal [ROUNDS]      turns of each measurement [5]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_tree.hpp"

namespace meniscus {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// CGAL's tree with the face of the surface that is asked for its distances.
template <class Kernel>
class CgalTree {
 public:
  explicit CgalTree(const SurfaceMesh& mesh) : triangles_(triangles_of(mesh)) {
    tree_.insert(triangles_.begin(), triangles_.end());
    tree_.build();
  }
  /// The points from which CGAL guesses where to begin; built before the first nearest point.
  void accelerate() { tree_.accelerate_distance_queries(); }

  [[nodiscard]] double closest(const Vec3& p) const {
    const Point x = point(p);
    return std::sqrt(CGAL::squared_distance(tree_.closest_point(x), x));
  }
  /// Infinity unless nearer than `within`: CGAL narrows the search from a hint at that distance.
  [[nodiscard]] double closest(const Vec3& p, double within) const {
    const Point x = point(p);
    const auto best = tree_.closest_point_and_primitive(
        x, {Point(p.x() + within, p.y(), p.z()), triangles_.end()});
    if (best.second == triangles_.end()) return kInfinity;
    return std::sqrt(CGAL::squared_distance(best.first, x));
  }
  [[nodiscard]] double first_hit(const Vec3& p, const Vec3& direction) const {
    const typename Kernel::Ray_3 ray(
        point(p), typename Kernel::Vector_3(direction.x(), direction.y(), direction.z()));
    const auto hit = tree_.first_intersection(ray);
    if (!hit) return kInfinity;
    const Point* x = boost::get<Point>(&hit->first);
    return x != nullptr ? std::sqrt(CGAL::squared_distance(*x, ray.source())) : std::nan("");
  }

 private:
  using Point = typename Kernel::Point_3;
  using Triangles = std::vector<typename Kernel::Triangle_3>;
  using Primitive =
      CGAL::AABB_triangle_primitive<Kernel, typename Triangles::const_iterator, CGAL::Tag_true>;

  static Point point(const Vec3& x) { return {x.x(), x.y(), x.z()}; }
  static Triangles triangles_of(const SurfaceMesh& mesh) {
    Triangles triangles;
    triangles.reserve(static_cast<std::size_t>(mesh.num_faces()));
    for (const FaceVertices& v : mesh.faces)
      triangles.emplace_back(point(mesh.x[v[0]]), point(mesh.x[v[1]]), point(mesh.x[v[2]]));
    return triangles;
  }

  const Triangles triangles_;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree_;
};

using Exact = CgalTree<CGAL::Exact_predicates_inexact_constructions_kernel>;
using Plain = CgalTree<CGAL::Simple_cartesian<double>>;

/// A unit sphere, or one with a skin of bumps and folds, vertices moved at random.
SurfaceMesh shape(bool is_crumpled, int num_faces) {
  SurfaceMesh mesh = sphere(num_faces / 2 + 2);
  if (!is_crumpled) return mesh;
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0.0, 0.1 * mean_edge(mesh));
  for (Vec3& x : mesh.x) {
    const Vec3 n = x;
    x *= 1.0 + 0.3 * std::sin(9.0 * n.x()) * std::sin(8.0 * n.y()) * std::sin(7.0 * n.z());
    x += 0.15 * Vec3(std::sin(12.0 * n.y()), std::sin(11.0 * n.z()), std::sin(13.0 * n.x()));
    x += Vec3(normal(random), normal(random), normal(random));
  }
  return mesh;
}

struct Query {
  Vec3 point, direction;
};

Vec3 in_cube(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  return {uniform(random), uniform(random), uniform(random)};
}

/// Points within `reach` of vertices in each coordinate, or anywhere within a cube of half-width 2.
std::vector<Query> queries(const SurfaceMesh& mesh, double reach) {
  std::mt19937 random(2);
  std::uniform_int_distribution<std::int32_t> any(0, mesh.num_vertices() - 1);
  std::vector<Query> result(20000);
  for (Query& query : result) {
    query.point = reach > 0.0 ? Vec3(mesh.x[VertexId{any(random)}] + reach * in_cube(random))
                              : Vec3(2.0 * in_cube(random));
    query.direction = in_cube(random).normalized();
  }
  return result;
}

/// The seconds of each contestant, ours first, by turns.
using Contestant = std::function<void()>;
std::vector<std::vector<double>> timed(const std::vector<Contestant>& contestants, int rounds) {
  std::vector<std::vector<double>> seconds(contestants.size());
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 0; i < contestants.size(); ++i) {
      const double start = cpu_seconds();
      contestants[i]();
      seconds[i].push_back(cpu_seconds() - start);
    }
  return seconds;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// Ends a row: ours in µs for each of `count`, then the median ratio of CGAL's time to ours.
void print_times(const std::vector<std::vector<double>>& seconds, double count) {
  std::printf(" %.3f |", 1e6 * median(seconds[0]) / count);
  for (std::size_t i = 1; i < seconds.size(); ++i) {
    std::vector<double> ratios;
    for (std::size_t k = 0; k < seconds[i].size(); ++k)
      ratios.push_back(seconds[i][k] / seconds[0][k]);
    std::printf(" %.2f |", median(ratios));
  }
}

/// Answers that differ in whether there is one, and the largest difference of those that both have.
void print_agreement(const std::vector<double>& ours, const std::vector<double>& theirs) {
  int num_found = 0, num_apart = 0;
  double largest = 0.0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    num_found += std::isfinite(ours[i]);
    if (std::isfinite(ours[i]) != std::isfinite(theirs[i]))
      ++num_apart;
    else if (std::isfinite(ours[i]))
      largest = std::max(largest, std::abs(ours[i] - theirs[i]));
  }
  std::printf(" %d | %d | %.1e |\n", num_found, num_apart, largest);
  std::fflush(stdout);
}

/// Asks every tree every query.
struct Comparison {
  const Exact& exact;
  const Plain& plain;
  int rounds;

  template <class Ours, class Theirs>
  void print_row(const char* what, const std::vector<Query>& asked, const Ours& ours,
                 const Theirs& theirs) const {
    std::vector<double> a(asked.size()), b(asked.size()), c(asked.size());
    const auto over = [&asked](std::vector<double>& answers, const auto& ask) {
      return [&answers, &asked, ask] {
        for (std::size_t i = 0; i < asked.size(); ++i) answers[i] = ask(asked[i]);
      };
    };
    const auto seconds =
        timed({over(a, ours), over(b, [&](const Query& q) { return theirs(exact, q); }),
               over(c, [&](const Query& q) { return theirs(plain, q); })},
              rounds);
    std::printf("| | %s |", what);
    print_times(seconds, static_cast<double>(asked.size()));
    print_agreement(a, b);
  }
};

void compare_on(bool is_crumpled, int num_faces, int rounds) {
  const SurfaceMesh mesh = shape(is_crumpled, num_faces);
  const auto built = timed({[&] { const SurfaceTree tree(mesh); }, [&] { const Exact tree(mesh); },
                            [&] { const Plain tree(mesh); }},
                           rounds);
  std::printf("| %s, %d faces | build |", is_crumpled ? "crumpled" : "sphere", mesh.num_faces());
  print_times(built, mesh.num_faces());
  std::printf(" | | |\n");
  const SurfaceTree tree(mesh);
  Exact exact(mesh);
  Plain plain(mesh);
  exact.accelerate(), plain.accelerate();
  const Comparison comparison{exact, plain, rounds};
  const double edge = mean_edge(mesh);
  const auto near = queries(mesh, 4.0 * edge), anywhere = queries(mesh, 0.0);
  const auto closest = [&](const Query& q) { return tree.closest(q.point).distance; };
  const auto their_closest = [](const auto& t, const Query& q) { return t.closest(q.point); };
  comparison.print_row("nearest, near", near, closest, their_closest);
  comparison.print_row("nearest, anywhere", anywhere, closest, their_closest);
  const auto bounded = [&](const Query& q) { return tree.closest(q.point, 2.0 * edge).distance; };
  const auto their_bounded = [edge](const auto& t, const Query& q) {
    return t.closest(q.point, 2.0 * edge);
  };
  comparison.print_row("within 2 edges, near", near, bounded, their_bounded);
  comparison.print_row("within 2 edges, anywhere", anywhere, bounded, their_bounded);
  const auto ray = [&](const Query& q) {
    const auto hit = tree.first_hit(q.point, q.direction);
    return hit ? hit->distance : kInfinity;
  };
  const auto their_ray = [](const auto& t, const Query& q) {
    return t.first_hit(q.point, q.direction);
  };
  comparison.print_row("ray, near", near, ray, their_ray);
  comparison.print_row("ray, anywhere", anywhere, ray, their_ray);
}

}  // namespace
}  // namespace meniscus

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
  std::printf(
      "| shape | what | ours, us | CGAL/ours | plain CGAL/ours | found | apart | largest "
      "difference |\n|---|---|---|---|---|---|---|---|\n");
  for (const int num_faces : {10000, 100000})
    for (const bool is_crumpled : {false, true})
      meniscus::compare_on(is_crumpled, num_faces, rounds);
}
