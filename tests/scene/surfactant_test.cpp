#include "meniscus/scene/surfactant.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "meniscus/core/log.hpp"
#include "meniscus/mesh/shapes.hpp"
#include "meniscus/scene/interface_tension.hpp"

namespace meniscus {
namespace {

const EquationOfState kLinear = LinearState{0.3};
const EquationOfState kLangmuir = LangmuirState{0.2, 0.5};

TEST(Surfactant, HasUnitTensionAtTheInitialConcentration) {
  EXPECT_DOUBLE_EQ(relative_tension(kLinear, 1.0).value, 1.0);
  EXPECT_DOUBLE_EQ(relative_tension(kLangmuir, 1.0).value, 1.0);
}

// E0 = −d ln σ/d ln Γ at Γ = 1: β, and EX/{(1 − X)[1 + E ln(1 − X)]}.
TEST(Surfactant, HasTheElasticityOfItsLaw) {
  EXPECT_DOUBLE_EQ(-relative_tension(kLinear, 1.0).slope, 0.3);
  EXPECT_NEAR(-relative_tension(kLangmuir, 1.0).slope, 0.232188, 1e-6);
  EXPECT_NEAR(-relative_tension(LangmuirState{0.371313, 0.5}, 1.0).slope, 0.5, 1e-6);
}

TEST(Surfactant, SlopesAreThoseOfTheTension) {
  for (const EquationOfState& state : {kLinear, kLangmuir})
    for (const double at : {0.1, 0.7, 1.4}) {
      const double h = 1e-5, difference = (relative_tension(state, at + h).value -
                                           relative_tension(state, at - h).value) /
                                          (2.0 * h);
      EXPECT_NEAR(relative_tension(state, at).slope, difference, 1e-9);
    }
}

TEST(Surfactant, LeavesNoTensionAtItsLimit) {
  for (const EquationOfState& state : {kLinear, kLangmuir})
    EXPECT_NEAR(relative_tension(state, zero_tension_concentration(state)).value, 0.0, 1e-12);
  EXPECT_EQ(packing_limit(kLangmuir), 2.0);
  EXPECT_TRUE(std::isinf(packing_limit(kLinear)));
  EXPECT_TRUE(std::isinf(zero_tension_concentration(LinearState{0.0})));
}

Scene covered_sphere(const EquationOfState& state) {
  Scene scene;
  scene.liquids = Field<RegionId, Liquid>(2, Liquid{});
  Interface drop;
  drop.mesh = sphere(60);
  drop.inside = RegionId{1};
  drop.outside = RegionId{0};
  drop.tension = 2.0;
  drop.surfactant = Surfactant{state, 0.1};
  drop.fields.on_vertices.push_back({.name = kSurfactantField,
                                     .unit = "",
                                     .transfer = FieldTransfer::conserved,
                                     .values = VertexField<double>(60, 1.0)});
  scene.interfaces.push_back(std::move(drop));
  return scene;
}

TEST(InterfaceTension, IsThatOfTheConcentration) {
  Scene scene = covered_sphere(kLinear);
  Interface& drop = scene.interfaces[0];
  VertexField<double>& concentration = *surfactant_concentration(drop);
  concentration[VertexId{7}] = 1.5;
  concentration[VertexId{8}] = 0.5;
  const VertexField<double> tension = vertex_tension(drop);
  EXPECT_DOUBLE_EQ(tension[VertexId{0}], 2.0);
  EXPECT_DOUBLE_EQ(tension[VertexId{7}], 2.0 * 0.85);
  EXPECT_DOUBLE_EQ(largest_tension(drop), 2.0 * 1.15);
  EXPECT_DOUBLE_EQ(largest_elasticity(drop), 2.0 * 0.3 * 1.5);
  drop.surfactant.reset();
  EXPECT_EQ(surfactant_concentration(drop), nullptr);
  EXPECT_DOUBLE_EQ(vertex_tension(drop)[VertexId{7}], 2.0);
}

TEST(InterfaceTension, NamesTheConcentrationThatHasNone) {
  Scene scene = covered_sphere(kLangmuir);
  EXPECT_FALSE(find_surfactant_fault(scene));
  for (const double wrong : {-0.1, std::numeric_limits<double>::quiet_NaN(), 2.0, 1.99999}) {
    (*surfactant_concentration(scene.interfaces[0]))[VertexId{5}] = wrong;
    const auto fault = find_surfactant_fault(scene);
    ASSERT_TRUE(fault) << wrong;
    EXPECT_EQ(fault->kind, FaultKind::concentration);
    EXPECT_EQ(fault->position, scene.interfaces[0].mesh.x[VertexId{5}]);
    EXPECT_NE(fault->text.find("surfactant on drop 0"), std::string::npos) << fault->text;
  }
}

}  // namespace
}  // namespace meniscus
