// Drops with surfactant: by boundary integrals and by finite elements, with every kind of step.
#include <algorithm>
#include <cmath>

#include "meniscus/evolve/surfactant_motion.hpp"
#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/scene/interface_tension.hpp"
#include "tests/evolve/boundary_integral_run.hpp"
#include "tests/evolve/damped_drop.hpp"
#include "tests/evolve/resting_mode.hpp"

namespace meniscus::test {
namespace {

double amount(const Evolution& evolution) {
  double sum = 0.0;
  for (const DropRow& row : evolution.drop_rows()) sum += row.surfactant->amount;
  return sum;
}

// The modes of docs/surfactant.md, rates by another program: l = 2, λ = 1, E0 = 0.5, Pe_s = 10.
TEST(Surfactant, HasTheModesOfTheory) {
  const auto [slow, fast] = modes(2, 1.0, 0.5, 10.0);
  EXPECT_NEAR(slow.rate, 0.4432776750, 1e-9);
  EXPECT_NEAR(fast.rate, 0.9281508964, 1e-9);
  EXPECT_NEAR(slow.g_over_f, 0.48528137, 1e-7);
}

TEST(Surfactant, LetsADropRelaxAtBothRates) {
  for (const Mode& mode : modes(2, 1.0, 0.5, 10.0)) {
    const double end = 0.7 / mode.rate;
    for (const char* law : {kLinear, kLangmuir})
      EXPECT_NEAR(relative_rate(mode, {.surfactant = law, .end = end}).value, 1.0, 0.015)
          << mode.rate << ' ' << law;
  }
}

// β = 50: a film that all but cannot be stretched. Steps are no shorter than a tenth.
TEST(Surfactant, BearsAStiffFilm) {
  const Mode soft = modes(2, 1.0, 0.5, kInfinity)[0], stiff = modes(2, 1.0, 50.0, kInfinity)[0];
  EXPECT_NEAR(stiff.rate, 24.0 / 55.0, 0.005);
  const auto found = [](const Mode& mode, const char* surfactant) {
    return relative_rate(mode, {.surfactant = surfactant, .nodes = 110, .end = 1.5});
  };
  const RelativeRate of_soft = found(soft, "surfactant = {elasticity = 0.5}"),
                     of_stiff = found(stiff, "surfactant = {elasticity = 50}");
  EXPECT_NEAR(of_stiff.value, 1.0, 0.03);
  EXPECT_LT(of_stiff.num_steps, 10 * of_soft.num_steps);
}

// Through remeshing, boundary integrals and finite elements.
TEST(Surfactant, KeepsItsAmount) {
  const Case c = unbounded_case({.flow = "simple-shear",
                                 .Ca = 0.2,
                                 .shape = std::string("radius = 1.0\n") + kLinear,
                                 .nodes = 110,
                                 .more = "[time]\nend = 1\n"});
  std::vector<double> amounts;
  const Report report = run(
      c, build_scene(c), [](EvolutionOptions&) {},
      [&](const Evolution& evolution) { amounts.push_back(amount(evolution)); });
  ASSERT_TRUE(report.ok()) << report.text();
  EXPECT_GT(amounts.size(), 4U);
  for (const double each : amounts) EXPECT_NEAR(each / amounts.front(), 1.0, 1e-12);
}

// Δc = 0.2 where the mean is 1.3.
TEST(Surfactant, HasAnErrorByWhatRatesTakeApart) {
  const Case c = unbounded_case({.flow = "simple-shear",
                                 .Ca = 0.2,
                                 .shape = std::string("radius = 0.8\n") + kLinear,
                                 .nodes = 110});
  Scene scene = build_scene(c);
  Interface& interface = scene.interfaces[0];
  VertexField<double>& concentration = *surfactant_concentration(interface);
  std::ranges::fill(concentration, 1.3);
  Carriers carriers(SurfaceShape::splined);
  const SurfactantPath path{scene, carriers.of(scene), carriers.of(scene), 0.5};
  const Carrier& carrier = *path.at_start[0];
  SurfactantTransport transport;
  transport.emplace_back(SurfaceTransport(
      carrier.surface, VertexField<Vec3>(interface.mesh.num_vertices(), Vec3::Zero()), 0.1));
  const VertexField<double> rate(interface.mesh.num_vertices(), 0.4);
  const AmountRates second{carrier.mass.amounts(rate)},
      first{VertexField<double>(interface.mesh.num_vertices(), 0.0)};
  EXPECT_NEAR(surfactant_error(path, transport, second, first),
              0.2 / 1.3 * 0.8 / mean_edge(interface.mesh), 1e-9);
  EXPECT_EQ(surfactant_error(path, transport, second, second), 0.0);
}

/// An ellipsoid with surfactant in shear, damped.
DampedDrop covered_drop(fem::Elements elements) {
  return {.elements = elements,
          .num_vertices = 60,
          .Ca = 0.3,
          .gradient = simple_shear(),
          .surfactant = Surfactant{LinearState{0.5}, 0.1}};
}

double largest_concentration(const Evolution& evolution) {
  return std::ranges::max(*surfactant_concentration(evolution.scene().interfaces[0]));
}

// By the difference from a run of short steps.
TEST(Surfactant, IsOfSecondOrderInTime) {
  const auto at_end = [](double dt) {
    Evolution evolution = evolution_of(covered_drop(fem::Elements::p1_p1), dt);
    run(evolution, 0.5);
    return largest_concentration(evolution);
  };
  const double exact = at_end(0.5 / 64);
  const double coarse = std::abs(at_end(0.125) - exact), fine = std::abs(at_end(0.0625) - exact);
  EXPECT_GT(std::log2(coarse / fine), 1.8) << coarse << ' ' << fine;
}

TEST(Surfactant, GoesOnFromACheckpointBitForBit) {
  const DampedDrop drop = covered_drop(fem::Elements::p2_p1);
  Evolution whole = evolution_of(drop, 0.1);
  const double before = amount(whole);
  run(whole, 0.2);
  Archive between;
  whole.save(between);
  Evolution resumed = evolution_of(drop, 0.1);
  resumed.load(between);
  run(whole, 0.4);
  run(resumed, 0.4);
  EXPECT_EQ(whole.scene().interfaces[0].fields, resumed.scene().interfaces[0].fields);
  EXPECT_EQ(whole.scene().interfaces[0].mesh.x, resumed.scene().interfaces[0].mesh.x);
  EXPECT_EQ(whole.scene().interfaces[0].surfactant, resumed.scene().interfaces[0].surfactant);
  EXPECT_NEAR(amount(whole) / before, 1.0, 1e-12);
  EXPECT_GT(largest_concentration(whole), 1.05);
}

}  // namespace
}  // namespace meniscus::test
