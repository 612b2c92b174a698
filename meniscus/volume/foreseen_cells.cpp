#include "meniscus/volume/foreseen_cells.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "meniscus/mesh/box_tree.hpp"

namespace meniscus {
namespace {

/// Edge of a box, in wanted edges, below which the size in it is taken as one.
constexpr double kBoxEdges = 4.0;
/// Wanted edge, over the size of the domain, that coordinates in double precision no longer hold.
constexpr double kFinest = 1e-13;
/// Cells at the surfaces for each of their vertices: two faces a vertex, a cell on each side.
constexpr double kCellsPerVertex = 4.0;

/// A vertex of a surface, and the shortest edge at it.
struct SizedPoint {
  Vec3 x;
  double edge = std::numeric_limits<double>::infinity();
};

void append_points(const SurfaceMesh& mesh, std::vector<SizedPoint>& points) {
  const std::size_t first = points.size();
  for (const Vec3& x : mesh.x) points.push_back({x});
  for (const FaceVertices& v : mesh.faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = v[k], b = v[(k + 1) % 3];
      double& edge = points[first + static_cast<std::size_t>(a.value)].edge;
      edge = std::min(edge, (mesh.x[b] - mesh.x[a]).norm());
    }
}

std::vector<SizedPoint> sized_points(const Scene& scene) {
  std::vector<SizedPoint> points;
  for (const Interface& interface : scene.interfaces) append_points(interface.mesh, points);
  append_points(scene.boundary.mesh, points);
  return points;
}

/// The smallest cube about the middle of a box that contains it.
Box cube_around(const Box& box) {
  const Vec3 half = Vec3::Constant(0.5 * box.sizes().maxCoeff());
  return {box.center() - half, box.center() + half};
}

/// A cube of the domain with the vertices of surfaces in it.
struct Cube {
  Box box;
  std::vector<SizedPoint> points;
};

/// The eight parts of a cube.
std::vector<Cube> octants(const Cube& cube) {
  const Vec3 middle = cube.box.center();
  std::vector<Cube> parts;
  parts.reserve(8);
  for (int i = 0; i < 8; ++i)
    parts.push_back({Box(middle).extend(cube.box.corner(static_cast<Box::CornerType>(i))), {}});
  for (const SizedPoint& p : cube.points) {
    const int corner = (p.x.x() > middle.x() ? 1 : 0) + (p.x.y() > middle.y() ? 2 : 0) +
                       (p.x.z() > middle.z() ? 4 : 0);
    parts[static_cast<std::size_t>(corner)].points.push_back(p);
  }
  return parts;
}

/// The least size in a box: the law's at its middle, or the shortest edge of a surface in the box.
/// A law may rise so steeply from a surface that the middle does not show the surface's edges.
SizedPoint least_size(const Box& part, const std::vector<SizedPoint>& points,
                      const std::function<double(const Vec3&)>& size) {
  SizedPoint least{part.center(), size(part.center())};
  for (const SizedPoint& p : points)
    if (!(p.edge >= least.edge)) least = p;
  return least;
}

}  // namespace

bool ForeseenCells::is_too_many() const { return !(number <= kMostCells); }

ForeseenCells foresee_cells(const Scene& scene, const std::function<double(const Vec3&)>& size,
                            double cell_volume) {
  const Box domain = bounding_box(scene.boundary.mesh);
  Cube whole{cube_around(domain), sized_points(scene)};
  ForeseenCells cells{.number = kCellsPerVertex * static_cast<double>(whole.points.size()),
                      .finest = domain.center(),
                      .least_size = std::numeric_limits<double>::infinity()};
  const double regular = cell_volume / (6.0 * std::sqrt(2.0));
  std::vector<Cube> due{std::move(whole)};
  while (!due.empty() && !cells.is_too_many()) {
    const Cube cube = std::move(due.back());
    due.pop_back();
    const Box part = cube.box.intersection(domain);
    if (part.isEmpty()) continue;
    const auto [x, h] = least_size(part, cube.points, size);
    if (!(h >= cells.least_size)) {
      cells.least_size = h;
      cells.finest = x;
    }
    if (!(h > kFinest * domain.sizes().maxCoeff()))
      cells.number = std::numeric_limits<double>::infinity();
    else if (cube.box.sizes().x() > kBoxEdges * h)
      std::ranges::move(octants(cube), std::back_inserter(due));
    else
      cells.number += part.volume() / (regular * h * h * h);
  }
  return cells;
}

std::string too_many(const ForeseenCells& cells) {
  return fmt::format(
      "the volume mesh would take more than {:.0e} tetrahedra, which is the most that is made: "
      "edges of {:.3g} are wanted near ({:.6g}, {:.6g}, {:.6g})",
      kMostCells, cells.least_size, cells.finest.x(), cells.finest.y(), cells.finest.z());
}

}  // namespace meniscus
