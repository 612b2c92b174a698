// Transport on surfaces alone, against closed forms.
#include "meniscus/transport/surface_transport.hpp"

#include <cmath>
#include <functional>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus {
namespace {

using Velocity = std::function<Vec3(const Vec3& x)>;

constexpr SurfaceShape kShapes[] = {SurfaceShape::faceted, SurfaceShape::patched};

/// A surface and a concentration on it.
struct Covered {
  SurfaceMesh mesh;
  VertexField<double> concentration;
  SurfaceShape shape = SurfaceShape::patched;
};

VertexField<Vec3> at_vertices(const SurfaceMesh& mesh, const Velocity& v) {
  VertexField<Vec3> values;
  for (const Vec3& x : mesh.x) values.add(v(x));
  return values;
}

SurfaceMass mass_of(const SurfaceMesh& mesh, SurfaceShape shape) {
  return SurfaceMass(CarrierSurface(mesh, shape));
}

double total(const VertexField<double>& values) {
  double sum = 0.0;
  for (const double each : values) sum += each;
  return sum;
}

SurfaceMesh moved(SurfaceMesh mesh, const VertexField<Vec3>& motion, double dt) {
  for (const VertexId v : mesh.x.ids()) mesh.x[v] += dt * motion[v];
  return mesh;
}

/// One step with the transport of its middle.
void advance(Covered& drop, const Velocity& motion, const Velocity& slip, double D, double dt) {
  const SurfaceMesh half = moved(drop.mesh, at_vertices(drop.mesh, motion), 0.5 * dt);
  const SurfaceMesh end = moved(drop.mesh, at_vertices(half, motion), dt);
  const SurfaceTransport transport(CarrierSurface(half, drop.shape), at_vertices(half, slip), D);
  const SurfaceMass before = mass_of(drop.mesh, drop.shape), after = mass_of(end, drop.shape);
  const VertexField<double> rates = transport.mean_rates(drop.concentration, {before, after, dt});
  VertexField<double> amounts = before.amounts(drop.concentration);
  for (const VertexId v : amounts.ids()) amounts[v] += dt * rates[v];
  drop.concentration = after.concentration(amounts);
  drop.mesh = end;
}

const Velocity kNone = [](const Vec3&) { return Vec3(Vec3::Zero()); };

double order(double coarse, double fine) { return std::log2(coarse / fine); }

// With random slips and concentrations, on a random shape.
TEST(SurfaceTransport, KeepsTheTotal) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const SurfaceMesh mesh = stretched_sphere(150, Vec3(2.0, 1.0, 0.7), Vec3::Zero());
  VertexField<double> concentration(150);
  for (double& each : concentration) each = 1.0 + 0.3 * normal(random);
  VertexField<Vec3> slip(150);
  for (Vec3& s : slip) s = Vec3(normal(random), normal(random), normal(random));
  for (const SurfaceShape shape : kShapes) {
    const SurfaceTransport transport(CarrierSurface(mesh, shape), slip, 0.1);
    EXPECT_NEAR(total(transport.rates(concentration)), 0.0, 1e-12);
    const SurfaceMass before = mass_of(mesh, shape),
                      after = mass_of(moved(mesh, slip, 0.02), shape);
    EXPECT_NEAR(total(transport.mean_rates(concentration, {before, after, 0.05})), 0.0, 1e-12);
  }
}

// A liquid that turns as a whole with its surface changes nothing.
TEST(SurfaceTransport, LeavesARigidMotionAlone) {
  const Velocity spin = [](const Vec3& x) { return Vec3(Vec3(0.3, -0.2, 0.5).cross(x)); };
  Covered carrier{stretched_sphere(150, Vec3(2.0, 1.0, 0.7), Vec3::Zero()),
                  VertexField<double>(150)};
  for (const VertexId v : carrier.concentration.ids())
    carrier.concentration[v] = 1.0 + 0.2 * carrier.mesh.x[v].x();
  const VertexField<double> before = carrier.concentration;
  advance(carrier, spin, kNone, 0.0, 1e-3);
  for (const VertexId v : before.ids())
    EXPECT_NEAR(carrier.concentration[v], before[v], 1e-6);  // the turn by chords: O(dt²)
}

/// Where the amounts of a concentration settle on the unit sphere at rest, D = 1, within so long.
VertexField<double> settled(const SurfaceMesh& mesh, const VertexField<double>& concentration,
                            double dt) {
  const CarrierSurface surface(mesh, SurfaceShape::patched);
  const SurfaceMass mass(surface);
  return SurfaceTransport(surface, at_vertices(mesh, kNone), 1.0)
      .settled(mass.amounts(concentration), mass, dt);
}

// Twice an implicit stage of gamma dt, gamma = 1 - 1/sqrt(2): mode l = 1 is divided by
// (1 + 2 gamma dt)².
TEST(SurfaceTransport, SettlesASmoothConcentrationAsTheStagesDo) {
  const SurfaceMesh mesh = sphere(200);
  VertexField<double> concentration;
  for (const Vec3& x : mesh.x) concentration.add(x.z());
  const double dt = 0.3, stage = 1.0 + 2.0 * (1.0 - std::sqrt(0.5)) * dt;
  const VertexField<double> reached = settled(mesh, concentration, dt);
  for (const VertexId v : reached.ids())
    EXPECT_NEAR(reached[v], concentration[v] / (stage * stage), 2e-3);
}

// Mode l = 6 is divided by (1 + 42 gamma dt)² = 177, or stays where dt is short.
TEST(SurfaceTransport, EvensOutWhatVariesWithinAStep) {
  const SurfaceMesh mesh = sphere(400);
  VertexField<double> wavy;
  for (const Vec3& x : mesh.x) wavy.add(std::legendre(6, x.z()));
  const auto norm = [](const VertexField<double>& values) {
    double sum = 0.0;
    for (const double each : values) sum += each * each;
    return std::sqrt(sum);
  };
  EXPECT_NEAR(norm(settled(mesh, wavy, 1.0)) / norm(wavy), 1.0 / 177.0, 3e-4);
  EXPECT_NEAR(norm(settled(mesh, wavy, 1e-6)) / norm(wavy), 1.0, 1e-3);
}

// Mode l of a sphere decays at l(l + 1)D.
double decay_error(int num_vertices, double dt) {
  Covered carrier{sphere(num_vertices), {}};
  const auto mode = [](const Vec3& x) { return 1.5 * x.z() * x.z() - 0.5; };
  for (const Vec3& x : carrier.mesh.x) carrier.concentration.add(1.0 + 0.1 * mode(x));
  const double D = 0.2, end = 0.4;
  for (double t = 0.0; t < end - 1e-9; t += dt) advance(carrier, kNone, kNone, D, dt);
  double with_mode = 0.0, of_mode = 0.0;
  const VertexField<double> area = vertex_areas(carrier.mesh);
  for (const VertexId v : area.ids()) {
    const double f = mode(carrier.mesh.x[v]);
    with_mode += area[v] * f * (carrier.concentration[v] - 1.0);
    of_mode += area[v] * f * f;
  }
  return std::abs(with_mode / of_mode / (0.1 * std::exp(-6.0 * D * end)) - 1.0);
}

TEST(SurfaceMass, HasTheTotalOfTheConcentration) {
  const SurfaceMesh mesh = stretched_sphere(150, Vec3(2.0, 1.0, 0.7), Vec3::Zero());
  VertexField<double> concentration;
  for (const Vec3& x : mesh.x) concentration.add(1.0 + x.x());
  for (const SurfaceShape shape : kShapes) {
    const SurfaceMass mass = mass_of(mesh, shape);
    const VertexField<double> amounts = mass.amounts(concentration),
                              back = mass.concentration(amounts);
    EXPECT_NEAR(total(amounts) / mass.total(concentration), 1.0, 1e-14);
    for (const VertexId v : back.ids()) EXPECT_NEAR(back[v], concentration[v], 1e-13);
    EXPECT_NEAR(total(mass.areas()) / ReconstructedSurface(mesh, shape).area(), 1.0, 1e-12);
  }
}

/// What a mode P_l of a sphere changes per time, over the exact value: by a liquid that flows along
/// ∇_s P_l, by vertices that move along the normal with P_l, and by diffusion.
struct ModeErrors {
  double flux = 0.0, stretch = 0.0, diffusion = 0.0;
};
ModeErrors mode_errors(unsigned l, int num_vertices) {
  SurfaceMesh mesh = sphere(num_vertices);
  VertexField<double> mode, one(num_vertices, 1.0);
  VertexField<Vec3> along, out, none(num_vertices, Vec3::Zero());
  for (Vec3& x : mesh.x) {
    x.normalize();
    const double z = x.z(), slope = l == 2 ? 3.0 * z : 7.5 * z * z - 1.5;
    mode.add(std::legendre(l, z));
    along.add(slope * (Vec3::UnitZ() - z * x));
    out.add(std::legendre(l, z) * x);
  }
  const SurfaceShape shape = SurfaceShape::patched;
  const CarrierSurface surface(mesh, shape);
  const SurfaceMass mass(surface);
  const VertexField<double> area = mass.areas();
  const auto amplitude = [&](const VertexField<double>& values) {
    double with_mode = 0.0, of_mode = 0.0;
    for (const VertexId v : area.ids()) {
      with_mode += area[v] * values[v] * mode[v];
      of_mode += area[v] * mode[v] * mode[v];
    }
    return with_mode / of_mode;
  };
  constexpr double kStep = 1e-5;
  VertexField<double> stretched =
      mass_of(moved(mesh, out, kStep), shape).concentration(mass.amounts(one));
  for (double& each : stretched) each = (each - 1.0) / kStep;
  const double rate = l * (l + 1.0);
  return {
      amplitude(mass.concentration(SurfaceTransport(surface, along, 0.0).rates(one))) / rate - 1.0,
      amplitude(stretched) / -2.0 - 1.0,
      amplitude(mass.concentration(SurfaceTransport(surface, none, 1.0).rates(mode))) / -rate -
          1.0};
}

TEST(SurfaceTransport, ChangesTheModesOfASphere) {
  for (const unsigned l : {2U, 3U}) {
    const ModeErrors coarse = mode_errors(l, 200), fine = mode_errors(l, 800);
    for (const auto error : {&ModeErrors::flux, &ModeErrors::stretch, &ModeErrors::diffusion}) {
      EXPECT_LT(std::abs(coarse.*error), 0.007) << l;
      EXPECT_LT(std::abs(fine.*error), 0.0003) << l;
    }
  }
}

TEST(SurfaceTransport, DiffusesAsOnASphere) {
  const double coarse = decay_error(150, 0.025), fine = decay_error(600, 0.025);
  EXPECT_LT(fine, 1e-4);
  EXPECT_GT(order(coarse, fine), 3.0) << coarse << ' ' << fine;
}

TEST(SurfaceTransport, IsOfSecondOrderInTime) {
  // Against short steps on the same mesh.
  const auto run = [](double dt) {
    Covered carrier{sphere(150), {}};
    for (const Vec3& x : carrier.mesh.x) carrier.concentration.add(1.0 + 0.3 * x.z());
    const Velocity slip = [](const Vec3& x) { return Vec3(-x.z() * x.x(), -x.z() * x.y(), 1.0); };
    const Velocity motion = [](const Vec3& x) { return Vec3(0.2 * x.x(), -0.1 * x.y(), 0.0); };
    for (double t = 0.0; t < 0.8 - 1e-9; t += dt) advance(carrier, motion, slip, 0.1, dt);
    return carrier.concentration;
  };
  const auto difference = [](const VertexField<double>& a, const VertexField<double>& b) {
    double largest = 0.0;
    for (const VertexId v : a.ids()) largest = std::max(largest, std::abs(a[v] - b[v]));
    return largest;
  };
  const auto a = run(0.1), b = run(0.05), c = run(0.025);
  EXPECT_NEAR(order(difference(a, b), difference(b, c)), 2.0, 0.2);
}

// Steady under u = ∇_s φ: Γ = C exp(φ/D), φ = U cos θ, C = a/sinh a, a = U/D, for a mean of 1;
// errors in L2.
TEST(SurfaceTransport, BalancesConvectionByDiffusion) {
  const double U = 0.5, D = 0.25, a = U / D;
  const Velocity slip = [&](const Vec3& x) {
    return Vec3(U * (Vec3::UnitZ() - x.normalized() * x.normalized().z()));
  };
  const auto error = [&](int num_vertices) {
    Covered carrier{sphere(num_vertices), VertexField<double>(num_vertices, 1.0)};
    for (int i = 0; i < 40; ++i) advance(carrier, kNone, slip, D, 1.0);
    const VertexField<double> area = vertex_areas(carrier.mesh);
    double squared = 0.0, norm = 0.0;
    for (const VertexId v : carrier.mesh.x.ids()) {
      const double exact = a / std::sinh(a) * std::exp(a * carrier.mesh.x[v].z());
      squared += area[v] * std::pow(carrier.concentration[v] - exact, 2);
      norm += area[v] * exact * exact;
    }
    return std::sqrt(squared / norm);
  };
  const double coarse = error(200), fine = error(800);
  EXPECT_LT(fine, 1e-4);
  EXPECT_GT(order(coarse, fine), 3.0) << coarse << ' ' << fine;
}

// Γ ∝ R⁻² on a sphere that grows, to round-off: its patches scale with it.
TEST(SurfaceTransport, ThinsOutAsTheSurfaceGrows) {
  Covered carrier{sphere(100), VertexField<double>(100, 1.0)};
  const Velocity out = [](const Vec3& x) { return x; };
  for (int i = 0; i < 4; ++i) advance(carrier, out, kNone, 0.1, 0.05);
  const double radius = carrier.mesh.x[VertexId{0}].norm();
  EXPECT_GT(radius, 1.2);
  for (const double each : carrier.concentration) EXPECT_NEAR(each * radius * radius, 1.0, 1e-12);
}

}  // namespace
}  // namespace meniscus
