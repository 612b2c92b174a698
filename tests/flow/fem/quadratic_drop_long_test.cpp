// Quadratic elements at 400 vertices on the drop, as they move, in the volume mesh that is their
// default (docs/validation-stokes.md has the figures).
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "tests/flow/fem/lamb_mode.hpp"
#include "tests/flow/fem/sphere_experiments.hpp"

namespace meniscus::fem {
namespace {

Method quadratic() { return {CapillaryForm::weak, Elements::p2_p1}; }

double relaxation_error(int num_vertices, double lambda, Method method, int l = 2) {
  method.shows_corners = false;
  return measured_relaxation_rate(num_vertices, method, l, lambda) / relaxation_rate(l, lambda) -
         1.0;
}

double relaxation_error(int num_vertices, double lambda, bool has_analytic_middles = false,
                        int l = 2) {
  Method method = quadratic();
  method.has_analytic_middles = has_analytic_middles;
  return relaxation_error(num_vertices, lambda, method, l);
}

/// Of the rate at which P_l relaxes, by interpolation alone. The rate is the flow's energy, whose
/// relative error is the squared one of gradients. On an edge h, a quadratic interpolates u' with
/// the mean square error h⁴ (u''')²/720. Outside the drop u falls as r^−l, u' as r^−(l+1), u''' as
/// (l+1)(l+2) r^−(l+3); `ratio` is that of the integrals of their squares.
double estimated_error(int num_vertices, int l) {
  const double ratio = std::pow((l + 1) * (l + 2), 2) * (2 * l - 1) / (2 * l + 3);
  const double face_edge2 = 8.0 * std::numbers::pi / (std::sqrt(3.0) * num_vertices);
  const double h2 = face_edge2 * std::pow(quadratic().volume_mesh.cell_volume, 2.0 / 3.0);
  return -h2 * h2 * ratio / 720.0;
}

/// The estimate knows one direction of three and no growth of the cells: a factor of three.
void expect_as_estimated(double error, int num_vertices, int l) {
  const double ratio = error / estimated_error(num_vertices, l);
  EXPECT_GT(ratio, 1.0 / 3.0) << num_vertices << " " << l;
  EXPECT_LT(ratio, 3.0) << num_vertices << " " << l;
}

double stretching_error(int num_vertices, double lambda) {
  return measured_stretching(num_vertices, lambda, 10.0, quadratic()) /
             exact_stretching(lambda, 10.0) -
         1.0;
}

struct Mode {
  int l;
  double lambda;
};

// Modes and viscosity ratios that the default volume mesh was not chosen by. Measured: 1.25 to 2.37
// of the estimate, 1.69 for l = 4; orders 2.02, 2.04, 1.97. The order is that of meshes whose
// cells do not grow inside the drop. By default they grow by half of their distance from the
// interface whatever N0 is, and the order for l = 3 is 1.68. The errors of two meshes of nearly the
// same size differ by a tenth, so that five are taken.
TEST(QuadraticDropLong, RelaxesWithTheErrorOfInterpolationAlone) {
  const std::vector<int> sizes = {200, 283, 400, 566, 800};
  Method even = quadratic();
  even.has_analytic_middles = true;
  even.volume_mesh.interior_growth = 0.0;
  for (const auto& [l, lambda] : {Mode{2, 0.3}, Mode{2, 3.0}, Mode{3, 1.0}}) {
    std::vector<double> errors;
    for (const int n : sizes) errors.push_back(relaxation_error(n, lambda, even, l));
    EXPECT_NEAR(0.5 * order_in_h(sizes, errors), 2.0, 0.3) << l << " " << lambda;
    for (const int n : {200, 400}) expect_as_estimated(relaxation_error(n, lambda, true, l), n, l);
    expect_as_estimated(relaxation_error(400, lambda, false, l), 400, l);  // fitted middles
  }
  expect_as_estimated(relaxation_error(200, 1.0, true, 4), 200, 4);
}

// Measured: −1.4e-4 and +4.1e-4.
TEST(QuadraticDropLong, StretchesAtTheExactRate) {
  EXPECT_LT(std::abs(stretching_error(400, 0.1)), 1e-3);
  EXPECT_LT(std::abs(stretching_error(400, 10.0)), 2e-3);
}

// Measured: 1.7e-4.
TEST(QuadraticDropLong, IsNearlyAtRestUnderTensionAlone) {
  EXPECT_LT(static_sphere(400, quadratic()).largest_velocity, 3e-4);
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
