#include "tests/topology/scenes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <stdexcept>

#include <fmt/format.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/remesh.hpp"

namespace meniscus::test {
namespace {

using Profile = std::function<double(double)>;

/// π a ∫ r² dξ by Gauss-Chebyshev points: exact to 1e-8 for profiles that end like a sphere.
double exact_volume(double a, const Profile& profile) {
  constexpr int kPoints = 4000;
  double sum = 0.0;
  for (int i = 0; i < kPoints; ++i) {
    const double theta = std::numbers::pi * (i + 0.5) / kPoints;
    sum += std::sin(theta) * std::pow(profile(std::cos(theta)), 2);
  }
  return a * std::numbers::pi * std::numbers::pi / kPoints * sum;
}

}  // namespace

SurfaceMesh revolved(double a, const Profile& profile, double C0) {
  // From a sphere of radius a by equal factors, remeshed after each: r = (a√(1 − ξ²))^(1 − s) r^s.
  constexpr int kSteps = 30;
  SurfaceMesh mesh = sphere(static_cast<int>(4.0 * std::numbers::pi * C0), a);
  for (int k = 1; k <= kSteps; ++k) {
    const auto at_step = [&](double xi, double s) {
      const double round = a * std::sqrt(std::max(0.0, 1.0 - xi * xi));
      return round > 0.0 ? round * std::pow(profile(xi) / round, s) : 0.0;
    };
    const double s = static_cast<double>(k) / kSteps;
    for (Vec3& x : mesh.x) {
      const double xi = x.x() / a, before = at_step(xi, s - 1.0 / kSteps);
      if (before > 0.0)
        x = Vec3(x.x(), x.y() * at_step(xi, s) / before, x.z() * at_step(xi, s) / before);
    }
    const auto now = [&](double xi) { return at_step(xi, s); };
    const RemeshReport report = remesh(mesh, {.C0 = C0, .volume = exact_volume(a, now)});
    if (!report.ok() && k == kSteps)
      throw std::runtime_error("surface of revolution: " + report.text());
  }
  return mesh;
}

SurfaceMesh wavy_thread(double a, double b, int power, double amplitude, int waves, double C0) {
  return revolved(
      a,
      [=](double xi) {
        return b * std::sqrt(std::max(0.0, 1.0 - std::pow(xi, power))) *
               (1.0 + amplitude * std::cos(waves * std::numbers::pi * xi));
      },
      C0);
}

Scene scene_of(std::span<const SurfaceMesh> meshes, double C0) {
  Scene scene;
  scene.is_unbounded = true;
  scene.liquids.add({});
  for (const SurfaceMesh& mesh : meshes) {
    Interface interface;
    interface.drop = static_cast<int>(scene.interfaces.size());
    interface.mesh = mesh;
    interface.C0 = C0;
    interface.volume = interface.initial_volume = enclosed_volume(mesh);
    scene.interfaces.push_back(std::move(interface));
    scene.liquids.add({});
  }
  assign_regions(scene);
  return scene;
}

SurfaceMesh shuffled(const SurfaceMesh& mesh, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::int32_t> place(static_cast<std::size_t>(mesh.num_vertices())),
      order(static_cast<std::size_t>(mesh.num_faces()));
  std::iota(place.begin(), place.end(), 0);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::shuffle(place, random);
  std::ranges::shuffle(order, random);
  SurfaceMesh result;
  result.x = mesh.x;
  const auto moved = [&](VertexId v) { return VertexId{place[static_cast<std::size_t>(v.value)]}; };
  for (const VertexId v : mesh.x.ids()) result.x[moved(v)] = mesh.x[v];
  for (const std::int32_t f : order) {
    const FaceVertices& v = mesh.faces[FaceId{f}];
    const auto turn = static_cast<std::size_t>(random() % 3);
    result.faces.add({moved(v[turn]), moved(v[(turn + 1) % 3]), moved(v[(turn + 2) % 3])});
  }
  return result;
}

SurfaceMotion motion_of(const Scene& scene, const std::function<Vec3(const Vec3&)>& v) {
  SurfaceMotion motion;
  for (const Interface& interface : scene.interfaces) {
    VertexField<Vec3> velocity(interface.mesh.num_vertices());
    for (const VertexId i : velocity.ids()) velocity[i] = v(interface.mesh.x[i]);
    motion.add(interface.mesh, std::move(velocity));
  }
  return motion;
}

std::string fault_after(const Scene& before, const Scene& after, const TopologyReport& report) {
  int last_id = -1;
  for (const Interface& each : before.interfaces) last_id = std::max(last_id, each.drop);
  int next_id = last_id + 1;
  for (const TopologyEvent& event : report.events) {
    for (const int id : event.children)
      if (id != next_id++) return fmt::format("drop {} is not the next id", id);
    if (std::abs(event.volume_after - event.volume_before) > 1e-12 * event.volume_before)
      return fmt::format("an event's volume went from {} to {}", event.volume_before,
                         event.volume_after);
    if (event.area_after - event.area_before > 1e-3 * 4.0 * std::numbers::pi)
      return fmt::format("an event's area rose by {}", event.area_after - event.area_before);
  }
  for (const Interface& each : after.interfaces) {
    if (std::string defect = text_of(find_defect(each.mesh)); !defect.empty()) return defect;
    const double volume = enclosed_volume(each.mesh);
    if (std::abs(volume - each.volume) > 1e-12 * each.volume)
      return fmt::format("drop {} has volume {} instead of {}", each.drop, volume, each.volume);
    if (each.drop > last_id && each.mesh.num_vertices() < 42)
      return fmt::format("drop {} has {} vertices", each.drop, each.mesh.num_vertices());
  }
  return text_of(find_conflict(after));
}

}  // namespace meniscus::test
