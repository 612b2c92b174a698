#include "meniscus/report/surface_frames.hpp"

#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus::report {
namespace {

SurfaceFrame frame_of(SurfaceMesh mesh) {
  SurfaceFrame frame{.t = 0.0, .mesh = std::move(mesh), .drop = {}};
  frame.fields.push_back({"curvature", VertexField<double>(frame.mesh.num_vertices(), 2.0)});
  frame.drop = FaceField<int>(frame.mesh.num_faces(), 0);
  return frame;
}

TEST(SurfaceFrames, CoarseningKeepsShape) {
  const SurfaceFrame frame = frame_of(sphere(3000));
  const SurfaceFrame coarse = coarse_frame(frame, 1500);
  EXPECT_LT(coarse.mesh.num_faces(), 2000);
  EXPECT_GT(coarse.mesh.num_faces(), 700);
  EXPECT_NEAR(enclosed_volume(coarse.mesh), enclosed_volume(frame.mesh), 0.05 * 4.19);
  EXPECT_EQ(coarse.fields[0].values.size(), coarse.mesh.num_vertices());
  EXPECT_EQ(coarse.drop.size(), coarse.mesh.num_faces());
  EXPECT_NEAR(coarse.fields[0].values[VertexId{0}], 2.0, 1e-12);
  EXPECT_EQ(coarse_frame(frame, 6000).mesh, frame.mesh);
}

TEST(SurfaceFrames, ChoosesFramesSpreadInTime) {
  std::vector<io::PvdEntry> frames;
  for (int i = 0; i <= 100; ++i) frames.push_back({0.1 * i, std::to_string(i)});
  const auto chosen = evenly_spaced_frames(frames, 6);
  ASSERT_EQ(chosen.size(), 6U);
  EXPECT_EQ(chosen[0].file, "0");
  EXPECT_EQ(chosen[1].file, "20");
  EXPECT_EQ(chosen[5].file, "100");
  EXPECT_EQ(evenly_spaced_frames(std::span(frames).first(3), 6).size(), 3U);
  EXPECT_EQ(evenly_spaced_frames(std::span(frames).first(1), 6).size(), 1U);
  EXPECT_TRUE(evenly_spaced_frames({}, 6).empty());
  // Frames crowd where an event is: none is left out where all may be shown.
  const std::vector<io::PvdEntry> crowded = {{0.0, "0"}, {1.0, "1"}, {1.001, "2"}, {9.0, "3"}};
  EXPECT_EQ(evenly_spaced_frames(crowded, 4).size(), 4U);
  const auto three = evenly_spaced_frames(crowded, 3);
  ASSERT_EQ(three.size(), 3U);
  EXPECT_EQ(three[0].file + three[2].file, "03");
  const double times[] = {4.96, 0.0, 5.04, 99.0};
  EXPECT_EQ(nearest_frames(frames, times).size(), 3U);
}

}  // namespace
}  // namespace meniscus::report
