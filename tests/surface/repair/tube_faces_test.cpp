#include "meniscus/surface/repair/tube_faces.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace meniscus {
namespace {

/// Adds a circle of vertices around the z-axis moved to `center`, counter-clockwise from above.
std::vector<VertexId> add_circle(SurfaceMesh& mesh, int num, double radius, const Vec3& center) {
  std::vector<VertexId> curve;
  for (int i = 0; i < num; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / num;
    curve.push_back(mesh.x.add(center + radius * Vec3(std::cos(angle), std::sin(angle), 0.0)));
  }
  return curve;
}

/// Whether every edge between the curves lies in two faces and every edge of the curves in one.
bool is_tube(const SurfaceMesh& mesh, const std::vector<FaceVertices>& faces, std::size_t size_a) {
  std::map<std::pair<VertexId, VertexId>, int> count;
  for (const FaceVertices& f : faces)
    for (std::size_t k = 0; k < 3; ++k) ++count[std::minmax(f[k], f[(k + 1) % 3])];
  const auto is_first = [&](VertexId v) { return static_cast<std::size_t>(v.value) < size_a; };
  for (const auto& [edge, faces_at] : count)
    if (faces_at != (is_first(edge.first) == is_first(edge.second) ? 1 : 2)) return false;
  return faces.size() == static_cast<std::size_t>(mesh.num_vertices());
}

TEST(Zip, MakesATubeHoweverUnlikeTheCurvesAre) {
  // A curve that is far smaller than another and beside it has all its least lines to one place.
  for (const int num : {3, 4, 7, 40})
    for (const double radius : {0.01, 0.3, 1.0})
      for (const double aside : {0.0, 0.5, 3.0, 20.0}) {
        SurfaceMesh mesh;
        const auto a = add_circle(mesh, 30, 1.0, Vec3::Zero());
        auto b = add_circle(mesh, num, radius, Vec3(aside, 0.0, 0.5));
        std::ranges::reverse(b);  // the other disc is seen from its other side
        EXPECT_TRUE(is_tube(mesh, tube_faces(mesh, a, b), a.size()))
            << fmt::format("{} vertices, radius {}, aside {}", num, radius, aside);
      }
}

}  // namespace
}  // namespace meniscus
