#include "meniscus/surface/repair/smooth_fill.hpp"

#include <set>
#include <vector>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/cgal_surface.hpp"

// CGAL's fairing solves its linear system with Eigen.
#ifndef CGAL_EIGEN3_ENABLED
#define CGAL_EIGEN3_ENABLED 1
#endif
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/fair.h>
#include <CGAL/Polygon_mesh_processing/refine.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/assertions_behaviour.h>

namespace meniscus {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

/// The vertices of faces, and those up to `rings` edges away from them.
std::vector<CgalMesh::Vertex_index> vertices_within(const CgalMesh& mesh,
                                                    const std::vector<CgalMesh::Face_index>& faces,
                                                    int rings) {
  std::set<CgalMesh::Vertex_index> found;
  for (const auto f : faces)
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) found.insert(v);
  for (int ring = 0; ring < rings; ++ring) {
    std::set<CgalMesh::Vertex_index> wider = found;
    for (const auto v : found)
      for (const auto w : CGAL::vertices_around_target(mesh.halfedge(v), mesh)) wider.insert(w);
    found = std::move(wider);
  }
  return {found.begin(), found.end()};
}

/// CGAL does not take in a face that has an edge for the third time, or that makes two sheets meet
/// at a vertex.
bool has_all_faces(const CgalMesh& cgal, const SurfaceMesh& mesh) {
  return static_cast<std::int32_t>(cgal.number_of_faces()) == mesh.num_faces();
}

/// Keeps CGAL's warnings from standard error while it lives: fairing warns of a system that it
/// could not factorise, and returns false as well.
class QuietWarnings {
 public:
  QuietWarnings() : handler_(CGAL::set_warning_handler(&say_nothing)) {}
  ~QuietWarnings() { CGAL::set_warning_handler(handler_); }
  QuietWarnings(const QuietWarnings&) = delete;
  QuietWarnings& operator=(const QuietWarnings&) = delete;

 private:
  static void say_nothing(const char* /*kind*/, const char* /*condition*/, const char* /*file*/,
                          int /*line*/, const char* /*message*/) {}

  CGAL::Failure_function handler_;
};

}  // namespace

bool cap_holes(SurfaceMesh& mesh) {
  const QuietWarnings quiet;
  CgalMesh cgal = to_cgal(mesh);
  if (!has_all_faces(cgal, mesh)) return false;
  std::vector<CgalMesh::Halfedge_index> holes;
  pmp::extract_boundary_cycles(cgal, std::back_inserter(holes));
  for (const auto hole : holes) {
    std::vector<CgalMesh::Face_index> faces;
    std::vector<CgalMesh::Vertex_index> vertices;
    const bool is_smooth = std::get<0>(pmp::triangulate_refine_and_fair_hole(
        cgal, hole, std::back_inserter(faces), std::back_inserter(vertices)));
    if (faces.empty() || (!is_smooth && !vertices.empty())) return false;
  }
  mesh = from_cgal(cgal);
  return true;
}

bool smooth_part(SurfaceMesh& mesh, const FacePatch& part, int rings) {
  MENISCUS_ASSERT(part.size() == mesh.num_faces() && rings >= 0, "{} {} {}", part.size(),
                  mesh.num_faces(), rings);
  const QuietWarnings quiet;
  CgalMesh cgal = to_cgal(mesh);
  if (!has_all_faces(cgal, mesh)) return false;
  std::vector<CgalMesh::Face_index> faces;
  for (const FaceId f : part.ids())
    if (part[f]) faces.emplace_back(static_cast<std::uint32_t>(f.value));
  std::vector<CgalMesh::Face_index> new_faces;
  std::vector<CgalMesh::Vertex_index> new_vertices;
  pmp::refine(cgal, faces, std::back_inserter(new_faces), std::back_inserter(new_vertices));
  faces.insert(faces.end(), new_faces.begin(), new_faces.end());
  if (!pmp::fair(cgal, vertices_within(cgal, faces, rings))) return false;
  mesh = from_cgal(cgal);
  return true;
}

}  // namespace meniscus
