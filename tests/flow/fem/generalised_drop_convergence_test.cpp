// A shear-thinning drop in a Newtonian liquid.
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "meniscus/mesh/surface_measures.hpp"
#include "tests/flow/fem/sphere_experiments.hpp"
#include "tests/flow/meshed_flow.hpp"

namespace meniscus::fem {
namespace {

const CarreauYasuda law{
    .time_constant = 3.0, .power_index = 0.3, .yasuda_exponent = 2.0, .infinite_ratio = 0.02};
constexpr double lambda = 5.0;  // at rest
const Mat3 E = Vec3(1.0, -0.5, -0.5).asDiagonal();

/// A sphere without tension in the unbounded flow E·x. Inside, v = αE·x with α = 5/(3 + 2λ)
/// (taylor1932) for a Newtonian drop: one rate of strain everywhere, and so one viscosity. A
/// thinning drop flows as the Newtonian one of the viscosity that it has at this rate.
struct ThinningSphere {
  double viscosity = lambda;
  double stretching = 0.0;  ///< α

  ThinningSphere() {
    for (int k = 0; k < 200; ++k) {  // contracts by 2/3 and better: α varies less than 1/λ
      stretching = 5.0 / (3.0 + 2.0 * viscosity);
      const double rate = std::sqrt(2.0) * stretching * E.norm();
      viscosity = lambda * (0.02 + 0.98 * std::pow(1.0 + 9.0 * rate * rate, -0.35));
    }
  }
  /// Outside: continuous with that at r = 1, and with the stress.
  [[nodiscard]] Vec3 velocity_outside(const Vec3& x) const {
    const double r2 = x.squaredNorm(), r5 = r2 * r2 * std::sqrt(r2), b = 0.5 * (stretching - 1.0);
    const Vec3 Ex = E * x;
    return Ex + b / r5 * (2.0 * Ex + 5.0 * (1.0 - 1.0 / r2) * x.dot(Ex) * x);
  }
};

struct Measured {
  double velocity_error = 0.0;  ///< rms over the interface's vertices, over that of the velocity
  double stress_error = 0.0;    ///< of what thinning adds to the stress in the drop, relative
  double least_error = 0.0;     ///< of the least viscosity in the drop, which is the same all over
};

Measured measured(int num_vertices, Elements elements) {
  const ThinningSphere exact;
  Scene scene = sphere_in_sphere(
      {.num_vertices = num_vertices,
       .outer_radius = 2.5,
       .viscosity_ratio = lambda,
       .Ca = std::numeric_limits<double>::infinity(),
       .outer_per_inner = 3.0,
       .outer_velocity = [exact](const Vec3& x, double) { return exact.velocity_outside(x); }});
  scene.flow = ImposedFlow(FlowFamily::axial, E);
  scene.liquids[RegionId{1}].law = law;
  Options options;
  options.elements = elements;
  options.rtol = 1e-8;
  const FlowSolution flow = test::flow_in(scene, options);
  const VertexField<Vec3>& v = flow.velocity[0];
  Measured result;
  double squared = 0.0, whole = 0.0;
  const SurfaceMesh& drop = scene.interfaces[0].mesh;
  for (const VertexId i : v.ids()) {
    const Vec3 wanted = exact.stretching * (E * drop.x[i]);
    squared += (v[i] - wanted).squaredNorm();
    whole += wanted.squaredNorm();
  }
  result.velocity_error = std::sqrt(squared / whole);
  // 2(λ_e − λ)αE times the volume, which is that of the faces where these are flat.
  const double volume =
      elements == Elements::p1_p1 ? enclosed_volume(drop) : 4.0 / 3.0 * std::numbers::pi;
  const Mat3 wanted = 2.0 * volume * (exact.viscosity - lambda) * exact.stretching * E;
  result.stress_error = (flow.excess_stress[1] - wanted).norm() / wanted.norm();
  EXPECT_EQ(flow.excess_stress[0], Mat3(Mat3::Zero()));  // of the Newtonian matrix
  result.least_error = std::abs(flow.least_viscosity[1] / exact.viscosity - 1.0);
  EXPECT_EQ(flow.least_viscosity[0], 1.0);
  return result;
}

class ThinningDrop : public testing::TestWithParam<Elements> {};
INSTANTIATE_TEST_SUITE_P(P1AndP2, ThinningDrop, testing::Values(Elements::p1_p1, Elements::p2_p1));

TEST_P(ThinningDrop, FlowsAsOneOfTheViscosityThatItsRateGivesIt) {
  const ThinningSphere exact;
  EXPECT_LT(exact.viscosity, 0.6 * lambda);  // a test of thinning
  const bool is_quadratic = GetParam() == Elements::p2_p1;
  const std::vector<int> sizes =
      is_quadratic ? std::vector{60, 110, 200} : std::vector{110, 200, 400};
  std::vector<double> velocity, stress, least;
  for (const int n : sizes) {
    const Measured m = measured(n, GetParam());
    velocity.push_back(m.velocity_error);
    stress.push_back(m.stress_error);
    least.push_back(m.least_error);
  }
  for (std::size_t i = 1; i < sizes.size(); ++i) {
    EXPECT_LT(velocity[i], velocity[i - 1]);
    EXPECT_LT(stress[i], stress[i - 1]);
  }
  // P1 is on its way to 2: it comes to 1.4 from 110 to 200 vertices, to 1.7 from there to 400. P2
  // comes near 3 at the vertices, where it need not come above 2 but for its curved faces.
  const double lowest = is_quadratic ? 2.6 : 1.4;
  EXPECT_GT(order_in_h(sizes, velocity), lowest);
  EXPECT_GT(order_in_h(sizes, stress), lowest);
  EXPECT_LT(velocity.back(), is_quadratic ? 2.5e-3 : 2e-2);
  EXPECT_LT(stress.back(), is_quadratic ? 2.5e-3 : 2.5e-2);
  EXPECT_LT(least.back(), least.front());
  EXPECT_LT(least.back(), 0.1);
}

}  // namespace
}  // namespace meniscus::fem
