#include "tests/surface/soak.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <optional>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/remesh.hpp"
#include "meniscus/surface/sizing.hpp"
#include "tests/surface/smooth_shapes.hpp"

namespace meniscus::test {
namespace {

constexpr int kRounds = 10;
constexpr int kReferenceVertices = 1500;
constexpr double kEdgeFloor = 0.02;  // reached where a gap is narrower than 0.075

/// One interface: the mesh that is remeshed, and the exact shape, which follows the same maps.
struct Subject {
  SmoothShape shape;
  SmoothShape fine;          // where the law is integrated
  LevelCurvature curvature;  // there
  SurfaceMesh mesh;
  RemeshOptions options;

  explicit Subject(SmoothShape s)
      : shape(std::move(s)), fine(refined(shape)), curvature(fine), mesh(shape.mesh) {}
};

double curvature_integral(const Subject& subject) {
  const auto areas = smooth_vertex_areas(subject.fine.mesh);
  const auto squared = subject.curvature.squared_rms(Mat3::Identity());
  double sum = 0.0;
  for (const VertexId v : areas.ids()) sum += areas[v] * squared[v];
  return sum;
}

double integral_of_density(const SurfaceMesh& mesh, const VertexField<double>& length) {
  const auto areas = smooth_vertex_areas(mesh);
  double sum = 0.0;
  for (const VertexId v : areas.ids()) sum += areas[v] * density_of_length(length[v]);
  return sum;
}

/// By how much gaps and gradation raise the number of vertices, by the engine's own rule on the
/// surface that it was given.
double raised_by_others(const Subject& subject, const SurfaceMesh& given) {
  const SurfaceTopology topology(given);
  const SmoothSurface surface(given, topology);
  RemeshOptions without = subject.options;
  without.gap_layers = 0.0;
  without.gradation = std::numeric_limits<double>::infinity();
  const auto count = [&](const RemeshOptions& options) {
    return integral_of_density(given, rest_lengths(given, topology, surface, options));
  };
  return count(subject.options) / count(without);
}

/// ∮ρ dS of eq. 2 with the exact curvature of the shape under the map, which nothing averages, on a
/// mesh that has nothing to do with the remeshed one, times what is not in eq. 2: gaps and
/// gradation, which bound neighbouring lengths of the mesh at hand.
double law(const Subject& subject, const SurfaceMesh& given, const Mat3& map) {
  SurfaceMesh mesh = subject.fine.mesh;
  for (Vec3& x : mesh.x) x = map * x;
  auto length = subject.curvature.squared_rms(map);
  for (double& l : length)
    l = std::max(length_of_density(subject.options.C0 * l), subject.options.edge_floor);
  return raised_by_others(subject, given) * integral_of_density(mesh, length);
}

SmoothShape random_shape(std::mt19937& random, bool is_chain) {
  std::uniform_real_distribution<double> uniform(0.2, 0.8);
  if (is_chain) return random_chain(random, kReferenceVertices);
  return random_star(random, kReferenceVertices, uniform(random));
}

std::vector<Subject> random_subjects(std::mt19937& random, unsigned kind) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Subject> subjects;
  subjects.emplace_back(random_shape(random, kind == 1));
  if (kind == 2) {
    // The second shape is moved along x until the boxes nearly touch: the surfaces are then about
    // as near as their roundness lets them, and a bisection brings them to the gap.
    SmoothShape other = random_shape(random, uniform(random) < 0.5);
    const double gap = 0.03 * std::pow(10.0, uniform(random));  // 0.03 to 0.3
    double near = 0.0, far = 20.0;
    const SurfaceMesh& fixed = subjects[0].shape.mesh;
    const auto at = [&](double distance) {
      return affine_image(other, Mat3::Identity(), distance * Vec3::UnitX());
    };
    for (int i = 0; i < 30; ++i) {
      const double middle = 0.5 * (near + far);
      const SurfaceMesh mesh = at(middle).mesh;
      const bool is_apart = !find_intersection(fixed, mesh) &&
                            !encloses(fixed, mesh.x[VertexId{0}]) &&
                            smallest_gap(fixed, mesh) > gap;
      (is_apart ? far : near) = middle;
    }
    subjects.emplace_back(at(far));
  }
  for (Subject& subject : subjects) {
    const double nodes = 300.0 + 700.0 * uniform(random);
    subject.options.C0 = nodes / curvature_integral(subject);
    subject.options.find_fault = find_self_intersection;
    subject.options.gap_layers = 3.0;
    subject.options.edge_floor = kEdgeFloor;
  }
  return subjects;
}

/// One step of a steady random flow without divergence: strain and vorticity, |G| = 1, for 0.1 of
/// its time; a real step at 1000 nodes is a third of it.
Mat3 random_step(std::mt19937& random) {
  std::normal_distribution<double> normal;
  Mat3 g;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) g(i, j) = normal(random);
  g -= g.trace() / 3.0 * Mat3::Identity();
  return Mat3::Identity() + 0.1 / g.norm() * g;
}

void record_angles(const SurfaceMesh& mesh, SoakResult& result) {
  for (const FaceVertices& v : mesh.faces) {
    double least = 180.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = mesh.x[v[(k + 1) % 3]] - mesh.x[v[k]],
                 b = mesh.x[v[(k + 2) % 3]] - mesh.x[v[k]];
      least = std::min(least, std::atan2(a.cross(b).norm(), a.dot(b)) * 180.0 / M_PI);
    }
    ++result.faces;
    if (least < 20.0) ++result.faces_below;
    result.min_angle_deg = std::min(result.min_angle_deg, least);
  }
}

void remesh_and_judge(Subject& subject, const Mat3& map, int round, SoakResult& result) {
  const SurfaceMesh given = subject.mesh;
  const std::clock_t start = std::clock();
  const RemeshReport report = remesh(subject.mesh, subject.options);
  result.remesh_seconds += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  ++result.remeshes;
  result.vertices += subject.mesh.num_vertices();
  if (!report.ok()) {
    ++result.rollbacks;
    result.log.push_back(fmt::format("round {}: rolled back: {}", round, report.text()));
    return;
  }
  if (const std::string defect = text_of(find_defect(subject.mesh)); !defect.empty()) {
    ++result.invalid;
    result.log.push_back(fmt::format("round {}: {}", round, defect));
  }
  record_angles(subject.mesh, result);
  const double n = subject.mesh.num_vertices();
  const double count_error = std::abs(n / report.expected_vertices - 1.0);
  const double asked = law(subject, given, map);
  const double law_error = std::abs(n / asked - 1.0);
  result.law_sum += n / asked - 1.0;
  result.law_squares += (n / asked - 1.0) * (n / asked - 1.0);
  if (law_error > 0.05 || report.min_angle_deg < 5.0)
    result.log.push_back(fmt::format(
        "round {}: {} vertices, law {:.0f}, own {:.0f}, min angle {:.1f}, sweeps {}", round, n,
        asked, report.expected_vertices, report.min_angle_deg, report.sweeps));
  result.count_error = std::max(result.count_error, count_error);
  result.law_error = std::max(result.law_error, law_error);
}

}  // namespace

SoakResult soak(unsigned seed) {
  std::mt19937 random(seed);
  SoakResult result;
  std::vector<Subject> subjects = random_subjects(random, seed % 3);
  const Mat3 step = random_step(random);
  Mat3 map = Mat3::Identity();
  for (int round = 0; round <= kRounds; ++round) {
    if (round > 0) {
      map = step * map;
      for (Subject& subject : subjects)
        for (Vec3& x : subject.mesh.x) x = step * x;
    }
    for (std::size_t i = 0; i < subjects.size(); ++i) {
      std::optional<SurfaceTree> other;
      if (subjects.size() == 2) other.emplace(subjects[1 - i].mesh);
      subjects[i].options.neighbours.clear();
      if (other) subjects[i].options.neighbours.push_back(&*other);
      remesh_and_judge(subjects[i], map, round, result);
    }
    if (subjects.size() == 2)
      if (const auto fault = find_intersection(subjects[0].mesh, subjects[1].mesh)) {
        ++result.invalid;
        result.log.push_back(fmt::format("round {}: the pair: {}", round, fault->text));
      }
  }
  return result;
}

void add(SoakResult& total, const SoakResult& one) {
  total.remeshes += one.remeshes;
  total.rollbacks += one.rollbacks;
  total.invalid += one.invalid;
  total.faces += one.faces;
  total.faces_below += one.faces_below;
  total.min_angle_deg = std::min(total.min_angle_deg, one.min_angle_deg);
  total.law_error = std::max(total.law_error, one.law_error);
  total.law_sum += one.law_sum;
  total.law_squares += one.law_squares;
  total.count_error = std::max(total.count_error, one.count_error);
  total.remesh_seconds += one.remesh_seconds;
  total.vertices += one.vertices;
  total.log.insert(total.log.end(), one.log.begin(), one.log.end());
}

}  // namespace meniscus::test
