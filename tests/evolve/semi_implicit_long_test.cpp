#include <gtest/gtest.h>

#include "tests/evolve/damped_drop.hpp"

namespace meniscus::test {
namespace {

using fem::CapillaryForm;
using fem::Elements;

TEST(SemiImplicitLong, QuadraticElementsAreOfSecondOrderInTime) {
  for (const double order : orders_in_relaxation(Elements::p2_p1)) EXPECT_NEAR(order, 2.0, 0.2);
  for (const double order : orders_in_shear(Elements::p2_p1)) EXPECT_NEAR(order, 2.0, 0.2);
}

struct Way {
  Elements elements;
  CapillaryForm form;
  double viscosity_ratio;
};
class SemiImplicitBy : public testing::TestWithParam<Way> {};
INSTANTIATE_TEST_SUITE_P(FormAndViscosity, SemiImplicitBy,
                         testing::Values(Way{Elements::p1_p1, CapillaryForm::weak, 0.01},
                                         Way{Elements::p1_p1, CapillaryForm::weak, 1.0},
                                         Way{Elements::p1_p1, CapillaryForm::weak, 100.0},
                                         Way{Elements::p1_p1, CapillaryForm::balanced, 0.01},
                                         Way{Elements::p1_p1, CapillaryForm::balanced, 1.0},
                                         Way{Elements::p1_p1, CapillaryForm::balanced, 100.0},
                                         Way{Elements::p1_p1, CapillaryForm::nodal, 0.01},
                                         Way{Elements::p1_p1, CapillaryForm::nodal, 1.0},
                                         Way{Elements::p1_p1, CapillaryForm::nodal, 100.0},
                                         Way{Elements::p2_p1, CapillaryForm::weak, 0.01},
                                         Way{Elements::p2_p1, CapillaryForm::weak, 1.0},
                                         Way{Elements::p2_p1, CapillaryForm::weak, 100.0},
                                         Way{Elements::p2_p1, CapillaryForm::balanced, 0.01},
                                         Way{Elements::p2_p1, CapillaryForm::balanced, 1.0},
                                         Way{Elements::p2_p1, CapillaryForm::balanced, 100.0}));

// Ten times what explicit steps bear, from an ellipsoid with noise on its vertices.
TEST_P(SemiImplicitBy, IsStableAtLongSteps) {
  const auto [elements, form, viscosity_ratio] = GetParam();
  const std::vector<double> excess = excesses({.elements = elements,
                                               .form = form,
                                               .num_vertices = 200,
                                               .viscosity_ratio = viscosity_ratio,
                                               .noise = 0.01},
                                              16);
  for (std::size_t k = 1; k < excess.size() && excess[k - 1] > 1e-3; ++k)
    EXPECT_LT(excess[k], excess[k - 1]) << "step " << k;
}

}  // namespace
}  // namespace meniscus::test
