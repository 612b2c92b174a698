#include "meniscus/report/interface_picture.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/report/interface_section.hpp"
#include "meniscus/report/svg_plot.hpp"
#include "tests/report/xml_check.hpp"

namespace meniscus::report {
namespace {

SurfaceFrame frame_of(SurfaceMesh mesh, double kappa = 2.0) {
  SurfaceFrame frame{.t = 0.0, .mesh = std::move(mesh), .curvature = {}, .drop = {}};
  frame.curvature = VertexField<double>(frame.mesh.num_vertices(), kappa);
  frame.drop = FaceField<int>(frame.mesh.num_faces(), 0);
  return frame;
}

test::Xml drawn(const SurfaceFrame& frame, const View& view) {
  const ValueRange range = curvature_range(std::span(&frame, 1));
  return test::parse_xml(inline_svg(draw_surface(frame, view, range), view.width, view.height, ""));
}

TEST(InterfacePicture, ViewIsOrthonormalAndHoldsEveryFrame) {
  const SurfaceFrame frames[] = {frame_of(sphere(100)),
                                 frame_of(stretched_sphere(100, Vec3(3, 0.5, 0.6), Vec3(9, 9, 9)))};
  const View view = common_view(frames, 320.0);
  Mat3 axes;
  axes << view.right, view.up, view.toward;
  EXPECT_LT((axes.transpose() * axes - Mat3::Identity()).norm(), 1e-14);
  EXPECT_NEAR(axes.determinant(), 1.0, 1e-14);
  EXPECT_EQ(view.width, 320.0);
  for (const SurfaceFrame& frame : frames) {
    for (const auto& [name, value] : drawn(frame, view).attributes) {
      double x = 0, y = 0;
      if (name != "d" || std::sscanf(value.c_str(), "M%lf %lf", &x, &y) != 2) continue;
      EXPECT_GE(x, 0.0);
      EXPECT_LE(x, 3200.0);  // tenths of a px
      EXPECT_GE(y, 0.0);
      EXPECT_LE(y, 10.0 * view.height);
    }
  }
}

/// The visible half of a sphere has half of its faces, and they cover the disc π r².
TEST(InterfacePicture, SphereIsADisc) {
  const SurfaceFrame frame = frame_of(sphere(600));
  const View view = common_view(std::span(&frame, 1), 320.0);
  double area = 0.0;
  int num_faces = 0;
  for (const auto& [name, value] : drawn(frame, view).attributes) {
    double x = 0, y = 0, a = 0, b = 0, c = 0, d = 0;
    if (std::sscanf(value.c_str(), "M%lf %lfl%lf %lf %lf %lfz", &x, &y, &a, &b, &c, &d) != 6)
      continue;
    area += 0.5 * std::abs(a * d - b * c) * 0.01;
    ++num_faces;
  }
  EXPECT_NEAR(num_faces, frame.mesh.num_faces() / 2, 0.05 * frame.mesh.num_faces());
  const double disc = std::numbers::pi * view.scale * view.scale;
  EXPECT_NEAR(area, disc, 0.02 * disc);  // chords of edges of 0.14 R0 lose h²/4 or so
}

TEST(InterfacePicture, NearFacesAreDrawnLast) {
  SurfaceFrame frame = frame_of(sphere(60));
  const SurfaceMesh far_one = sphere(60, 1.0, Vec3(0, 0, -5));
  for (const FaceVertices& f : far_one.faces) {
    frame.mesh.faces.add(
        {VertexId{f[0].value + 60}, VertexId{f[1].value + 60}, VertexId{f[2].value + 60}});
    frame.drop.add(1);
  }
  for (const Vec3& x : far_one.x) {
    frame.mesh.x.add(x);
    frame.curvature.add(9.0);
  }
  const View view = common_view(std::span(&frame, 1), 320.0);
  const std::string svg = draw_surface(frame, view, {0.0, 9.0});
  const std::size_t last = svg.rfind("<path"), first = svg.find("<path");
  // κ = 9 is yellow (no blue), κ = 2 is blue: compare the last two hex digits of the fill.
  const auto blue = [&](std::size_t at) {
    return std::stoi(svg.substr(svg.find('#', at) + 5, 2), nullptr, 16);
  };
  const auto red = [&](std::size_t at) {
    return std::stoi(svg.substr(svg.find('#', at) + 1, 2), nullptr, 16);
  };
  EXPECT_GT(red(first), blue(first));
  EXPECT_GT(blue(last), red(last));
}

TEST(InterfacePicture, DrawsFramesWithoutCurvature) {
  SurfaceFrame frame = frame_of(sphere(40));
  frame.curvature = {};
  EXPECT_FALSE(have_curvature(std::span(&frame, 1)));
  const View view = common_view(std::span(&frame, 1), 100.0);
  EXPECT_EQ(drawn(frame, view).fault, "");
  const std::string key = draw_key(view, curvature_range(std::span(&frame, 1)), false);
  EXPECT_EQ(key.find("Curvature"), std::string::npos);
}

TEST(InterfacePicture, CoarseningKeepsShape) {
  const SurfaceFrame frame = frame_of(sphere(3000));
  const SurfaceFrame coarse = coarse_frame(frame, 1500);
  EXPECT_LT(coarse.mesh.num_faces(), 2000);
  EXPECT_GT(coarse.mesh.num_faces(), 700);
  EXPECT_NEAR(enclosed_volume(coarse.mesh), enclosed_volume(frame.mesh), 0.05 * 4.19);
  EXPECT_EQ(coarse.curvature.size(), coarse.mesh.num_vertices());
  EXPECT_EQ(coarse.drop.size(), coarse.mesh.num_faces());
  EXPECT_NEAR(coarse.curvature[VertexId{0}], 2.0, 1e-12);
  EXPECT_EQ(coarse_frame(frame, 6000).mesh, frame.mesh);
}

TEST(InterfaceSection, OfAnEllipsoidIsAnEllipse) {
  const Vec3 axes(2.0, 0.7, 0.5), center(1.0, -1.0, 4.0);
  const SurfaceFrame frame = frame_of(stretched_sphere(2000, axes, center));
  for (const int normal : {2, 1}) {
    const Curve curve = section_through_centroids(frame, normal);
    int num_points = 0, num_gaps = 0;
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      if (std::isnan(curve.x[i])) {
        ++num_gaps;
        continue;
      }
      const int other = 3 - normal;
      const double r = std::hypot((curve.x[i] - center[0]) / axes[0],
                                  (curve.y[i] - center[other]) / axes[other]);
      EXPECT_NEAR(r, 1.0, 5e-3);  // chords of edges h = 0.08 lie up to h²/8 within
      ++num_points;
    }
    EXPECT_EQ(num_gaps, 1);
    EXPECT_GT(num_points, 50);
    EXPECT_EQ(curve.x.front(), curve.x[curve.x.size() - 2]);  // closed
  }
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
  const double times[] = {4.96, 0.0, 5.04, 99.0};
  EXPECT_EQ(nearest_frames(frames, times).size(), 3U);
}

}  // namespace
}  // namespace meniscus::report
