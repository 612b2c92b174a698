// Lesson 4: a flow solver of one's own drives the interface.
//
//   own_flow
//
// Evolution moves, remeshes, cuts and joins interfaces; where their velocity comes from is no
// concern of it. This solver has a vortex in closed form, and the drop is a mark in the liquid.
// Yours may call a program: it answers with a velocity at every vertex.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include "meniscus/core/error.hpp"
#include "meniscus/evolve/evolution.hpp"
#include "meniscus/io/surface_file.hpp"
#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace {

using namespace meniscus;

const Vec3 kCenter(1.5, 0.0, 0.0);
constexpr double kEnd = 1.5;

// The liquid at distance r from the z-axis turns about it at this rate, for ever. The rate falls
// outwards, so that the drop is wound up.
double rate_of_turning(double r) { return std::exp(-0.25 * r * r); }

Vec3 vortex(const Vec3& x) {
  const double rate = rate_of_turning(std::hypot(x.x(), x.y()));
  return {-rate * x.y(), rate * x.x(), 0.0};
}

// The exact motion backwards: where the liquid that is at x at time t was at time 0.
Vec3 at_first(const Vec3& x, double t) {
  const double angle = -t * rate_of_turning(std::hypot(x.x(), x.y()));
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * x.x() - s * x.y(), s * x.x() + c * x.y(), x.z()};
}

// Four functions make a flow solver. `solve` is the one with physics. `save` and `load` are for
// checkpoints: a solver that starts from its last solution keeps that there; this one keeps
// nothing.
class Vortex final : public FlowSolver {
 public:
  FlowSolution solve(const FlowDomain& domain, const Instant& /*instant*/) override {
    const PhaseTimer timer(times_, "vortex");
    FlowSolution flow;
    for (const Interface& interface : domain.scene.interfaces) {
      VertexField<Vec3> velocity;
      for (const Vec3& x : interface.mesh.x) velocity.add(vortex(x));
      flow.velocity.push_back(std::move(velocity));
    }
    return flow;  // a solver that finds none returns failed_flow(…); evolution shortens the step
  }
  void save(Archive& /*archive*/, const FlowDomain& /*domain*/) const override {}
  void load(const Archive& /*archive*/, const FlowDomain& /*domain*/) override {}
  [[nodiscard]] const PhaseTimes& times() const override { return times_; }

 private:
  PhaseTimes times_;
};

Scene marked_drop(int num_vertices) {
  Scene scene;
  scene.is_unbounded = true;
  scene.liquids = Field<RegionId, Liquid>(2);
  Interface drop;
  drop.mesh = sphere(num_vertices, 1.0, kCenter);
  drop.inside = RegionId{1};
  drop.outside = RegionId{0};
  drop.tension = 0.0;
  drop.C0 = num_vertices / (4.0 * std::numbers::pi);  // vertices per area and curvature squared
  drop.volume = drop.initial_volume = enclosed_volume(drop.mesh);
  scene.interfaces.push_back(drop);
  return scene;
}

// Steps as long as an estimate of their error allows; triangles anew when they need it; vertices
// along the normals of the smooth surface through them.
EvolutionOptions options() {
  EvolutionOptions options;
  options.end = kEnd;
  options.control = StepControl::error;
  options.tolerance = 0.02;
  options.motion_normal = MotionNormal::smooth;
  options.remesh_every = 0;
  return options;
}

void require(const Report& report) {
  if (!report.ok()) throw RunFailure(report.text());
}

struct Outcome {
  double distance;  ///< mean over the vertices of their distance from the exact surface, about
  double volume;    ///< relative change
};

// The order of calls: prepare, then solve and advance in turn. Between them everything is at one
// time, to be looked at or written. The last step passes the end: t says where it came to.
Outcome wind_up(int num_vertices) {
  Evolution evolution(marked_drop(num_vertices), options(), std::make_unique<Vortex>());
  require(evolution.prepare());
  for (;;) {
    require(evolution.solve());
    if (evolution.is_finished()) break;
    require(evolution.advance());
  }
  const Interface& drop = evolution.scene().interfaces[0];
  io::write_surface("vortex-" + std::to_string(num_vertices) + ".vtp", drop.mesh);
  // Carried back, every vertex ought to be at distance 1 from where the centre was.
  double sum = 0.0;
  for (const Vec3& x : drop.mesh.x)
    sum += std::abs((at_first(x, evolution.t()) - kCenter).norm() - 1.0);
  const Outcome outcome{sum / drop.mesh.num_vertices(),
                        enclosed_volume(drop.mesh) / drop.initial_volume - 1.0};
  std::printf("N0 = %d: t = %.3f in %d steps, %d vertices, off by %.1e, volume by %.0e\n",
              num_vertices, evolution.t(), static_cast<int>(evolution.step()),
              drop.mesh.num_vertices(), outcome.distance, outcome.volume);
  return outcome;
}

}  // namespace

int main() {
  try {
    const Outcome coarse = wind_up(100), fine = wind_up(400);
    // With half the edge the error falls by four or more. Volume is restored to round-off.
    return fine.distance < 0.35 * coarse.distance && fine.distance < 0.002 &&
                   std::abs(fine.volume) < 1e-12
               ? 0
               : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "own_flow: %s\n", error.what());
    return 2;
  }
}
