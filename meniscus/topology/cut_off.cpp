#include "meniscus/topology/cut_off.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Geometry>

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

enum class Mark : char { unseen, seen, beyond };

/// The plane of a section, seen from one of its sides.
struct Ground {
  Vec3 origin, up;
  [[nodiscard]] double height(const Vec3& x) const { return up.dot(x - origin); }
};

/// A section crosses two edges of the face `crossed`. Whether the third edge, which `beside`
/// shares, lies above the plane: higher than the vertex opposite it.
bool is_joined_above(const SurfaceMesh& mesh, const Ground& ground, FaceId crossed, FaceId beside) {
  double shared = 0.0, third = 0.0;
  for (const VertexId v : mesh.faces[crossed]) {
    const bool is_shared = std::ranges::find(mesh.faces[beside], v) != mesh.faces[beside].end();
    (is_shared ? shared : third) += ground.height(mesh.x[v]);
  }
  return 0.5 * shared > third;
}

double cone(const Vec3& apex, const Vec3& a, const Vec3& b, const Vec3& c) {
  return (a - apex).dot((b - apex).cross(c - apex)) / 6.0;
}

double cone(const SurfaceMesh& mesh, const Vec3& apex, FaceId f) {
  const FaceVertices& v = mesh.faces[f];
  return cone(apex, mesh.x[v[0]], mesh.x[v[1]], mesh.x[v[2]]);
}

/// The volume of the cone from the origin to what lies above the plane of the k-th face that a
/// section crosses. It is of the corner that the crossing cuts off, or the face without it.
double cone_above(const SurfaceMesh& mesh, const Ground& ground, const Section& section,
                  std::size_t k) {
  const FaceVertices& v = mesh.faces[section.faces[k]];
  const Vec3 &p = section.points[k], &q = section.points[(k + 1) % section.points.size()];
  std::array<bool, 3> is_above{};
  for (std::size_t i = 0; i < 3; ++i) is_above[i] = ground.height(mesh.x[v[i]]) >= 0.0;
  const auto num_above = std::ranges::count(is_above, true);
  if (num_above == 0) return 0.0;
  const double whole = cone(mesh, ground.origin, section.faces[k]);
  if (num_above == 3) return whole;
  const auto lone =
      static_cast<std::size_t>(std::ranges::find(is_above, num_above == 1) - is_above.begin());
  // The crossing goes from p to q or from q to p, seen from the corner: that with the face's sign.
  const double corner = std::copysign(cone(ground.origin, mesh.x[v[lone]], p, q), whole);
  return num_above == 1 ? corner : whole - corner;
}

}  // namespace

CutOff cut_off(const SurfaceMesh& mesh, const FaceNeighbours& neighbours, const Section& section,
               double side) {
  MENISCUS_ASSERT(side == 1.0 || side == -1.0, "side = {}", side);
  MENISCUS_ASSERT(section.points.size() == section.faces.size(), "{} {}", section.points.size(),
                  section.faces.size());
  const Ground ground{section.center, side * section.axis};
  CutOff result;
  FaceField<Mark> marks(mesh.num_faces(), Mark::unseen);
  for (const FaceId f : section.faces) marks[f] = Mark::seen;
  std::vector<FaceId> part;
  for (std::size_t k = 0; k < section.faces.size(); ++k) {
    const FaceId f = section.faces[k];
    result.volume += cone_above(mesh, ground, section, k);
    for (const VertexId v : mesh.faces[f])
      result.reach = std::max(result.reach, ground.height(mesh.x[v]));
    for (const FaceId g : neighbours[f]) {
      if (marks[g] != Mark::unseen) continue;
      const bool is_above = is_joined_above(mesh, ground, f, g);
      marks[g] = is_above ? Mark::seen : Mark::beyond;
      if (is_above) part.push_back(g);
    }
  }
  for (std::size_t k = 0; k < part.size(); ++k) {
    MENISCUS_ASSERT(marks[part[k]] == Mark::seen, "face {}", part[k].value);
    result.volume += cone(mesh, ground.origin, part[k]);
    for (const VertexId v : mesh.faces[part[k]])
      result.reach = std::max(result.reach, std::abs(ground.height(mesh.x[v])));
    for (const FaceId g : neighbours[part[k]]) {
      if (marks[g] == Mark::beyond)
        return {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
      if (marks[g] == Mark::unseen) part.push_back(g);
      marks[g] = Mark::seen;
    }
  }
  result.volume = std::abs(result.volume);
  return result;
}

}  // namespace meniscus
