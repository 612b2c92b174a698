#include "tests/topology/event_soak.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <fmt/format.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_pieces.hpp"
#include "meniscus/surface/remesh.hpp"
#include "meniscus/surface/repair/mend.hpp"
#include "meniscus/surface/restore_volume.hpp"
#include "tests/topology/scenes.hpp"

namespace meniscus::test {
namespace {

// Coarse, for many scenes: of drops of radius 0.25 to 0.6. A bridge may add 1.5 gaps² of area,
// which is to stay below 1e-3 · 4π.
constexpr double kBreakupRadius = 0.13, kGap = 0.09, kFloor = 0.045;
constexpr double kC0 = 42.0 / (4.0 * std::numbers::pi);
constexpr double kBox = 2.5;
constexpr double kStep = 0.15;  // at 0.2 some drops crumple beyond mending
constexpr int kTurn = 8;        // steps: strains of one or two
// A drop of this radius is drawn to a neck, and its pieces can still be told from the neck.
constexpr double kBreakable = 2.2 * kBreakupRadius;
// Area over the sphere's beyond which a drop is only gathered: that of a cylinder nine diameters
// long, or of a disc a sixth as thick as wide.
constexpr double kCrumpled = 1.7;

/// A strain that fades away around a place, v = ∇ × (s ρ z e_φ exp(−r²/2w²)/2): at the place a
/// uniaxial extension of rate s along the axis, farther than w along it the opposite. So it draws a
/// drop into a dumbbell; with s < 0 it flattens one, or brings two together.
struct LocalStrain {
  Vec3 center, axis;
  double rate = 0.0, width = 0.0;

  [[nodiscard]] Vec3 operator()(const Vec3& x) const {
    const Vec3 d = x - center;
    const double fade = std::exp(-0.5 * d.squaredNorm() / (width * width));
    const double z = d.dot(axis);
    const Vec3 rho = d - z * axis;
    return rate * fade *
           (z * (1.0 - 0.5 * rho.squaredNorm() / (width * width)) * axis -
            0.5 * (1.0 - z * z / (width * width)) * rho);
  }
};

/// v = a × k sin(k·x + φ).
struct FourierMode {
  Vec3 k, v;
  double phase = 0.0;

  [[nodiscard]] Vec3 operator()(const Vec3& x) const { return v * std::sin(k.dot(x) + phase); }
};

/// Where a drop is and how it is shaped, for a flow that does something to it.
struct Place {
  Vec3 center, long_axis, short_axis;
  double radius = 0.0;
  double stretch = 0.0, flatness = 0.0;  ///< longest over middle, middle over shortest
  double area = 0.0;                     ///< over the sphere's

  explicit Place(const SurfaceMesh& mesh)
      : center(enclosed_centroid(mesh)),
        radius(std::cbrt(0.75 / std::numbers::pi * enclosed_volume(mesh))),
        area(surface_area(mesh) / (4.0 * std::numbers::pi * radius * radius)) {
    const Eigen::SelfAdjointEigenSolver<Mat3> moments(enclosed_second_moments(mesh));
    long_axis = moments.eigenvectors().col(2);
    short_axis = moments.eigenvectors().col(0);
    stretch = std::sqrt(moments.eigenvalues()[2] / moments.eigenvalues()[1]);
    flatness = std::sqrt(moments.eigenvalues()[1] / moments.eigenvalues()[0]);
  }
};

/// A random smooth velocity without divergence: for every drop a local strain that draws it apart,
/// flattens it, gathers it again or brings it to the drop beside it, over a few waves that turn and
/// shear all. A strain lasts for some steps or as long as its drops do.
class RandomFlow {
 public:
  /// `wanted`: how many drops there are to be; while there are fewer, more are drawn apart.
  RandomFlow(int wanted, std::mt19937& random) : wanted_(wanted), random_(random) {}

  void follow(const Scene& scene) {
    if (steps_++ % kTurn == 0) make_waves();
    std::erase_if(tasks_, [&](Task& task) {
      return --task.steps_left < 0 || !has_drop(scene, task.drop) || !has_drop(scene, task.other);
    });
    std::vector<Place> places;
    for (const Interface& drop : scene.interfaces) places.emplace_back(drop.mesh);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const int drop = scene.interfaces[i].drop;
      if (std::ranges::find(tasks_, drop, &Task::drop) != tasks_.end()) continue;
      const std::size_t other = nearest(places, i);
      const int steps = kTurn / 2 + static_cast<int>(random_() % kTurn);
      tasks_.push_back({strain_for(places, i, other), drop, scene.interfaces[other].drop, steps});
    }
  }
  /// All strains are drawn anew at the next step.
  void forget() { tasks_.clear(); }

  [[nodiscard]] Vec3 operator()(const Vec3& x) const {
    Vec3 v = Vec3::Zero();
    for (const Task& task : tasks_) v += task.strain(x);
    for (const FourierMode& wave : waves_) v += wave(x);
    return v;
  }

 private:
  struct Task {
    LocalStrain strain;
    int drop = -1, other = -1;  ///< ids
    int steps_left = 0;
  };

  static bool has_drop(const Scene& scene, int id) {
    return std::ranges::find(scene.interfaces, id, &Interface::drop) != scene.interfaces.end();
  }
  /// The drop whose surface is nearest to another drop's; the drop itself when it is alone.
  static std::size_t nearest(const std::vector<Place>& places, std::size_t i) {
    const auto gap = [&](const Place& other) {
      const double distance = (other.center - places[i].center).norm();
      return &other == &places[i] ? 1e300 : std::abs(distance - other.radius) - places[i].radius;
    };
    return static_cast<std::size_t>(std::ranges::min_element(places, {}, gap) - places.begin());
  }

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Vec3 vector() {
    std::normal_distribution<double> normal;
    const double x = normal(random_), y = normal(random_), z = normal(random_);
    return {x, y, z};
  }
  void make_waves() {
    for (FourierMode& wave : waves_) {
      wave.k = vector();
      wave.v = 0.08 * vector().cross(wave.k);
      wave.phase = uniform(0.0, 2.0 * std::numbers::pi);
    }
  }

  LocalStrain strain_for(const std::vector<Place>& places, std::size_t i, std::size_t other) {
    const Place& drop = places[i];
    const auto num = static_cast<double>(places.size());
    const bool is_breakable = drop.radius > kBreakable;
    if (drop.area > kCrumpled) return gathering(drop);
    if (is_breakable && uniform(0.0, 1.0) < wanted_ / (wanted_ + num)) return drawing(drop);
    if (is_breakable && uniform(0.0, 1.0) < 0.1) return flattening(drop);
    if (drop.stretch > 1.5 && uniform(0.0, 1.0) < 0.5) return gathering(drop);
    return other == i ? gathering(drop) : bringing(drop, places[other]);
  }
  LocalStrain drawing(const Place& drop) {
    // A drop that is long already goes on in its own direction.
    const Vec3 axis = drop.stretch > 1.2 ? drop.long_axis : Vec3(vector().normalized());
    const Vec3 center = drop.center + uniform(-0.3, 0.3) * drop.radius * axis;
    return {center, axis, uniform(0.8, 1.4), uniform(0.7, 1.1) * drop.radius};
  }
  LocalStrain flattening(const Place& drop) {
    return {drop.center, vector().normalized(), -uniform(0.6, 1.0),
            uniform(0.8, 1.2) * drop.radius};
  }
  /// Without tension nothing else rounds a drop.
  LocalStrain gathering(const Place& drop) {
    const double rate = uniform(0.5, 1.0);
    if (drop.flatness > drop.stretch)
      return {drop.center, drop.short_axis, rate, 1.5 * std::sqrt(drop.flatness) * drop.radius};
    return {drop.center, drop.long_axis, -rate, 1.5 * drop.stretch * drop.radius};
  }
  /// To another drop, or to the surface of the one that it lies in.
  LocalStrain bringing(const Place& drop, const Place& other) {
    const Vec3 apart = other.center - drop.center;
    const double distance = apart.norm();
    const double sign = distance < other.radius ? -1.0 : 1.0;
    const Vec3 axis =
        distance < 0.1 * drop.radius ? Vec3(vector().normalized()) : Vec3(sign / distance * apart);
    const double gap = std::abs(distance - other.radius) - drop.radius;
    const double reach = drop.radius + 0.5 * std::max(0.0, gap);
    return {drop.center + reach * axis, axis, -uniform(0.8, 1.6), 1.2 * reach};
  }

  int wanted_;
  std::mt19937& random_;
  int steps_ = 0;
  std::vector<Task> tasks_;
  std::array<FourierMode, 3> waves_;
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
    RemeshOptions options = sound_remeshing(drop.C0, kFloor);
    options.volume = drop.volume;
    if (!remesh_or_mend(drop.mesh, options).remesh.ok()) restore_volume(drop.mesh, drop.volume);
    if (find_defect(drop.mesh)) return false;
  }
  return !find_touching_drops(scene);
}

void record(const TopologyReport& report, const Scene& after, EventSoak& soak) {
  for (const TopologyEvent& event : report.events) {
    ++(event.kind == EventKind::breakup ? soak.breakups : soak.coalescences);
    soak.largest_area_rise = std::max(
        soak.largest_area_rise, (event.area_after - event.area_before) / (4.0 * std::numbers::pi));
    soak.largest_volume_error = std::max(soak.largest_volume_error,
                                         std::abs(event.volume_after / event.volume_before - 1.0));
    soak.largest_volume_moved =
        std::max(soak.largest_volume_moved, event.volume_moved / event.volume_before);
    for (const int id : event.children) {
      const auto child = std::ranges::find(after.interfaces, id, &Interface::drop);
      if (child == after.interfaces.end()) continue;  // the parent of another event
      soak.largest_volume_error = std::max(
          soak.largest_volume_error, std::abs(enclosed_volume(child->mesh) / child->volume - 1.0));
      soak.tori += euler_characteristic(child->mesh) < 2 ? 1 : 0;
      soak.nested += child->outside != RegionId{0} ? 1 : 0;
    }
  }
  soak.warnings += static_cast<int>(report.warnings.size());
  soak.log.insert(soak.log.end(), report.warnings.begin(), report.warnings.end());
}

}  // namespace

EventSoak event_soak(unsigned seed, int events, int max_steps) {
  std::mt19937 random(seed);
  Scene scene = random_scene(random);
  EventSoak soak;
  RandomFlow flow(static_cast<int>(scene.interfaces.size()), random);
  const TopologyOptions options{.breakup_radius = kBreakupRadius,
                                .coalescence = true,
                                .coalescence_gap = kGap,
                                .edge_floor = kFloor};
  double dt = kStep;
  while (soak.breakups + soak.coalescences < events && soak.steps < max_steps) {
    flow.follow(scene);
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
      flow.forget();
      continue;
    }
    dt = std::min(kStep, 1.5 * dt);
    const Scene before = moved;
    const TopologyReport report = apply_topology(moved, options, motion);
    record(report, moved, soak);
    soak.fault = report.refusal ? report.refusal->text : fault_after(before, moved, report);
    if (!soak.fault.empty()) {
      soak.fault = fmt::format("seed {}, step {}: {}", seed, soak.steps, soak.fault);
      return soak;
    }
    scene = std::move(moved);
  }
  return soak;
}

}  // namespace meniscus::test
