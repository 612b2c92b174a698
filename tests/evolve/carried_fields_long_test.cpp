// Fields carried through a flow that is solved.
#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

#include "meniscus/case/case.hpp"
#include "tests/evolve/cosine_fields.hpp"

namespace meniscus {
namespace {

using test::Amounts, test::amounts, test::expect_kept, test::put_cosines, test::step;

Evolution sheared_drop() {
  const Case c = parse_case(
      "[flow]\nkind = \"simple-shear\"\ncapillary-number = 0.3\n"
      "[[drop]]\nradius = 1.0\nviscosity-ratio = 1.0\nnodes = 60\n"
      "[domain]\nshape = \"box\"\nhalf-width = 4.0\nnodes = 200\n"
      "[time]\nend = 100.0\ncontrol = \"paper\"\n[solver]\nelements = \"P1-P1\"\n",
      "case.toml");
  return {build_scene(c), c.evolution, make_flow_solver(c), make_moving_mesh(c)};
}

template <class Values>
void print_range(const char* name, const Values& values) {
  const auto [low, high] = std::ranges::minmax(values);
  std::printf("%s from %.6f to %.6f\n", name, low, high);
}

// λ = 1, P1. The drop comes to its steady shape and its interface goes round it.
TEST(CarriedFields, KeepTheirAmountsThroughTwoHundredStepsOfShear) {
  Evolution evolution = sheared_drop();
  ASSERT_TRUE(evolution.prepare().ok());
  put_cosines(evolution);
  const Amounts before = amounts(evolution.state());
  for (int i = 0; i < 200; ++i) step(evolution);
  const Amounts now = amounts(evolution.state());
  expect_kept(now, before, 1e-12);
  const SurfaceFields& on_interface = evolution.scene().interfaces[0].fields;
  const VolumeFields& in_bulk = evolution.state().mesh->fields();
  const FieldExcess& excess = evolution.state().field_excess;
  std::printf("t = %.4f; excess in one step %.3e above, %.3e below\n", evolution.t(), excess.above,
              excess.below);
  std::printf("kept to %.1e on vertices, %.1e on faces, %.1e in the drop, %.1e around it\n",
              now.on_vertices / before.on_vertices - 1.0, now.on_faces / before.on_faces - 1.0,
              now.in_cells[1] / before.in_cells[1] - 1.0,
              now.in_cells[0] / before.in_cells[0] - 1.0);
  print_range("gamma", on_interface.on_vertices[0].values);
  print_range("label", on_interface.on_vertices[1].values);
  print_range("load", on_interface.on_faces[0].values);
  print_range("temperature", in_bulk.on_vertices[0].values);
  print_range("species", in_bulk.on_cells[0].values);
  // Interpolated ones never leave their old range, from 1 to 3.
  EXPECT_GE(std::ranges::min(on_interface.on_vertices[1].values), 1.0);
  EXPECT_LE(std::ranges::max(on_interface.on_vertices[1].values), 3.0);
  EXPECT_GE(std::ranges::min(in_bulk.on_vertices[0].values), 1.0);
  EXPECT_LE(std::ranges::max(in_bulk.on_vertices[0].values), 3.0);
}

}  // namespace
}  // namespace meniscus
