#include "tests/evolve/resting_mode.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/scene/interface_tension.hpp"
#include "tests/evolve/boundary_integral_run.hpp"

namespace meniscus::test {
namespace {

/// ∫(r − 1)P_l dS and ∫(Γ − 1)P_l dS over ∫P_l² dS, the axis being x.
struct Amplitudes {
  double f = 0.0, g = 0.0;
};
Amplitudes amplitudes(const Interface& interface, unsigned l) {
  const VertexField<double> area = vertex_areas(interface.mesh);
  const VertexField<double>& concentration = *surfactant_concentration(interface);
  Amplitudes sum;
  double squared = 0.0;
  for (const VertexId v : area.ids()) {
    const Vec3& x = interface.mesh.x[v];
    const double mode = std::legendre(l, x.x() / x.norm());
    sum.f += area[v] * mode * (x.norm() - 1.0);
    sum.g += area[v] * mode * (concentration[v] - 1.0);
    squared += area[v] * mode * mode;
  }
  return {sum.f / squared, sum.g / squared};
}

/// Of the larger of f and g. With 0.01 what is of second order in it makes the slow mode l = 2 of λ
/// = 0.1 one percent slower.
constexpr double kAmplitude = 0.0025;

Case case_of(const Mode& mode, const RestingRun& run) {
  const std::string surroundings =
      run.is_meshed ? "[domain]\nshape = \"sphere\"\nradius = 10\nnodes = 250\n"
                    : "[domain]\nshape = \"unbounded\"\n[solver]\nmethod = \"boundary-integral\"\n";
  return parse_case(
      fmt::format("[flow]\nkind = \"quiescent\"\n[[drop]]\nradius = 1.0\nviscosity-ratio = {}\n"
                  "nodes = {}\n{}\n{}[time]\nend = {}\nmax-step = {}\n",
                  mode.lambda, run.nodes, run.surfactant, surroundings, run.end, run.max_step),
      "drop.toml");
}

/// Gives a sphere a mode; f is its amplitude.
void begin_with(const Mode& mode, double f, Interface& drop) {
  VertexField<double>& concentration = *surfactant_concentration(drop);
  for (const VertexId v : drop.mesh.x.ids()) {
    Vec3& x = drop.mesh.x[v];
    const double p = std::legendre(mode.l, x.x() / x.norm());
    x *= 1.0 + f * p;
    concentration[v] = 1.0 + f * mode.g_over_f * p;
  }
}

}  // namespace

std::array<Mode, 2> modes(unsigned degree, double lambda, double E0, double Pe) {
  const double l = degree;
  const double delta = (2 * (l * l - 1) * lambda + 2 * l * l + 1) *
                       ((2 * l * l + 4 * l + 3) * lambda + 2 * l * (l + 2));
  const double coupling = l * (l + 1) * ((l - 1) * lambda + l + 2) / delta;
  const double a11 = -(l - 1) * l * (l + 1) * (l + 2) * (2 * l + 1) * (1 + lambda) / delta,
               a12 = E0 * coupling, a21 = (l - 1) * (l + 2) * coupling,
               a22 =
                   -E0 * l * (l + 1) *
                       ((2 * l * l * l + 3 * l * l - 5) * lambda + 2 * l * l * l + 3 * l * l + 4) /
                       delta -
                   l * (l + 1) / Pe;
  const double mean = 0.5 * (a11 + a22), root = std::hypot(0.5 * (a11 - a22), std::sqrt(a12 * a21));
  const auto mode = [&](double eigenvalue) {
    return Mode{degree, lambda, -eigenvalue, (eigenvalue - a11) / a12};
  };
  return {mode(mean + root), mode(mean - root)};
}

RelativeRate relative_rate(const Mode& mode, const RestingRun& resting) {
  const Case c = case_of(mode, resting);
  Scene scene = build_scene(c);
  const bool is_shape = std::abs(mode.g_over_f) < 1.0;
  begin_with(mode, is_shape ? kAmplitude : kAmplitude / mode.g_over_f, scene.interfaces[0]);
  std::vector<std::pair<double, double>> found;
  const Report report = run(
      c, scene, [](EvolutionOptions&) {},
      [&](const Evolution& evolution) {
        const Amplitudes at = amplitudes(evolution.scene().interfaces[0], mode.l);
        found.emplace_back(evolution.t(), is_shape ? at.f : at.g);
      });
  EXPECT_TRUE(report.ok()) << report.text();
  return {std::log(found.front().second / found.back().second) /
              (found.back().first - found.front().first) / mode.rate,
          static_cast<int>(found.size()) - 1};
}

}  // namespace meniscus::test
