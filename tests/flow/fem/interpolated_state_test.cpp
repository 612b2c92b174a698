#include "meniscus/flow/fem/interpolated_state.hpp"

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/flow/fem/straight_space.hpp"

namespace meniscus::fem {
namespace {

/// Half the box is region `low`, the other half the other one.
BoxMesh halves(int n, double jitter, int low) {
  return box_mesh({.n = n,
                   .region = [low](const Vec3& x) { return x.z() < 0.0 ? low : 1 - low; },
                   .jitter = jitter});
}

Vec3 velocity(const Vec3& x, Elements elements) {
  const Vec3 linear(1.0 + x.y(), x.z() - x.x(), 2.0 * x.y());
  if (elements == Elements::p1_p1) return linear;
  return linear + Vec3(x.y() * x.z(), x.x() * x.x(), x.x() * x.y() - x.z() * x.z());
}

/// Linear in both halves, with a jump between them: `is_low` is the half z < 0.
double pressure(const Vec3& x, bool is_low) { return x.x() - 2.0 * x.z() + (is_low ? 5.0 : -3.0); }

StokesState exact_state(const TestSpace& test, int low) {
  StokesState state = state_at_rest(test.space);
  for (const NodeId i : state.v.ids())
    state.v[i] = velocity(test.positions.x[i], test.space.elements);
  const PressureSpace& space = test.space.pressure;
  for (std::size_t i = 0; i < state.p.size(); ++i)
    state.p[i] = pressure(test.mesh.x[space.vertex[i]], space.region[i].value == low);
  return state;
}

/// One state at the nodes of all cells.
StokesState interpolated_state(const StokesState& state, const MeshedSpace& from,
                               const MeshedSpace& to, const RegionSources& sources,
                               std::span<const NodeSource> places = {}) {
  const auto all = to.mesh.cells.ids();
  return interpolated_states({&state, 1}, from, to, sources, places,
                             std::vector<CellId>(all.begin(), all.end()))
      .front();
}

class InterpolatedState : public testing::TestWithParam<Elements> {};
INSTANTIATE_TEST_SUITE_P(EitherElement, InterpolatedState,
                         testing::Values(Elements::p1_p1, Elements::p2_p1));

// Functions of the space come over as they are, but for round-off: the pressure with its jump, also
// where the halves have changed their numbers and `sources` says so.
TEST_P(InterpolatedState, KeepsWhatBothSpacesHave) {
  for (const bool is_renumbered : {false, true}) {
    const int low = is_renumbered ? 0 : 1;
    const BoxMesh before = halves(4, 0.2, 1), after = halves(6, 0.2, low);
    const TestSpace from(before.mesh, GetParam()), to(after.mesh, GetParam());
    RegionSources sources;
    if (is_renumbered) {
      sources.add({RegionId{1}});
      sources.add({RegionId{0}});
    }
    const std::vector<NodeSource> known = node_sources(
        {before.mesh, from.space, from.positions}, {after.mesh, to.space, to.positions}, sources);
    for (const bool has_places : {false, true}) {
      const StokesState carried = interpolated_state(
          exact_state(from, 1), {before.mesh, from.space}, {after.mesh, to.space}, sources,
          has_places ? std::span(known) : std::span<const NodeSource>());
      const StokesState wanted = exact_state(to, low);
      for (const NodeId i : wanted.v.ids())
        EXPECT_LT((carried.v[i] - wanted.v[i]).norm(), 1e-12) << i.value;
      for (std::size_t i = 0; i < wanted.p.size(); ++i)
        EXPECT_NEAR(carried.p[i], wanted.p[i], 1e-12) << i;
    }
  }
}

// A region of which nothing is known takes what is nearest: here all of a mesh of one region.
TEST_P(InterpolatedState, OfUnknownOriginIsTakenFromAllCells) {
  const BoxMesh before = box_mesh({.n = 4, .jitter = 0.2}), after = halves(6, 0.2, 0);
  const TestSpace from(before.mesh, GetParam()), to(after.mesh, GetParam());
  RegionSources sources;
  sources.add({RegionId{0}});
  sources.add({});
  const StokesState carried = interpolated_state(exact_state(from, 0), {before.mesh, from.space},
                                                 {after.mesh, to.space}, sources);
  for (const NodeId i : carried.v.ids())
    EXPECT_LT((carried.v[i] - velocity(to.positions.x[i], GetParam())).norm(), 1e-12) << i.value;
  for (std::size_t i = 0; i < carried.p.size(); ++i)
    EXPECT_NEAR(carried.p[i], pressure(to.mesh.x[to.space.pressure.vertex[i]], true), 1e-12) << i;
}

// A walk around a drop may find its way barred, wherever the one before has ended.
TEST_P(InterpolatedState, IsFoundOnEverySideOfADrop) {
  const auto cube = [](int n) {
    return box_mesh(
        {.n = n, .region = [](const Vec3& x) { return x.cwiseAbs().maxCoeff() < 0.5 ? 1 : 0; }});
  };
  const BoxMesh before = cube(8), ordered = cube(12);
  TetMesh after = ordered.mesh;
  std::vector<std::int32_t> order(static_cast<std::size_t>(after.num_cells()));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::shuffle(order, std::mt19937(1));
  for (const CellId c : after.cells.ids()) {
    const CellId from{order[static_cast<std::size_t>(c.value)]};
    after.cells[c] = ordered.mesh.cells[from];
    after.region[c] = ordered.mesh.region[from];
  }
  ASSERT_GT(std::ranges::count(after.region, RegionId{1}), 100);
  const TestSpace from(before.mesh, GetParam()), to(after, GetParam());
  const StokesState carried =
      interpolated_state(exact_state(from, 1), {before.mesh, from.space}, {after, to.space}, {});
  const StokesState wanted = exact_state(to, 1);
  for (const NodeId i : wanted.v.ids())
    EXPECT_LT((carried.v[i] - wanted.v[i]).norm(), 1e-12) << i.value;
  for (std::size_t i = 0; i < wanted.p.size(); ++i)
    EXPECT_NEAR(carried.p[i], wanted.p[i], 1e-12) << i;
}

}  // namespace
}  // namespace meniscus::fem
