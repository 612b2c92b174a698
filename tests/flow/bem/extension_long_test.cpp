// A drop stretched from a sphere in uniaxial extension, from case file to the last row.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "meniscus/case/case.hpp"
#include "meniscus/evolve/evolution.hpp"

namespace meniscus::bem {
namespace {

struct Shape {
  double t, L, B;
};

std::vector<Shape> stretched(int num_vertices, double lambda, double Ca, double end) {
  const Case c = parse_case(fmt::format(R"(
[flow]
kind = "uniaxial-extension"
capillary-number = {}
[[drop]]
radius = 1.0
viscosity-ratio = {}
nodes = {}
[domain]
shape = "unbounded"
[solver]
method = "boundary-integral"
[time]
end = {}
)",
                                        Ca, lambda, num_vertices, end),
                            "extension.toml");
  Evolution evolution(build_scene(c), c.evolution, make_flow_solver(c));
  Report report = evolution.prepare();
  std::vector<Shape> shapes;
  for (;;) {
    if (report.ok()) report = evolution.solve();
    if (!report.ok()) break;
    const DropShape shape = evolution.drop_rows()[0].shape;
    shapes.push_back({evolution.t(), shape.L, shape.B});
    if (evolution.is_finished()) break;
    report = evolution.advance();
  }
  EXPECT_TRUE(report.ok()) << report.text();
  return shapes;
}

/// Linear in time between two steps, which are short: 1e-5.
Shape at(const std::vector<Shape>& shapes, double t) {
  for (std::size_t i = 1; i < shapes.size(); ++i) {
    const Shape &a = shapes[i - 1], &b = shapes[i];
    if (b.t < t) continue;
    const double w = (t - a.t) / (b.t - a.t);
    return {t, (1.0 - w) * a.L + w * b.L, (1.0 - w) * a.B + w * b.B};
  }
  ADD_FAILURE() << "the run ended before t = " << t;
  return shapes.back();
}

/// The volume kept is that of a polyhedron with its vertices on the drop, which is O(1/N) smaller:
/// L and B have errors ~ 1/N, and their extrapolation from N and 2N is compared.
void expect_transient(double lambda, double Ca, const std::vector<Shape>& reference, int count,
                      double tolerance, double extrapolated_tolerance) {
  const double end = reference.back().t;
  const auto coarse = stretched(count, lambda, Ca, end),
             fine = stretched(2 * count, lambda, Ca, end);
  for (const Shape& exact : reference) {
    const Shape c = at(coarse, exact.t), f = at(fine, exact.t);
    EXPECT_NEAR(f.L, exact.L, tolerance) << exact.t;
    EXPECT_NEAR(f.B, exact.B, tolerance) << exact.t;
    EXPECT_NEAR(2.0 * f.L - c.L, exact.L, extrapolated_tolerance) << exact.t;
    EXPECT_NEAR(2.0 * f.B - c.B, exact.B, extrapolated_tolerance) << exact.t;
  }
}

// References: an axisymmetric boundary-integral program with a spectral meridian, written for the
// purpose, the same to six digits with 48, 64 and 96 modes; error below 2e-5.
TEST(Extension, DropOfTheMatrixsViscosityStretchesAsItShould) {
  expect_transient(1.0, 0.10,
                   {{0.25, 1.169178, 0.924644},
                    {0.5, 1.249837, 0.893722},
                    {0.75, 1.292985, 0.878056},
                    {1.0, 1.317700, 0.869292},
                    {1.5, 1.341455, 0.860988}},
                   150, 4e-3, 2e-3);
}

TEST(Extension, LessViscousDropStretchesAsItShould) {
  expect_transient(0.1, 0.17,
                   {{0.252, 1.274809, 0.885820},
                    {0.5, 1.419104, 0.839658},
                    {0.752, 1.510139, 0.813845},
                    {1.0, 1.570921, 0.797740}},
                   200, 6e-3, 3e-3);
}

}  // namespace
}  // namespace meniscus::bem
