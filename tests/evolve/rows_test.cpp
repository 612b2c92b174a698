// Run under mpirun too, on two and three ranks (tests/CMakeLists.txt): every rank does every test.
#include <gtest/gtest.h>

#include "boundary_integral_run.hpp"
#include "meniscus/linear/communicator.hpp"

namespace meniscus {
namespace {

/// A sheared drop that was solved for.
Evolution solved_drop(linear::Processes processes) {
  const Case c = test::unbounded_case({.flow = "simple-shear", .Ca = 0.3, .nodes = 60});
  EvolutionOptions options = c.evolution;
  options.processes = processes;
  Evolution evolution(build_scene(c), options, make_flow_solver(c));
  EXPECT_TRUE(evolution.prepare().ok());
  EXPECT_TRUE(evolution.solve().ok());
  return evolution;
}

TEST(RanksRows, SharedRowsAreThoseOfOneRankBitForBit) {
  const Evolution alone = solved_drop(linear::Processes::alone),
                  together = solved_drop(linear::Processes::all);
  const Rows own = alone.rows(), shared = together.rows();
  ASSERT_EQ(own.drops.size(), 1U);
  EXPECT_NE(own.history.surface_rate, 0.0);
  EXPECT_EQ(shared.history.surface_rate, own.history.surface_rate);
  EXPECT_EQ(shared.history.min_gap, own.history.min_gap);
  EXPECT_EQ(shared.history.stress, own.history.stress);
  EXPECT_EQ(shared.drops.size(), linear::Communicator::world().rank() == 0 ? own.drops.size() : 0U);
  const std::vector<DropRow> drops = together.moving_drop_rows();
  ASSERT_EQ(drops.size(), 1U);
  for (const DropRow& row : {drops[0], shared.drops.empty() ? drops[0] : shared.drops[0]}) {
    EXPECT_EQ(row.shape.D, own.drops[0].shape.D);
    EXPECT_EQ(row.shape.H_max, own.drops[0].shape.H_max);
    EXPECT_EQ(row.shape.volume, own.drops[0].shape.volume);
  }
}

}  // namespace
}  // namespace meniscus
