// Run under mpirun too, on two and three ranks (tests/CMakeLists.txt): every rank does every test.
#include "meniscus/evolve/remesh_interfaces.hpp"

#include <gtest/gtest.h>

#include "cosine_fields.hpp"
#include "near_pair.hpp"

namespace meniscus {
namespace {

EvolutionOptions layered(linear::Processes processes) {
  EvolutionOptions options;
  options.gap_layers = 3.0;
  options.surface = SurfaceShape::splined;
  options.processes = processes;
  return options;
}

State pair_with_fields() {
  State state;
  state.scene = test::near_pair();
  state.volume_shift.assign(2, 0.0);
  for (Interface& interface : state.scene.interfaces)
    interface.fields = test::cosines(interface.mesh);
  return state;
}

void expect_equal(const State& a, const State& b) {
  for (std::size_t i = 0; i < 2; ++i) {
    const Interface &p = a.scene.interfaces[i], &q = b.scene.interfaces[i];
    EXPECT_EQ(p.mesh.x, q.mesh.x);
    EXPECT_EQ(p.mesh.faces, q.mesh.faces);
    EXPECT_EQ(p.fields.on_vertices[0].values, q.fields.on_vertices[0].values);
    EXPECT_EQ(p.fields.on_faces[0].values, q.fields.on_faces[0].values);
  }
  EXPECT_EQ(a.volume_shift, b.volume_shift);
  EXPECT_EQ(a.shift_over_edge, b.shift_over_edge);
  EXPECT_EQ(a.field_excess.above, b.field_excess.above);
}

TEST(RemeshInterfaces, TheOrderDoesNotMatter) {
  State forth = pair_with_fields(), back = forth;
  const EvolutionOptions options = layered(linear::Processes::alone);
  const auto first = remesh_interfaces(forth, options, std::vector<std::size_t>{0, 1});
  const auto second = remesh_interfaces(back, options, std::vector<std::size_t>{1, 0});
  EXPECT_TRUE(first[0].ok() && first[1].ok());
  EXPECT_EQ(second[0].drop, 1);
  expect_equal(forth, back);
}

TEST(RanksRemeshInterfaces, SharedDropsAreThoseOfOneRankBitForBit) {
  State alone = pair_with_fields(), together = alone;
  const std::vector<std::size_t> both = {0, 1};
  const auto made = remesh_interfaces(alone, layered(linear::Processes::alone), both);
  const auto shared = remesh_interfaces(together, layered(linear::Processes::all), both);
  EXPECT_GT(alone.scene.interfaces[0].mesh.num_vertices(), 250);
  ASSERT_EQ(shared.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_TRUE(shared[k].ok()) << shared[k].text();
    EXPECT_EQ(shared[k].drop, made[k].drop);
  }
  expect_equal(alone, together);
}

TEST(RemeshedInterface, AFaultIsLoadedAsItWasSaved) {
  RemeshedInterface remeshed;
  remeshed.mesh = sphere(60);
  remeshed.shift = {1e-3, 0.2, {3.0, 4.0}};
  remeshed.outcome = {
      {Fault{FaultKind::folded_face, "at (1, 2, 3)", Vec3(1, 2, 3)}}, 7, true, 0.25, 2};
  Archive archive;
  save(remeshed, archive);
  const RemeshedInterface loaded = load_remeshed(archive);
  ASSERT_FALSE(loaded.outcome.ok());
  EXPECT_EQ(loaded.outcome.fault->kind, FaultKind::folded_face);
  EXPECT_EQ(loaded.outcome.text(), "at (1, 2, 3)");
  EXPECT_EQ(loaded.outcome.fault->position, Vec3(1, 2, 3));
  EXPECT_EQ(loaded.outcome.drop, 7);
  EXPECT_TRUE(loaded.outcome.is_mended);
  EXPECT_EQ(loaded.outcome.smoothed_over, 0.25);
  EXPECT_EQ(loaded.outcome.closed_holes, 2);
  EXPECT_EQ(loaded.shift.over_edge, 0.2);
  EXPECT_EQ(loaded.shift.field_excess.below, 4.0);
  EXPECT_EQ(loaded.mesh.x, remeshed.mesh.x);
}

}  // namespace
}  // namespace meniscus
