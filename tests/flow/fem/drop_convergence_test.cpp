#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/flow/fem/lamb_mode.hpp"
#include "tests/flow/fem/sphere_experiments.hpp"

namespace meniscus::fem {
namespace {

// Measured elsewhere with P1–P1 elements on meshes of the same sizes: largest velocity × Ca and
// relative error of the jump, at N0 = 110, 200, 400. Other meshes of the same density give the same
// numbers to a factor of two, and regular ones smaller velocities.
struct StaticReference {
  CapillaryForm form;
  std::array<double, 3> velocity, jump;
};
const std::array<StaticReference, 3> static_references = {{
    {CapillaryForm::weak, {2.6e-2, 1.9e-2, 1.4e-2}, {3.0e-2, 1.7e-2, 9.1e-3}},
    {CapillaryForm::nodal, {5.5e-3, 2.7e-3, 8.3e-4}, {6.4e-2, 3.4e-2, 1.7e-2}},
    {CapillaryForm::balanced, {3.5e-3, 2.1e-3, 7.2e-4}, {3.8e-2, 2.0e-2, 1.0e-2}},
}};

TEST(StaticDrop, VelocitiesAndJumpsAreAsSmallAsMeasuredElsewhere) {
  const std::vector<int> num_vertices = {110, 200, 400};
  for (const StaticReference& reference : static_references) {
    std::vector<double> jumps;
    for (std::size_t i = 0; i < 3; ++i) {
      const StaticSphere measured = static_sphere(num_vertices[i], reference.form);
      jumps.push_back(measured.jump_error);
      EXPECT_LT(measured.largest_velocity, 2.0 * reference.velocity[i]) << num_vertices[i];
      EXPECT_LT(std::abs(measured.jump_error), 2.0 * reference.jump[i]) << num_vertices[i];
    }
    // A polyhedron's curvature: second order in h.
    EXPECT_GT(order_in_h(num_vertices, jumps), 1.8);
  }
}

// An ellipsoidal drop relaxes too slowly with the weak form, by what the elements resist. With the
// nodal form that error is there too, and one of the other sign: its curvature is too large, at
// N0 = 400 by at most what was measured elsewhere. The sum of the two lies between them, on any
// mesh: a finer one leaves the second, a better curvature the first.
TEST(Relaxation, ErrorsAt400VerticesLieBetweenThoseOfElementsAndCurvature) {
  const double exact = relaxation_rate(2, 1.0);
  const double weak = measured_relaxation_rate(400, CapillaryForm::weak, 2, 1.0) / exact - 1.0;
  const double nodal = measured_relaxation_rate(400, CapillaryForm::nodal, 2, 1.0) / exact - 1.0;
  constexpr double of_elements = 0.04;
  const double of_curvature = static_references[1].jump[2];
  EXPECT_LT(std::abs(weak), of_elements);
  EXPECT_GT(nodal, -of_elements);
  EXPECT_LT(nodal, of_curvature);
}

TEST(Relaxation, ErrorsFallWithTheMesh) {
  for (const double lambda : {0.1, 10.0}) {
    const double exact = relaxation_rate(3, lambda);
    const auto error = [&](int num_vertices) {
      const double rate =
          measured_relaxation_rate(num_vertices, CapillaryForm::balanced, 3, lambda);
      return std::abs(rate / exact - 1.0);
    };
    // A second-order error falls by 400/110 = 3.6; half of that where errors of opposite signs
    // cancel on the coarse mesh.
    EXPECT_LT(error(400), error(110) / 1.8) << lambda;
  }
}

// Second order in h, as the velocity's L2 error; within 0.2 of it from N0 = 400 on.
TEST(SmallDeformation, StretchingInsideASphereIsOfSecondOrder) {
  const std::vector<int> num_vertices = {400, 800, 1200};
  for (const double b : {2.0, 5.0})
    for (const double lambda : {0.1, 10.0}) {
      std::vector<double> errors;
      for (const int count : num_vertices)
        errors.push_back(measured_stretching(count, lambda, b) / exact_stretching(lambda, b) - 1.0);
      EXPECT_NEAR(order_in_h(num_vertices, errors), 2.0, 0.2) << b << " " << lambda;
      EXPECT_LT(std::abs(errors.back()), 0.02) << b << " " << lambda;
    }
}

TEST(SmallDeformation, StretchingIsExactAtEqualViscosities) {
  for (const double b : {2.0, 5.0}) {
    EXPECT_DOUBLE_EQ(exact_stretching(1.0, b), 1.0);
    EXPECT_NEAR(measured_stretching(110, 1.0, b), 1.0, 1e-6);  // the solver's tolerance is 1e-8
  }
}

// Before N0 = 200 a wall at two radii is not resolved and errors fall faster than h².
TEST(SmallDeformation, RelaxationInsideASphereIsOfSecondOrder) {
  const std::vector<int> num_vertices = {200, 400, 800};
  for (const double lambda : {0.1, 1.0, 10.0}) {
    const double exact = relaxation_rate(2, lambda, 2.0);
    std::vector<double> errors;
    for (const int count : num_vertices)
      errors.push_back(
          measured_relaxation_in_wall(count, lambda, 2.0, CapillaryForm::weak) / exact - 1.0);
    EXPECT_NEAR(order_in_h(num_vertices, errors), 2.0, 0.2) << lambda;
    EXPECT_LT(std::abs(errors.back()), 0.015) << lambda;
  }
}

/// Largest relative error of the decay at N0 = 400 over three viscosity ratios.
double largest_relaxation_error(double b, CapillaryForm form) {
  double largest = 0.0;
  for (const double lambda : {0.1, 1.0, 10.0}) {
    const double measured = measured_relaxation_in_wall(400, lambda, b, form);
    largest = std::max(largest, std::abs(measured / relaxation_rate(2, lambda, b) - 1.0));
  }
  return largest;
}

// The error is that in the unbounded liquid, 4 % at N0 = 400.
TEST(SmallDeformation, NodalRelaxationIsAsAccurateNearAWall) {
  EXPECT_LT(largest_relaxation_error(2.0, CapillaryForm::nodal), 0.04);
}
TEST(SmallDeformation, RelaxationIsAsAccurateInAWideContainer) {
  EXPECT_LT(largest_relaxation_error(5.0, CapillaryForm::weak), 0.04);
  EXPECT_LT(largest_relaxation_error(5.0, CapillaryForm::nodal), 0.04);
}

TEST(TranslatingDrop, MovesAsInClosedFormInAContainer) {
  const std::vector<int> num_vertices = {110, 200, 400};
  for (const double b : {3.0, 5.0})
    for (const double lambda : {0.1, 1.0, 10.0}) {
      double before = 1.0;
      for (const int count : num_vertices) {
        const double error = std::abs(measured_translation(count, lambda, b) - 1.0);
        EXPECT_LT(error, before) << b << " " << lambda << " " << count;
        before = error;
      }
      EXPECT_LT(before, 0.03) << b << " " << lambda;
    }
}

TEST(TranslatingDrop, ClosedFormHasTheKnownLimits) {
  // Hadamard–Rybczynski, far from walls.
  EXPECT_NEAR(exact_drag(1.0, 1e8), 5.0 * M_PI, 1e-5);
  EXPECT_NEAR(exact_drag(0.0, 1e8), 4.0 * M_PI, 1e-5);
  // The rigid sphere: 6π (1 − ε⁵)/(1 − 9ε/4 + 5ε³/2 − 9ε⁵/4 + ε⁶), ε = 1/b.
  const double e = 1.0 / 3.0;
  EXPECT_NEAR(exact_drag(1e9, 3.0) / (6.0 * M_PI),
              (1.0 - std::pow(e, 5)) /
                  (1.0 - 2.25 * e + 2.5 * std::pow(e, 3) - 2.25 * std::pow(e, 5) + std::pow(e, 6)),
              1e-7);
}

}  // namespace
}  // namespace meniscus::fem
