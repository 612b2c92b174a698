// Run under mpirun too, on two and three ranks (tests/CMakeLists.txt): every rank does every test.
#include "meniscus/core/error.hpp"
#include "meniscus/flow/bem/integral_equation.hpp"
#include "tests/flow/bem/drop_scenes.hpp"

namespace meniscus::bem {
namespace {

/// Two drops of unlike liquids; with three ranks the second rank has points of both.
Scene pair(double stretch = 1.1) {
  Scene scene = test::unbounded_scene(test::general_gradient());
  test::add_drop(scene, sphere(120), 0.2, 1.5);
  test::add_drop(scene, stretched_sphere(100, Vec3(stretch, 0.6, 0.5), Vec3(1.9, 1.1, 0.4)), 8.0,
                 0.7);
  return scene;
}

TEST(RanksShareIntegrals, ToTheBitsOfOneAlone) {
  const test::Solution alone = test::solved(pair());
  ASSERT_GT(alone.iterations, 3);
  for (const int threads : {1, 2}) {
    const test::Solution together =
        test::solved(pair(), {.threads = threads, .processes = linear::Processes::all});
    EXPECT_EQ(together.u, alone.u);
    EXPECT_EQ(together.iterations, alone.iterations);
  }
}

TEST(RanksShareIntegrals, OfOneSceneAlone) {
  const linear::Communicator world = linear::Communicator::world();
  const Scene own = pair(world.rank() + 1 == world.size() ? 1.0 : 1.1);
  if (world.size() == 1) {
    EXPECT_NO_THROW(IntegralEquation(own, 0.0, {.processes = linear::Processes::all}));
    return;
  }
  EXPECT_THROW(IntegralEquation(own, 0.0, {.processes = linear::Processes::all}), RunFailure);
}

}  // namespace
}  // namespace meniscus::bem
