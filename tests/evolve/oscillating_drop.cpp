#include "tests/evolve/oscillating_drop.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/scene/interface_tension.hpp"
#include "tests/evolve/boundary_integral_run.hpp"

namespace meniscus::test {
namespace {

/// ∫(r − 1)P_l dS over ∫P_l² dS.
double height(const Interface& interface, int l) {
  const VertexField<double> area = vertex_areas(interface.mesh);
  double sum = 0.0, squared = 0.0;
  for (const VertexId v : area.ids()) {
    const Vec3& x = interface.mesh.x[v];
    const double mode = std::legendre(static_cast<unsigned>(l), x.x() / x.norm());
    sum += area[v] * mode * (x.norm() - 1.0);
    squared += area[v] * mode * mode;
  }
  return sum / squared;
}

std::string surfactant_table(const Oscillation& of) {
  if (of.E0 == 0.0) return "";
  return fmt::format("[drop.surfactant]\nelasticity = {}\npeclet = {}\n", of.E0,
                     of.D_s > 0.0 ? fmt::format("{}", 1.0 / of.D_s) : "inf");
}

/// f after each step, the first at the start.
std::vector<double> heights(const OscillatingDrop& drop, double step) {
  const double period = step * drop.steps;
  const Case c = parse_case(
      fmt::format("[flow]\nkind = \"quiescent\"\nreynolds-number = {}\n[[drop]]\nradius = 1.0\n"
                  "viscosity-ratio = {}\ndensity-ratio = {}\nnodes = {}\n{}[domain]\n"
                  "shape = \"sphere\"\nradius = {}\nnodes = 250\n[time]\nend = {}\n"
                  "max-step = {}\n{}\n"
                  "[interface]\nremesh-every = 0\n",
                  drop.of.La, drop.of.lambda, drop.of.density_ratio, drop.nodes,
                  surfactant_table(drop.of), drop.of.b, period * drop.periods - 0.5 * step, step,
                  drop.more),
      "drop.toml");
  const OscillationMode mode(drop.of, drop.guess);
  Scene scene = build_scene(c);
  const SurfaceMesh sphere = scene.interfaces[0].mesh;
  const auto mode_at = [&](VertexId v) {
    const Vec3& x = sphere.x[v];
    return std::legendre(static_cast<unsigned>(drop.of.l), x.x() / x.norm());
  };
  for (const VertexId v : sphere.x.ids())
    scene.interfaces[0].mesh.x[v] *= 1.0 + drop.height * mode_at(v);
  if (VertexField<double>* concentration = surfactant_concentration(scene.interfaces[0]))
    for (const VertexId v : concentration->ids())
      (*concentration)[v] = 1.0 + mode.concentration(drop.height) * mode_at(v);
  scene.initial_velocity = [&](const Vec3& x) { return mode.velocity(x, drop.height); };
  std::vector<double> found;
  const Report report = run(
      c, scene,
      [](EvolutionOptions& options) {  // all steps are the longest ones
        options.control = StepControl::paper;
        options.step_factor = 1e4;
        options.tolerance = kMostError;
      },
      [&](const Evolution& evolution) {
        found.push_back(height(evolution.scene().interfaces[0], drop.of.l));
      });
  EXPECT_TRUE(report.ok()) << report.text();
  return found;
}

double step_of(const OscillatingDrop& drop) {
  return 2.0 * std::numbers::pi / OscillationMode(drop.of, drop.guess).rate().imag() / drop.steps;
}

}  // namespace

std::complex<double> fitted_rate(const OscillatingDrop& drop) {
  const double step = step_of(drop);
  const std::vector<double> f = heights(drop, step);
  // f(t + Δt) = p f(t) − q f(t − Δt), whose roots are e^(−sΔt) and its conjugate.
  double aa = 0.0, ab = 0.0, bb = 0.0, ac = 0.0, bc = 0.0;
  for (std::size_t n = 1; n + 1 < f.size(); ++n) {
    aa += f[n] * f[n];
    ab += f[n] * f[n - 1];
    bb += f[n - 1] * f[n - 1];
    ac += f[n] * f[n + 1];
    bc += f[n - 1] * f[n + 1];
  }
  const double determinant = aa * bb - ab * ab;
  const double p = (ac * bb - bc * ab) / determinant, q = -(bc * aa - ac * ab) / determinant;
  // Their modulus is the root of q, their real part p/2.
  return {-0.5 * std::log(q) / step, std::acos(0.5 * p / std::sqrt(q)) / step};
}

double decay_rate(OscillatingDrop drop, double step, int steps) {
  drop.steps = steps;
  drop.periods = 1.0;
  const std::vector<double> f = heights(drop, step);
  return std::log(f.front() / f.back()) / (step * (static_cast<double>(f.size()) - 1.0));
}

double last_height(const OscillatingDrop& drop) { return heights(drop, step_of(drop)).back(); }

}  // namespace meniscus::test
