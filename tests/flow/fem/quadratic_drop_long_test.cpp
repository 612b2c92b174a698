// Quadratic elements at 400 vertices on the drop, as they move, in the volume mesh that is their
// default (docs/validation-stokes.md has the figures).
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/flow/fem/lamb_mode.hpp"
#include "tests/flow/fem/sphere_experiments.hpp"

namespace meniscus::fem {
namespace {

double relaxation_error(int num_vertices, double lambda, bool has_analytic_middles = false) {
  Method method(CapillaryForm::weak, Elements::p2_p1);
  method.has_analytic_middles = has_analytic_middles;
  method.shows_corners = false;
  return measured_relaxation_rate(num_vertices, method, 2, lambda) / relaxation_rate(2, lambda) -
         1.0;
}

double stretching_error(int num_vertices, double lambda) {
  const Method method(CapillaryForm::weak, Elements::p2_p1);
  return measured_stretching(num_vertices, lambda, 10.0, method) / exact_stretching(lambda, 10.0) -
         1.0;
}

// Measured on fitted middles: −4.1e-4, −3.6e-4 and −1.8e-4; on analytic ones −4.3e-4, −3.7e-4,
// −1.9e-4. What is left is the flow's own error around the drop.
TEST(QuadraticDropLong, RelaxesAtTheExactRate) {
  for (const double lambda : {0.1, 1.0, 10.0})
    for (const bool has_analytic_middles : {false, true})
      EXPECT_LT(std::abs(relaxation_error(400, lambda, has_analytic_middles)), 5e-4)
          << lambda << " " << has_analytic_middles;
}

// Measured: −1.7e-4 and +4.4e-4.
TEST(QuadraticDropLong, StretchesAtTheExactRate) {
  EXPECT_LT(std::abs(stretching_error(400, 0.1)), 1e-3);
  EXPECT_LT(std::abs(stretching_error(400, 10.0)), 2e-3);
}

// Measured: 1.7e-4.
TEST(QuadraticDropLong, IsNearlyAtRestUnderTensionAlone) {
  EXPECT_LT(static_sphere(400, {CapillaryForm::weak, Elements::p2_p1}).largest_velocity, 3e-4);
}

/// The order in 1/N0 of an error that is a function of N0.
template <class Error>
double order_in_nodes(const std::vector<int>& num_vertices, Error error) {
  std::vector<double> errors;
  for (const int n : num_vertices) errors.push_back(error(n));
  return 0.5 * order_in_h(num_vertices, errors);
}

TEST(QuadraticDropLong, ErrorsFallWithTheSquareOfTheNumberOfVertices) {
  for (const double lambda : {0.1, 10.0})
    EXPECT_GT(order_in_nodes({200, 400, 800}, [&](int n) { return stretching_error(n, lambda); }),
              1.8)
        << lambda;
  EXPECT_GT(order_in_nodes({200, 400, 800}, [](int n) { return relaxation_error(n, 1.0); }), 1.8);
  for (const double lambda : {0.1, 10.0})
    EXPECT_GT(order_in_nodes({200, 400}, [&](int n) { return relaxation_error(n, lambda, true); }),
              1.8)
        << lambda;
}

}  // namespace
}  // namespace meniscus::fem
