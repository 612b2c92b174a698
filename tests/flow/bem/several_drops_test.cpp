#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/LU>

#include "meniscus/core/archive.hpp"
#include "meniscus/core/error.hpp"
#include "tests/flow/bem/drop_scenes.hpp"

namespace meniscus::bem {
namespace {

using test::add_drop;
using test::solved;

constexpr Options kExact{.rtol = 1e-10, .max_iterations = 200};

/// A sphere and a smaller ellipsoid close to it, of unlike liquids.
Scene pair() {
  Scene scene = test::unbounded_scene(test::general_gradient());
  add_drop(scene, sphere(120), 0.2, 1.5);
  add_drop(scene, stretched_sphere(100, Vec3(0.8, 0.6, 0.5), Vec3(1.2, 1.1, 0.4)), 8.0, 0.7);
  scene.liquids[RegionId{1}].body_force = Vec3(0.1, 0.4, -0.3);
  return scene;
}

Scene turned(Scene scene, const Mat3& rotation) {
  for (Interface& interface : scene.interfaces)
    for (Vec3& x : interface.mesh.x) x = (rotation * x).eval();
  for (Liquid& liquid : scene.liquids) liquid.body_force = (rotation * liquid.body_force).eval();
  scene.flow = ImposedFlow(FlowFamily::general,
                           rotation * scene.flow.initial_gradient() * rotation.transpose());
  return scene;
}

TEST(SeveralDrops, VelocityTurnsWithTheScene) {
  const auto straight = solved(pair(), kExact).u;
  for (const unsigned seed : {1u, 2u}) {
    const Mat3 rotation = test::random_rotation(seed);
    auto back = solved(turned(pair(), rotation), kExact).u;
    for (std::size_t i = 0; i < back.size(); ++i) {
      for (Vec3& v : back[i]) v = (rotation.transpose() * v).eval();
      // The tangent frames of the fits turn with the scene only up to their own rotation, which
      // least squares do not see: round-off times the fits' conditioning.
      EXPECT_LT(test::largest_difference(back[i], straight[i]), 1e-8) << seed;
    }
  }
}

TEST(SeveralDrops, OrderOfDropsAndVerticesDoesNotMatter) {
  const Scene scene = pair();
  const auto straight = solved(scene, kExact).u;
  Scene mixed = scene;
  std::swap(mixed.interfaces[0], mixed.interfaces[1]);
  mixed.liquids[RegionId{1}] = scene.liquids[RegionId{2}];
  mixed.liquids[RegionId{2}] = scene.liquids[RegionId{1}];
  mixed.interfaces[0].inside = RegionId{1};
  mixed.interfaces[1].inside = RegionId{2};
  SurfaceMesh& mesh = mixed.interfaces[1].mesh;
  std::vector<std::int32_t> place(static_cast<std::size_t>(mesh.num_vertices()));
  std::iota(place.begin(), place.end(), 0);
  std::mt19937 random(7);
  std::ranges::shuffle(place, random);
  const SurfaceMesh before = mesh;
  for (const VertexId v : before.x.ids())
    mesh.x[VertexId{place[static_cast<std::size_t>(v.value)]}] = before.x[v];
  for (FaceVertices& face : mesh.faces)
    for (VertexId& v : face) v = VertexId{place[static_cast<std::size_t>(v.value)]};
  const auto shuffled = solved(mixed, kExact).u;
  EXPECT_LT(test::largest_difference(shuffled[0], straight[1]), 1e-8);
  VertexField<Vec3> first(before.num_vertices());
  for (const VertexId v : first.ids())
    first[v] = shuffled[1][VertexId{place[static_cast<std::size_t>(v.value)]}];
  EXPECT_LT(test::largest_difference(first, straight[0]), 1e-8);
}

TEST(SeveralDrops, NumberOfThreadsDoesNotChangeABit) {
  const auto one = solved(pair(), {.threads = 1}).u;
  for (const int threads : {2, 5}) {
    const auto more = solved(pair(), {.threads = threads}).u;
    EXPECT_EQ(more[0], one[0]);
    EXPECT_EQ(more[1], one[1]);
  }
}

// Far apart, each drop sees the other as a stresslet, of order (radius/distance)².
TEST(SeveralDrops, FarApartTheyAreAlone) {
  Scene alone = test::unbounded_scene(test::general_gradient());
  add_drop(alone, sphere(120), 5.0, 0.5);
  const auto single = solved(alone, kExact).u[0];
  double before = 0.0;
  for (const double distance : {20.0, 40.0}) {
    Scene both = alone;
    add_drop(both, sphere(120, 1.0, Vec3(distance, 0, 0)), 5.0, 0.5);
    const double influence = test::largest_difference(solved(both, kExact).u[0], single);
    EXPECT_LT(influence, 10.0 / (distance * distance));
    if (before > 0.0) {
      EXPECT_NEAR(before / influence, 4.0, 0.5);
    }
    before = influence;
  }
}

/// A drop of radius 1 without tension in v = E·x. Inside u = C E·x + D [5r²E·x − 2x(xEx)], outside
/// u = E·x + A x(xEx)/r⁵ + B [2E·x/r⁵ − 5x(xEx)/r⁷]; velocity and traction are continuous, part by
/// part along E·x and x(xEx).
class DropInStrain {
 public:
  explicit DropInStrain(double lambda) {
    Eigen::Matrix4d m;                      // of A, B, C, D
    m << 0, 2, -1, -5,                      //
        1, -5, 0, 2,                        //
        2, -16, -2 * lambda, -16 * lambda,  //
        -8, 40, 0, 19 * lambda;
    abcd_ = m.fullPivLu().solve(Eigen::Vector4d(-1, 0, -2, 0));
  }
  [[nodiscard]] double stretching() const { return abcd_[2] + 3.0 * abcd_[3]; }
  [[nodiscard]] Vec3 velocity(const Vec3& x, const Mat3& e) const {
    const double r2 = x.squaredNorm(), r5 = std::pow(r2, 2.5), xex = x.dot(e * x);
    const Vec3 ex = e * x;
    if (r2 < 1.0) return abcd_[2] * ex + abcd_[3] * (5.0 * r2 * ex - 2.0 * xex * x);
    return ex + abcd_[0] * xex / r5 * x + abcd_[1] * (2.0 / r5 * ex - 5.0 * xex / (r5 * r2) * x);
  }

 private:
  Eigen::Vector4d abcd_;
};

/// Largest error of u on a sphere about the drop, over the largest |u|.
double error_on(const SurfaceMesh& mesh, const VertexField<Vec3>& u, const DropInStrain& exact,
                const Mat3& gradient) {
  const Mat3 e = 0.5 * (gradient + gradient.transpose()), spin = gradient - e;
  double error = 0.0;
  for (const VertexId v : u.ids()) {
    const Vec3& x = mesh.x[v];
    error = std::max(error, (u[v] - exact.velocity(x, e) - spin * x).norm());
  }
  return error / test::largest_norm(u);
}

// An interface without tension between equal liquids is not there. Inside a drop it shows the
// drop's inner flow, around it the outer one.
TEST(NestedDrops, SeeTheFlowInsideAndAroundAnother) {
  const Mat3 g = test::general_gradient();
  for (const double lambda : {0.05, 20.0}) {
    const DropInStrain exact(lambda);
    ASSERT_NEAR(exact.stretching(), 5.0 / (2.0 * lambda + 3.0), 1e-12);
    Scene within = test::unbounded_scene(g);
    add_drop(within, sphere(300), lambda, 0.0);
    add_drop(within, sphere(150, 0.6), lambda, 0.0, RegionId{1});
    const auto inner = solved(within, kExact).u;
    EXPECT_LT(error_on(within.interfaces[0].mesh, inner[0], exact, g), 1e-3) << lambda;
    // Inside, what the sums leave is divided by the viscosity there, and the errors with it.
    EXPECT_LT(error_on(within.interfaces[1].mesh, inner[1], exact, g),
              std::max(1e-3, 3e-4 / lambda))
        << lambda;

    Scene around = test::unbounded_scene(g);
    add_drop(around, sphere(150, 1.5), 1.0, 0.0);
    add_drop(around, sphere(300), lambda, 0.0, RegionId{1});
    const auto outer = solved(around, kExact).u;
    EXPECT_LT(error_on(around.interfaces[0].mesh, outer[0], exact, g), 1e-3) << lambda;
    EXPECT_LT(error_on(around.interfaces[1].mesh, outer[1], exact, g), 1e-3) << lambda;
  }
}

TEST(NestedDrops, TurnWithARotatingLiquid) {
  Mat3 spin;
  spin << 0, -0.3, 0.5, 0.3, 0, -0.8, -0.5, 0.8, 0;
  Scene scene = test::unbounded_scene(spin);
  add_drop(scene, sphere(150), 20.0, 0.0);
  add_drop(scene, sphere(100, 0.6, Vec3(0.1, 0, 0)), 0.1, 0.0, RegionId{1});
  add_drop(scene, sphere(100, 0.3, Vec3(0.2, 0, 0)), 3.0, 0.0, RegionId{2});
  const auto u = solved(scene, kExact).u;
  for (std::size_t i = 0; i < u.size(); ++i)
    for (const VertexId v : u[i].ids())
      EXPECT_LT((u[i][v] - spin * scene.interfaces[i].mesh.x[v]).norm(), 1e-8) << i;
}

TEST(SeveralDrops, SolverGoesOnFromACheckpointBitForBit) {
  const Scene scene = pair();
  Scene moved = scene;
  for (Vec3& x : moved.interfaces[0].mesh.x) x += 0.01 * scene.flow.velocity(x, 0.0);
  const auto flow = make_boundary_integral_flow({});
  ASSERT_TRUE(flow->solve({scene}, {}).ok());
  Archive archive;
  flow->save(archive, {scene});
  const auto taken_up = make_boundary_integral_flow({});
  taken_up->load(archive, {scene});
  const Instant later{.t = 0.01};
  const FlowSolution first = flow->solve({moved}, later), second = taken_up->solve({moved}, later);
  ASSERT_TRUE(first.ok() && second.ok());
  EXPECT_EQ(first.iterations, second.iterations);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(first.velocity[i], second.velocity[i]);
  archive.reals["flow/guess/1"].pop_back();
  EXPECT_THROW(taken_up->load(archive, {scene}), InvalidInput);
}

TEST(SeveralDrops, AGoodGuessSavesIterations) {
  const Scene scene = pair();
  const auto flow = make_boundary_integral_flow({});
  const FlowSolution cold = flow->solve({scene}, {}), warm = flow->solve({scene}, {});
  ASSERT_TRUE(cold.ok() && warm.ok());
  EXPECT_GT(cold.iterations, 2);
  EXPECT_EQ(warm.iterations, 0);
}

TEST(SeveralDrops, AnUnsolvedEquationIsReported) {
  const auto flow = make_boundary_integral_flow({.rtol = 1e-12, .max_iterations = 2});
  const Scene scene = pair();
  const FlowSolution report = flow->solve({scene}, {});
  EXPECT_FALSE(report.ok());
  EXPECT_EQ(report.iterations, 2);
  EXPECT_NE(report.text().find("not solved in 2 iterations"), std::string::npos);
}

}  // namespace
}  // namespace meniscus::bem
