// A tension that varies along the surface, against exact solutions.
#include <cmath>

#include "meniscus/scene/interface_tension.hpp"
#include "tests/flow/bem/drop_scenes.hpp"

namespace meniscus::bem {
namespace {

constexpr Options kExact{.rtol = 1e-10, .max_iterations = 200};

/// Gives a drop the tension 1 + s(x), by a linear law.
template <class Function>
void vary_tension(Interface& drop, Function&& s) {
  constexpr double kElasticity = 0.5;
  drop.tension = 1.0;
  drop.surfactant = Surfactant{LinearState{kElasticity}, 0.0};
  VertexField<double> concentration;
  for (const Vec3& x : drop.mesh.x) concentration.add(1.0 - s(x) / kElasticity);
  drop.fields.on_vertices.push_back({.name = kSurfactantField,
                                     .unit = "",
                                     .transfer = FieldTransfer::conserved,
                                     .values = std::move(concentration)});
}

// σ = 1 + s cos θ moves a spherical drop at −2s/(3(2 + 3λ)) (young1959).
double migration_error(int count, double lambda) {
  Scene scene = test::unbounded_scene(Mat3::Zero());
  test::add_drop(scene, sphere(count), lambda, 1.0);
  vary_tension(scene.interfaces[0], [](const Vec3& x) { return 0.3 * x.z(); });
  const auto u = test::solved(scene, kExact).u[0];
  const SurfaceMesh& mesh = scene.interfaces[0].mesh;
  const double speed = test::amplitude(mesh, mesh.x, u, [](const Vec3& x) { return x.z(); });
  return std::abs(speed / (-2.0 * 0.3 / (3.0 * (2.0 + 3.0 * lambda))) - 1.0);
}

TEST(Marangoni, MovesADropTowardsLowTension) {
  for (const double lambda : {0.1, 1.0, 10.0}) {
    const double coarse = migration_error(110, lambda), fine = migration_error(440, lambda);
    RecordProperty(std::to_string(lambda), std::to_string(coarse) + " " + std::to_string(fine));
    EXPECT_LT(fine, 2e-3) << lambda << ' ' << coarse;
    EXPECT_GT(test::order(110, coarse, 440, fine), 1.8) << lambda << ' ' << coarse << ' ' << fine;
  }
}

// A constant σ given by a surfactant is the constant σ without one.
TEST(Marangoni, DoesNothingAtConstantTension) {
  Scene scene = test::unbounded_scene(test::general_gradient());
  test::add_drop(scene, stretched_sphere(150, Vec3(1.5, 1.0, 0.6), Vec3::Zero()), 3.0, 1.0);
  const auto without = test::solved(scene, kExact).u[0];
  vary_tension(scene.interfaces[0], [](const Vec3&) { return 0.0; });
  const auto with = test::solved(scene, kExact).u[0];
  EXPECT_LT(test::largest_difference(with, without), 1e-10);
}

// Whatever σ is, the force of a closed surface on itself is zero, and with it the flow far away of
// order 1/r: two drops far apart do not move one another.
TEST(Marangoni, ExertsNoNetForce) {
  const auto speed_at = [](double distance) {
    Scene scene = test::unbounded_scene(Mat3::Zero());
    test::add_drop(scene, stretched_sphere(200, Vec3(1.5, 1.0, 0.7), Vec3::Zero()), 1.0, 1.0);
    test::add_drop(scene, sphere(60, 0.3, Vec3(distance, 0.3, 0.2)), 1.0, 0.0);
    vary_tension(scene.interfaces[0],
                 [](const Vec3& x) { return 0.2 * x.x() * x.y() + 0.1 * x.z(); });
    scene.interfaces[1].fields = scene.interfaces[0].fields;
    scene.interfaces[1].fields.on_vertices[0].values = VertexField<double>(60, 0.0);
    return test::largest_norm(test::solved(scene, kExact).u[1]);
  };
  // Of a couple or a stresslet, 1/r².
  EXPECT_NEAR(std::log2(speed_at(20.0) / speed_at(40.0)), 2.0, 0.15);
}

}  // namespace
}  // namespace meniscus::bem
