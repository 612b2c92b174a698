#include "tests/topology/event_soak.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/remesh.hpp"
#include "meniscus/topology/mend.hpp"
#include "tests/topology/scenes.hpp"

namespace meniscus::test {
namespace {

// Coarse, for many scenes: of drops of radius 0.25 to 0.6. A bridge may add 1.5 gaps² of area,
// which is to stay below 1e-3 · 4π.
constexpr double kBreakupRadius = 0.13, kGap = 0.09, kFloor = 0.045;
constexpr double kC0 = 42.0 / (4.0 * std::numbers::pi);
constexpr double kBox = 3.0;
constexpr double kStep = 0.06;
constexpr int kTurn = 12;  // steps: strains of one or two

/// v = Σ a × k sin(k·x + φ): smooth and free of divergence.
class RandomFlow {
 public:
  explicit RandomFlow(std::mt19937& random) {
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> phase(0.0, 2.0 * std::numbers::pi);
    for (Mode& mode : modes_) {
      mode.k = 0.7 * Vec3(normal(random), normal(random), normal(random));
      const Vec3 a(normal(random), normal(random), normal(random));
      mode.v = 0.8 * a.cross(mode.k);
      mode.phase = phase(random);
    }
  }
  void turn(bool is_forth) { sign_ = is_forth ? 1.0 : -1.0; }
  [[nodiscard]] Vec3 operator()(const Vec3& x) const {
    // Drawn back to the middle: drops that drift apart meet no more.
    Vec3 v = -0.3 * x;
    for (const Mode& mode : modes_) v += sign_ * mode.v * std::sin(mode.k.dot(x) + mode.phase);
    return v;
  }

 private:
  struct Mode {
    Vec3 k, v;
    double phase;
  };
  std::array<Mode, 6> modes_;
  double sign_ = 1.0;
};

/// Drops that do not meet, the later ones fewer and fewer tries from being given up.
Scene random_scene(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const int wanted = 5 + static_cast<int>(random() % 26);
  std::vector<SurfaceMesh> drops;
  std::vector<std::pair<Vec3, double>> balls;
  for (int tries = 0; tries < 2000 && static_cast<int>(drops.size()) < wanted; ++tries) {
    const Vec3 center = kBox * Vec3(uniform(random), uniform(random), uniform(random));
    const double radius = 0.25 + 0.35 * std::abs(uniform(random));
    const bool is_clear = std::ranges::all_of(balls, [&](const auto& ball) {
      const double distance = (center - ball.first).norm();
      return distance > 1.1 * (radius + ball.second) || distance + 1.2 * radius < 0.9 * ball.second;
    });
    if (!is_clear) continue;
    drops.push_back(sphere(42, radius, center));
    balls.emplace_back(center, radius);
    // One drop in five holds another.
    if (random() % 5 == 0 && static_cast<int>(drops.size()) < wanted) {
      drops.push_back(sphere(42, 0.5 * radius, center));
      balls.emplace_back(center, 0.5 * radius);
    }
  }
  return scene_of(drops, kC0);
}

/// Every interface fit for the next step; false when the drops touch then.
bool remeshed(Scene& scene) {
  for (Interface& drop : scene.interfaces) {
    RemeshOptions options;
    options.C0 = drop.C0;
    options.volume = drop.volume;
    options.edge_floor = kFloor;
    options.find_fault = find_self_intersection;
    if (!remesh_or_mend(drop.mesh, options).remesh.ok) restore_volume(drop.mesh, drop.volume);
    if (!find_defect(drop.mesh).empty()) return false;
  }
  return find_touching_drops(scene).empty();
}

void record(const TopologyReport& report, EventSoak& soak) {
  for (const TopologyEvent& event : report.events) {
    ++(event.kind == EventKind::breakup ? soak.breakups : soak.coalescences);
    soak.largest_area_rise = std::max(
        soak.largest_area_rise, (event.area_after - event.area_before) / (4.0 * std::numbers::pi));
    soak.largest_volume_error = std::max(soak.largest_volume_error,
                                         std::abs(event.volume_after / event.volume_before - 1.0));
    soak.largest_volume_moved =
        std::max(soak.largest_volume_moved, event.volume_moved / event.volume_before);
  }
  soak.warnings += static_cast<int>(report.warnings.size());
  soak.log.insert(soak.log.end(), report.warnings.begin(), report.warnings.end());
}

}  // namespace

EventSoak event_soak(unsigned seed, int events, int max_steps) {
  std::mt19937 random(seed);
  Scene scene = random_scene(random);
  EventSoak soak;
  RandomFlow flow(random);
  const TopologyOptions options{.breakup_radius = kBreakupRadius,
                                .coalescence = true,
                                .coalescence_gap = kGap,
                                .edge_floor = kFloor};
  double dt = kStep;
  bool is_forth = true;
  while (soak.breakups + soak.coalescences < events && soak.steps < max_steps) {
    if (soak.steps % kTurn == 0) {
      // What a flow has drawn out it brings back: without tension nothing else would round it.
      if (is_forth) flow = RandomFlow(random);
      flow.turn(is_forth);
      is_forth = !is_forth;
    }
    ++soak.steps;
    Scene moved = scene;
    for (Interface& drop : moved.interfaces)
      for (Vec3& x : drop.mesh.x) {
        const Vec3 middle = x + 0.5 * dt * flow(x);
        x += dt * flow(middle);
      }
    const SurfaceMotion motion = motion_of(moved, flow);
    if (!remeshed(moved)) {
      ++soak.refused_steps;
      dt = std::max(0.5 * dt, 1e-4);
      flow = RandomFlow(random);
      is_forth = true;
      continue;
    }
    dt = std::min(kStep, 1.5 * dt);
    const Scene before = moved;
    const TopologyReport report = apply_topology(moved, options, motion);
    record(report, soak);
    soak.fault = report.refusal.empty() ? fault_after(before, moved, report) : report.refusal;
    if (!soak.fault.empty()) {
      soak.fault = fmt::format("seed {}, step {}: {}", seed, soak.steps, soak.fault);
      return soak;
    }
    scene = std::move(moved);
  }
  return soak;
}

}  // namespace meniscus::test
