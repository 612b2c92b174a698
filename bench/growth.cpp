// How costs grow: the size law, the smallest gap and the search for films with the number of drops
// at one volume fraction; the search for necks with the vertices of a flat drop; harmonic motion
// with the vertices of a volume mesh. Processor seconds, the least of several.
// Arguments: tables to print [law gaps necks harmonic]; --large adds a volume mesh of some 320
// thousand vertices to the last.

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/shapes.hpp"
#include "meniscus/scene/scene_gap.hpp"
#include "meniscus/topology/gaps.hpp"
#include "meniscus/topology/necks.hpp"
#include "meniscus/volume/harmonic_extension.hpp"
#include "meniscus/volume/size_law.hpp"
#include "tests/volume/suspension.hpp"

namespace {

using namespace meniscus;

template <class Function>
double seconds(int repeats, const Function& function) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < repeats; ++i) {
    const std::clock_t start = std::clock();
    function();
    least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return least;
}

TetMesh mesh_of(const Scene& scene) {
  TetMesh mesh;
  if (const VolumeMeshReport made = tetrahedralize(scene, {}, mesh); !made.ok())
    throw RunFailure(made.text());
  return mesh;
}

/// Microseconds, and searches for a nearest point, of the size law at a vertex of a mesh.
struct LawCost {
  double microseconds, searches;
};
LawCost cost_of_law(const Scene& scene, const TetMesh& mesh, double gap_layers) {
  VolumeMeshOptions options;
  options.gap_layers = gap_layers;
  const SizeLaw law(scene, options);
  const auto count = static_cast<double>(mesh.num_vertices());
  double sum = 0.0;
  const auto all = [&] {
    for (const Vec3& x : mesh.x) sum += law(x);
  };
  const std::int64_t before = law.num_searches();
  all();
  const auto searches = static_cast<double>(law.num_searches() - before);
  return {1e6 * seconds(3, all) / count, searches / count};
}

void print_laws() {
  fmt::print(
      "Size law: us a vertex, searches a vertex\n drops vertices    no gap layers        3 "
      "layers\n");
  for (const int drops : {25, 100, 400}) {
    const Scene scene = test::suspension(drops, 100, 0.1);
    const TetMesh mesh = mesh_of(scene);
    const LawCost plain = cost_of_law(scene, mesh, 0.0), layered = cost_of_law(scene, mesh, 3.0);
    fmt::print("{:6} {:8} {:8.2f} {:7.2f} {:8.2f} {:7.2f}\n", drops, mesh.num_vertices(),
               plain.microseconds, plain.searches, layered.microseconds, layered.searches);
  }
}

void print_gaps() {
  fmt::print(
      "A row's search for gaps: ms, ms over n log n\n drops    smallest gap           films\n");
  for (const int drops : {25, 100, 400, 1600}) {
    const Scene scene = test::suspension(drops, 100, 0.1);
    const double smallest =
                     1e3 * seconds(3, [&] { static_cast<void>(smallest_gap(scene).value()); }),
                 films = 1e3 * seconds(3, [&] { static_cast<void>(find_gaps(scene, 0.1, {})); }),
                 growth = drops * std::log(drops);
    fmt::print("{:6} {:8.2f} {:8.5f} {:8.2f} {:8.5f}\n", drops, smallest, smallest / growth, films,
               films / growth);
  }
}

/// Prints the cost of a row's search for necks, thinner than half of the sphere of equal volume.
void print_necks() {
  fmt::print(
      "Necks of flat drops: s a row, us a vertex\n vertices  1.3:1.3:0.59          2:2:0.25\n");
  for (const int vertices : {1900, 3900, 7800, 15500}) {
    fmt::print("{:9}", vertices);
    for (const Vec3& axes : {Vec3(1.3, 1.3, 0.59), Vec3(2.0, 2.0, 0.25)}) {
      const SurfaceMesh mesh = stretched_sphere(vertices, axes);
      const SurfaceTree tree(mesh);
      const double time =
          seconds(1, [&] { static_cast<void>(find_necks(mesh, tree, Side::inside, 0.5, {})); });
      fmt::print(" {:8.3f} {:8.2f}", time, 1e6 * time / vertices);
    }
    fmt::print("\n");
  }
}

void print_harmonic(bool is_large) {
  fmt::print(
      "Harmonic motion: s\n vertices  entries  matrix and multigrid  a velocity  iterations\n");
  for (const int drop_vertices : {350, 1440, 6000}) {
    if (drop_vertices > 5000 && !is_large) continue;
    Scene scene = test::scene_within(sphere(drop_vertices, 6.0));
    test::add_drop(scene, sphere(drop_vertices, 1.0, Vec3(1.3, 0, 0)));
    test::add_drop(scene, sphere(drop_vertices, 1.0, Vec3(-1.3, 0, 0)));
    const TetMesh mesh = mesh_of(scene);
    const TetVertexId first{mesh.boundary.first_vertex.value + mesh.boundary.num_vertices};
    Field<TetVertexId, Vec3> w(mesh.num_vertices(), Vec3::Zero());
    for (TetVertexId v{0}; v < mesh.boundary.first_vertex; ++v.value)
      w[v] = Vec3(mesh.x[v].y(), std::sin(3.0 * mesh.x[v].x()), 0.3);
    const double entries = seconds(1, [&] { static_cast<void>(HarmonicPattern(mesh, first)); });
    const HarmonicPattern pattern(mesh, first);
    const double matrix = seconds(1, [&] { static_cast<void>(HarmonicExtension(pattern, mesh)); });
    const HarmonicExtension extension(pattern, mesh);
    int iterations = 0;
    const double velocity = seconds(1, [&] { iterations = extension.extend(w); });
    fmt::print("{:9} {:8.3f} {:21.3f} {:11.3f} {:11}\n", mesh.num_vertices(), entries, matrix,
               velocity, iterations);
  }
}

}  // namespace

int main(int count, char** given) {
  std::vector<std::string> tables(given + 1, given + count);
  const bool is_large = std::erase(tables, "--large") > 0;
  if (tables.empty()) tables = {"law", "gaps", "necks", "harmonic"};
  for (const std::string& table : tables) {
    if (table == "law") print_laws();
    if (table == "gaps") print_gaps();
    if (table == "necks") print_necks();
    if (table == "harmonic") print_harmonic(is_large);
  }
  return 0;
}
