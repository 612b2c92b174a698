#include "meniscus/app/frames.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "meniscus/case/case.hpp"
#include "meniscus/io/vtk_file.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "tests/io/temporary_folder.hpp"

namespace meniscus {
namespace {

/// The arrays of the first frame of a drop at rest; Ca is 1 where nothing flows.
io::SurfaceFrame resting_drop(const std::string& more) {
  const Case c = parse_case(
      "[flow]\nkind = \"quiescent\"\n[[drop]]\nradius = 1.0\nnodes = 110\n" + more, "case.toml");
  Evolution evolution(build_scene(c), c.evolution, make_flow_solver(c), make_moving_mesh(c));
  EXPECT_TRUE(evolution.prepare().ok());
  EXPECT_TRUE(evolution.solve().ok());
  const test::TemporaryFolder folder;
  write_surface_frame(folder / "frame.vtp", evolution);
  return io::read_vtp(folder / "frame.vtp");
}

const io::NamedArray* find(const io::SurfaceFrame& frame, const std::string& name) {
  const auto found = std::ranges::find(frame.data.on_vertices, name, &io::NamedArray::name);
  return found == frame.data.on_vertices.end() ? nullptr : &*found;
}

/// Outer minus inner: −2/Ca for a sphere of radius 1 at rest. The balance of virtual work for a
/// uniform growth, Δp dV = σ dS, holds for the polyhedron as well: Δp = 2 S/(3 V), its own S and V.
TEST(SurfaceFrame, PressureJumpOfARestingDrop) {
  const io::SurfaceFrame frame = resting_drop("[domain]\nshape = \"sphere\"\nradius = 4.0\n");
  const io::NamedArray* jump = find(frame, "pressure_jump");
  ASSERT_NE(jump, nullptr);
  ASSERT_EQ(jump->values.size(), static_cast<std::size_t>(frame.mesh.num_vertices()));
  double mean = 0.0;
  for (const double value : jump->values) mean += value / static_cast<double>(jump->values.size());
  const double expected = -2.0 * surface_area(frame.mesh) / (3.0 * enclosed_volume(frame.mesh));
  EXPECT_NEAR(expected, -2.0, 0.04 * 2.0);  // chords of edges of 0.36 R0: S by h²/6 or so
  // The mesh is not quite even, so its curvatures scatter by some per cent: h² = 0.13 bounds that.
  EXPECT_NEAR(mean, expected, 0.03 * 2.0);
  for (const double value : jump->values) EXPECT_NEAR(value, expected, 0.13 * 2.0);
}

TEST(SurfaceFrame, BoundaryIntegralsHaveNoPressure) {
  const io::SurfaceFrame frame =
      resting_drop("[domain]\nshape = \"unbounded\"\n[solver]\nmethod = \"boundary-integral\"\n");
  EXPECT_EQ(find(frame, "pressure_jump"), nullptr);
  EXPECT_NE(find(frame, "curvature"), nullptr);
  EXPECT_NE(find(frame, "normal_velocity"), nullptr);
}

}  // namespace
}  // namespace meniscus
