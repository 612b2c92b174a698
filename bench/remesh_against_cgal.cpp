// Remeshing to an even mesh: ours against CGAL's isotropic_remeshing, from the same input to the
// same mean edge. Prints the rows of docs/benchmark-remeshing.md. CPU time of the process.
//
//     remesh_against_cgal [LARGEST]      largest number of vertices [100000]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <Eigen/Geometry>

#include "meniscus/mesh/cgal_surface.hpp"
#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_quality.hpp"
#include "meniscus/surface/remesh.hpp"
#include "meniscus/surface/sizing.hpp"

namespace meniscus {
namespace {

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// The radius in a direction of Cassini's oval of revolution, (x² + ρ² + 1)² − 4x² = c⁴, of
/// half-length about 1.41 and neck radius (c² − 1)^½.
double dumbbell_radius(const Vec3& direction, double neck) {
  const double c2 = 1.0 + neck * neck, x = direction.x();
  const double cos_2 = 2.0 * x * x - 1.0, sin2_2 = 1.0 - cos_2 * cos_2;
  return std::sqrt(cos_2 + std::sqrt(c2 * c2 - sin2_2));
}

RemeshOptions even_mesh_options(double edge) {
  return {.C0 = 1.0,
          .edge_floor = edge,
          .edge_ceiling = edge * (1.0 + 1e-9),
          .min_vertices = 4,
          .spring_tolerance = 0.01};
}

/// An even mesh whose vertices were moved at random in their tangent planes by up to a fifth of an
/// edge, so that neither remesher starts from its own result.
SurfaceMesh noisy_mesh(SurfaceMesh mesh, int num_vertices) {
  const double edge = length_of_density(num_vertices / surface_area(mesh));
  for (int pass = 0; pass < 2; ++pass)
    if (const RemeshReport report = remesh(mesh, even_mesh_options(edge)); !report.ok())
      std::printf("input: %s\n", report.text().c_str());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const VertexField<Vec3> areas = vertex_area_vectors(mesh);
  for (const VertexId v : mesh.x.ids()) {
    const Vec3 n = areas[v].normalized();
    const Vec3 d(uniform(random), uniform(random), uniform(random));
    mesh.x[v] += 0.2 * edge * (d - d.dot(n) * n);
  }
  return mesh;
}

SurfaceMesh shape(const char* name, int num_vertices) {
  SurfaceMesh mesh = sphere(num_vertices);
  switch (name[0]) {
    case 'e':
      for (Vec3& x : mesh.x) x.x() *= 4.0;
      break;
    case 'd':
      for (Vec3& x : mesh.x) x = dumbbell_radius(x.normalized(), 0.05) * x.normalized();
      break;
    default:
      break;
  }
  return noisy_mesh(std::move(mesh), num_vertices);
}

struct Outcome {
  SurfaceMesh mesh;
  double seconds;
  double volume_change;  // before any correction
};
using Remesher = std::function<Outcome(const SurfaceMesh&, double edge)>;

Outcome by_us(const SurfaceMesh& input, double edge) {
  Outcome outcome{input, 0.0, 0.0};
  const double start = cpu_seconds();
  const RemeshReport report = remesh(outcome.mesh, even_mesh_options(edge));
  outcome.seconds = cpu_seconds() - start;
  outcome.volume_change = report.volume_change;
  if (!report.ok()) std::printf("ours: %s\n", report.text().c_str());
  return outcome;
}

Outcome by_cgal(const SurfaceMesh& input, double edge, unsigned iterations) {
  CgalMesh mesh = to_cgal(input);
  const double start = cpu_seconds();
  CGAL::Polygon_mesh_processing::isotropic_remeshing(
      mesh.faces(), edge, mesh, CGAL::parameters::number_of_iterations(iterations));
  Outcome outcome{{}, cpu_seconds() - start, 0.0};
  outcome.mesh = from_cgal(mesh);
  outcome.volume_change = enclosed_volume(outcome.mesh) / enclosed_volume(input) - 1.0;
  return outcome;
}

/// The outcome with the median time of remeshing to a mean edge. The target length is corrected
/// twice before.
Outcome median_outcome(const Remesher& remesher, const SurfaceMesh& input, double edge,
                       int repeats) {
  double asked = edge;
  for (int pass = 0; pass < 2; ++pass) asked *= edge / mean_edge(remesher(input, asked).mesh);
  std::vector<double> seconds;
  Outcome outcome;
  for (int i = 0; i < repeats; ++i) {
    outcome = remesher(input, asked);
    seconds.push_back(outcome.seconds);
  }
  std::ranges::sort(seconds);
  outcome.seconds = seconds[seconds.size() / 2];
  return outcome;
}

void print_row(const char* name, const char* who, const Outcome& outcome, double our_seconds) {
  const SurfaceQuality q = surface_quality(outcome.mesh, SurfaceTopology(outcome.mesh));
  std::printf("| %s | %s | %d | %.4g | %.1f | %.1f | %+.3f | %.4f | %.2f | %.2f |\n", name, who,
              q.num_vertices, q.mean_edge, q.low_angle_deg, q.min_angle_deg,
              100.0 * outcome.volume_change, outcome.seconds,
              1e6 * outcome.seconds / q.num_vertices, outcome.seconds / our_seconds);
  std::fflush(stdout);
}

void compare(const char* name, int num_vertices) {
  const SurfaceMesh input = shape(name, num_vertices);
  const double edge = mean_edge(input);
  const int repeats = num_vertices > 20000 ? 1 : 5;
  const Outcome ours = median_outcome(by_us, input, edge, repeats);
  print_row(name, "Meniscus", ours, ours.seconds);
  for (const unsigned iterations : {1U, 2U, 3U, 5U, 10U}) {
    const auto remesher = [iterations](const SurfaceMesh& mesh, double l) {
      return by_cgal(mesh, l, iterations);
    };
    char who[32];
    std::snprintf(who, sizeof who, "CGAL, %u iterations", iterations);
    print_row(name, who, median_outcome(remesher, input, edge, repeats), ours.seconds);
  }
}

}  // namespace
}  // namespace meniscus

int main(int argc, char** argv) {
  const int largest = argc > 1 ? std::atoi(argv[1]) : 100000;
  std::printf(
      "| shape | by | vertices | mean edge | 5 %% of angles below | smallest | volume, %% | "
      "CPU s | us/vertex | time/ours |\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (const int n : {1000, 10000, 100000})
    for (const char* name : {"sphere", "ellipsoid", "dumbbell"})
      if (n <= largest) meniscus::compare(name, n);
}
