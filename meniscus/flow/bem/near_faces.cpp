#include "meniscus/flow/bem/near_faces.hpp"

#include <algorithm>

#include "meniscus/core/error.hpp"

namespace meniscus::bem {
namespace {

constexpr double kNear = 2.0;  // longest edges

/// Whether the centre of a face is nearer to x than `edges` of its longest one.
bool is_within(const Triangle& face, const Vec3& x, double edges) {
  const double longest =
      std::max({(face[1] - face[0]).squaredNorm(), (face[2] - face[1]).squaredNorm(),
                (face[0] - face[2]).squaredNorm()});
  return ((face[0] + face[1] + face[2]) / 3.0 - x).squaredNorm() < edges * edges * longest;
}

}  // namespace

void find_near_faces(const BoundaryGeometry& geometry, std::size_t m, std::int32_t i,
                     std::vector<FaceId>& faces) {
  const Vec3 x = geometry.nodes.point(i);
  faces.clear();
  // A face's centre lies in its box, whose diagonal is no shorter than the longest edge.
  geometry.surfaces[m].tree.visit_near(x, kNear, [&](FaceId f, const Triangle& face) {
    if (is_within(face, x, kNear)) faces.push_back(f);
    return true;
  });
  std::ranges::sort(faces);
}

std::size_t corner_at(const BoundaryGeometry& geometry, std::size_t m, FaceId f, std::int32_t i) {
  const FaceVertices& corners = geometry.surfaces[m].elements.corners[f];
  std::size_t corner = 3;
  for (std::size_t k = 0; k < 3; ++k)
    if (geometry.index(m, corners[k]) == i) corner = k;
  MENISCUS_ASSERT(corner == 3 || geometry.surface_of[static_cast<std::size_t>(i)] ==
                                     static_cast<std::int32_t>(m),
                  "point {} on surface {}", i, m);
  return corner;
}

}  // namespace meniscus::bem
