#include <cmath>

#include <gtest/gtest.h>

#include "tests/transport/bulk/conduction_run.hpp"

namespace meniscus::bulk {
namespace {

TEST(SphereConduction, MeetsTheTable) {
  EXPECT_NEAR(SphereConduction(10, 5, 10).at(0.0, 0.5), 0.2639191423, 1e-8);
  EXPECT_NEAR(SphereConduction(10, 5, 10).at(1.0, 0.05), 0.6432584217, 1e-8);
  EXPECT_NEAR(SphereConduction(0.1, 0.5, 10).at(1.0, 2.0), 0.0048585824, 1e-8);
  EXPECT_NEAR(SphereConduction(1, 1, 10).at(0.0, 0.1), 0.8282028557, 1e-8);
}

TEST(Conduction, OfASpeciesBetweenUnlikeLiquidsIsExactInTwoThousandths) {
  for (const ConductionErrors& e : conduction_errors(kBetter, {.is_species = true})) {
    EXPECT_LT(std::abs(e.centre), 2e-3);
    EXPECT_LT(std::abs(e.surface), 2e-3);
    EXPECT_LT(std::abs(e.mean), 2e-3);
  }
}

/// T at all nodes at t = 1, and the root of its mean square error.
struct Conducted {
  std::vector<double> T;
  double error = 0.0;
};
/// After so many steps from the exact field at t = 0.2.
Conducted after_steps(int steps, fem::Elements elements, int num_vertices = 60,
                      bool grows_inwards = true) {
  ScalarScene::Options options;
  options.elements = elements;
  options.grows_inwards = grows_inwards;
  options.spheres.num_vertices = num_vertices;
  options.spheres.outer_radius = 4.0;
  options.drop = {.capacity = 0.2, .conductivity = 0.1};
  options.wall.kind = ScalarCondition::Kind::value;
  ScalarScene drop(options);
  const SphereConduction exact(0.1, 0.5, 4.0);
  const NodePositions at = drop.positions(elements);
  BulkScalars scalars;
  EXPECT_TRUE(drop.solver->initial(drop.domain(), scalars).ok());
  const auto exact_at = [&](NodeId i, double t) {
    return at.x[i].norm() < 3.99 ? exact.at(at.x[i].norm(), t) : 0.0;
  };
  for (const NodeId i : at.x.ids())
    scalars[0].values[static_cast<std::size_t>(i.value)] = exact_at(i, 0.2);
  scalars[0].largest = 1.0;
  const FlowSolution rest;
  for (int n = 0; n < steps; ++n)
    EXPECT_TRUE(
        drop.solver->advance({drop.domain(), drop.domain(), 0.8 / steps, rest}, scalars).ok());
  double squared = 0.0;
  for (const NodeId i : at.x.ids())
    squared += std::pow(scalars[0].values[static_cast<std::size_t>(i.value)] - exact_at(i, 1.0), 2);
  return {scalars[0].values, std::sqrt(squared / at.x.size())};
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

TEST(Conduction, IsOfSecondOrderInTheStep) {
  for (const fem::Elements elements : {fem::Elements::p1_p1, fem::Elements::p2_p1}) {
    const auto coarse = after_steps(8, elements).T, middle = after_steps(16, elements).T,
               fine = after_steps(32, elements).T;
    EXPECT_NEAR(std::log2(distance(coarse, middle) / distance(middle, fine)), 2.0, 0.2);
  }
}

// Edges of half the length; steps so short that they do not count.
TEST(Conduction, IsOfSecondOrderInTheEdgeAtLeast) {
  const double order = std::log2(after_steps(24, fem::Elements::p2_p1, 60).error /
                                 after_steps(24, fem::Elements::p2_p1, 240).error);
  RecordProperty("order", std::to_string(order));
  EXPECT_GT(order, 2.0);
}

// Linear elements come near to it between 240 and 960 vertices, if cells in the drop's middle are
// refined with its surface.
TEST(Conduction, IsOfNearlySecondOrderOnLinearElements) {
  const double order = std::log2(after_steps(48, fem::Elements::p1_p1, 240, false).error /
                                 after_steps(48, fem::Elements::p1_p1, 960, false).error);
  RecordProperty("order", std::to_string(order));
  EXPECT_NEAR(order, 2.0, 0.3);
}

}  // namespace
}  // namespace meniscus::bulk
