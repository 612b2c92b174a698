#include "meniscus/mesh/polygon_processing.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <set>
#include <utility>

#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/repair_self_intersections.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/cgal_surface.hpp"
#include "meniscus/mesh/surface_pieces.hpp"

namespace meniscus {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

using Point = CgalKernel::Point_3;
using Halfedge = CgalMesh::Halfedge_index;

/// Triangles for CGAL's functions on soups.
struct TriangleSoup {
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> triangles;
};

TriangleSoup to_soup(const SurfaceMesh& mesh) {
  TriangleSoup soup;
  for (const Vec3& x : mesh.x) soup.points.emplace_back(x.x(), x.y(), x.z());
  for (const FaceVertices& f : mesh.faces) {
    std::vector<std::size_t>& triangle = soup.triangles.emplace_back();
    for (const VertexId v : f) triangle.push_back(static_cast<std::size_t>(v.value));
  }
  return soup;
}

/// Whether two triangles of the same corners are turned differently.
bool is_turned(const std::vector<std::size_t>& a, const std::vector<std::size_t>& b) {
  return a[(static_cast<std::size_t>(std::ranges::find(a, b[0]) - a.begin()) + 1) % 3] != b[1];
}

double diagonal(const CGAL::Bbox_3& box) {
  return Vec3(box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin()).norm();
}

/// Merges points at one place, drops doubled triangles, turns the others so that neighbours agree,
/// and parts what is not manifold.
CgalMesh joined(const SurfaceMesh& mesh, RepairReport& report) {
  TriangleSoup soup = to_soup(mesh);
  report.merged_points +=
      static_cast<int>(pmp::merge_duplicate_points_in_polygon_soup(soup.points, soup.triangles));
  const std::size_t num_triangles = soup.triangles.size();
  pmp::repair_polygon_soup(soup.points, soup.triangles);
  report.removed_faces += static_cast<int>(num_triangles - soup.triangles.size());
  pmp::orient_polygon_soup(soup.points, soup.triangles);
  CgalMesh result;
  if (pmp::is_polygon_soup_a_polygon_mesh(soup.triangles))
    pmp::polygon_soup_to_polygon_mesh(soup.points, soup.triangles, result);
  return result;
}

struct Hole {
  Halfedge border;
  double size = 0.0;
  int num_edges = 0;
  Vec3 middle = Vec3::Zero();
};

std::vector<Hole> holes(CgalMesh& mesh) {
  std::vector<Halfedge> borders;
  pmp::extract_boundary_cycles(mesh, std::back_inserter(borders));
  std::vector<Hole> found;
  for (const Halfedge border : borders) {
    Hole hole{border};
    CGAL::Bbox_3 box;
    for (const Halfedge h : CGAL::halfedges_around_face(border, mesh)) {
      box += mesh.point(mesh.target(h)).bbox();
      ++hole.num_edges;
    }
    hole.size = diagonal(box);
    hole.middle =
        0.5 * Vec3(box.xmin() + box.xmax(), box.ymin() + box.ymax(), box.zmin() + box.zmax());
    found.push_back(hole);
  }
  return found;
}

/// Fills holes up to a size; notes the largest of the others.
void fill_holes(CgalMesh& mesh, RepairReport& report) {
  const double largest = kLargestHole * diagonal(pmp::bbox(mesh));
  double largest_left = 0.0;
  const auto leave = [&](const Hole& hole, const std::string& why) {
    if (hole.size <= largest_left) return;
    largest_left = hole.size;
    report.left = Fault{FaultKind::connectivity,
                        fmt::format("a hole of {} edges near {}, {:.3g} across, {}", hole.num_edges,
                                    text_of(hole.middle), hole.size, why),
                        hole.middle};
  };
  for (const Hole& hole : holes(mesh)) {
    if (hole.size > largest) {
      leave(hole, fmt::format("is not filled: it may be {:.3g} across", largest));
      continue;
    }
    std::vector<CgalMesh::Face_index> patch;
    pmp::triangulate_hole(mesh, hole.border, std::back_inserter(patch));
    if (patch.empty()) {
      leave(hole, "could not be filled");
      continue;
    }
    ++report.filled_holes;
    report.largest_hole = std::max(report.largest_hole, hole.size);
  }
}

/// Replaces faces that cross others, where that can be done.
void remove_crossings(CgalMesh& mesh, RepairReport& report) {
  std::vector<std::pair<CgalMesh::Face_index, CgalMesh::Face_index>> pairs;
  pmp::self_intersections(mesh, std::back_inserter(pairs));
  if (pairs.empty()) return;
  std::set<CgalMesh::Face_index> crossing;
  for (const auto& [f, g] : pairs) crossing.insert({f, g});
  pmp::experimental::remove_self_intersections(mesh);
  report.crossing_faces += static_cast<int>(crossing.size());
}

}  // namespace

std::vector<std::array<std::size_t, 3>> cut_polygon(std::span<const Vec3> corners) {
  CgalMesh mesh;
  std::vector<CgalMesh::Vertex_index> vertices;
  for (const Vec3& x : corners) vertices.push_back(mesh.add_vertex({x.x(), x.y(), x.z()}));
  const CgalMesh::Face_index polygon = mesh.add_face(vertices);
  std::vector<std::array<std::size_t, 3>> triangles;
  if (pmp::triangulate_face(polygon, mesh))
    for (const CgalMesh::Face_index f : mesh.faces()) {
      std::array<std::size_t, 3>& triangle = triangles.emplace_back();
      std::size_t k = 0;
      for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh))
        triangle[k++] = v.idx();
    }
  if (triangles.size() != corners.size() - 2) {
    triangles.clear();
    for (std::size_t k = 2; k < corners.size(); ++k) triangles.push_back({0, k - 1, k});
  }
  return triangles;
}

bool make_consistent(SurfaceMesh& mesh) {
  // CGAL never comes to an end on a face that has a corner twice.
  const auto has_corner_twice = [](const FaceVertices& f) {
    return f[0] == f[1] || f[1] == f[2] || f[2] == f[0];
  };
  if (std::ranges::any_of(mesh.faces, has_corner_twice)) return false;
  TriangleSoup soup = to_soup(mesh);
  if (!pmp::orient_polygon_soup(soup.points, soup.triangles)) return false;
  const TriangleSoup given = to_soup(mesh);
  const FaceField<std::int32_t> piece = face_pieces(mesh);
  // CGAL turns to the first face of each piece.
  std::vector<int> balance;
  FaceField<char> turns;
  for (const FaceId f : mesh.faces.ids()) {
    const auto i = static_cast<std::size_t>(f.value), p = static_cast<std::size_t>(piece[f]);
    turns.add(is_turned(given.triangles[i], soup.triangles[i]));
    balance.resize(std::max(balance.size(), p + 1), 0);
    balance[p] += turns[f] ? 1 : -1;
  }
  for (const FaceId f : mesh.faces.ids())
    if (static_cast<bool>(turns[f]) != (balance[static_cast<std::size_t>(piece[f])] > 0))
      std::swap(mesh.faces[f][1], mesh.faces[f][2]);
  return true;
}

SurfaceMesh mended(const SurfaceMesh& mesh, RepairReport& report) {
  CgalMesh cgal = joined(mesh, report);
  report.stitched_edges += static_cast<int>(pmp::stitch_borders(cgal));
  const auto num_faces = static_cast<int>(cgal.number_of_faces());
  pmp::remove_degenerate_faces(cgal);
  report.removed_faces += num_faces - static_cast<int>(cgal.number_of_faces());
  fill_holes(cgal, report);
  remove_crossings(cgal, report);
  return from_cgal(cgal);
}

}  // namespace meniscus
