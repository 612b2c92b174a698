#include <cmath>

#include <gtest/gtest.h>

#include "meniscus/flow/fem/liquid_boundary.hpp"
#include "meniscus/flow/fem/stokes_jacobian.hpp"
#include "tests/flow/fem/straight_space.hpp"

namespace meniscus::fem {
namespace {

// Liquids that reach the outer boundary, and whose own boundary meets itself along an edge; one
// around another; one alone, in so few cells that every node is on its boundary.
const std::vector<BoxOptions> kBoxes = {
    {.n = 4, .region = [](const Vec3& x) { return x.x() * x.y() > 0.0 ? 1 : 0; }, .jitter = 0.2},
    {.n = 6, .region = [](const Vec3& x) { return x.norm() < 0.6 ? 1 : 0; }, .jitter = 0.2},
    {.n = 1}};

/// Some nodes fixed, some sliding on a slanted plane, others, of the outer boundary too, free.
void constrain(StokesProblem& problem) {
  const std::vector<Vec3> slanted = {Vec3(1.0, 2.0, -0.5).normalized()}, level = {Vec3::UnitZ()};
  for (std::int32_t i = 0; i < problem.force.size(); i += 11)
    problem.constraints.forbid_penetration(NodeId{i}, slanted);
  for (std::int32_t i = 3; i < problem.force.size(); i += 13)
    problem.constraints.forbid_penetration(NodeId{i}, level);
  for (std::int32_t i = 5; i < problem.force.size(); i += 17)
    problem.constraints.fix(NodeId{i}, Vec3::Zero());
}

void expect_same(std::span<const double> values, std::span<const double> wanted) {
  ASSERT_EQ(values.size(), wanted.size());
  double largest = 0.0;
  for (const double each : wanted) largest = std::max(largest, std::abs(each));
  EXPECT_GT(largest, 0.0);
  // Sums of some thirty terms in another order, which may each be larger than the largest sum.
  for (std::size_t i = 0; i < values.size(); ++i)
    ASSERT_NEAR(values[i], wanted[i], 1e-13 * largest) << i;
}

TEST(EdgeSums, GiveWhatTheCellsGiveOneByOne) {
  for (const BoxOptions& options : kBoxes)
    for (const bool has_constraints : {false, true}) {
      const BoxMesh box = box_mesh(options);
      const TestSpace test(box.mesh);
      StokesProblem problem = test.problem();
      for (const CellId c : box.mesh.cells.ids())
        problem.viscosity[c] = box.mesh.region[c] == RegionId{1} ? 0.01 : 1.0;
      if (has_constraints) constrain(problem);
      StokesJacobian by_edges(test.space), by_cells(test.space);
      by_edges.assemble(problem);
      const StokesState state = state_at_rest(test.space);
      const Linearization newton{state, Linearization::Kind::newton};
      by_cells.assemble(problem, &newton);  // never by edges
      const linear::SaddleSystem system = by_edges.system(), wanted = by_cells.system();
      ASSERT_TRUE(system.lower_left.empty() && !wanted.lower_left.empty());
      expect_same(system.A.values, wanted.A.values);
      expect_same(system.B.values, wanted.B.values);
      expect_same(system.C.values, wanted.C.values);
      expect_same(system.pressure_mass, wanted.pressure_mass);
      ASSERT_EQ(system.laplacians.size(), wanted.laplacians.size());
      for (std::size_t k = 0; k < system.laplacians.size(); ++k)
        expect_same(system.laplacians[k].values, wanted.laplacians[k].values);
    }
}

TEST(LiquidFaces, EncloseEachLiquid) {
  for (const BoxOptions& options : kBoxes) {
    const BoxMesh box = box_mesh(options);
    const TestSpace test(box.mesh);
    const NodeTable& pressures = test.space.pressure.nodes;
    const std::vector<LiquidFace> faces = liquid_faces(pressures, node_graph(pressures, pressures));
    EXPECT_EQ(faces.size(), 12 * options.n * options.n + 2 * interface_faces(box.mesh).size());
    std::array<double, 2> volume = {0.0, 0.0}, enclosed = volume;
    for (const CellId c : box.mesh.cells.ids())
      volume[static_cast<std::size_t>(box.mesh.region[c].value)] += signed_volume(box.mesh, c);
    for (const auto& [c, corners] : faces) {
      const auto x = [&](std::size_t k) { return box.mesh.x[box.mesh.cells[c][corners[k]]]; };
      enclosed[static_cast<std::size_t>(box.mesh.region[c].value)] +=
          x(0).dot(x(1).cross(x(2))) / 6.0;
    }
    for (const std::size_t region : {0, 1})
      EXPECT_NEAR(enclosed[region], volume[region], 1e-13) << region;
  }
}

}  // namespace
}  // namespace meniscus::fem
