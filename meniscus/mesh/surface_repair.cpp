#include "meniscus/mesh/surface_repair.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/polygon_processing.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/surface_pieces.hpp"
#include "meniscus/mesh/surface_tree.hpp"

namespace meniscus {
namespace {

/// The points of a soup that its faces use, as vertices.
class UsedPoints {
 public:
  UsedPoints(const PolygonSoup& soup, SurfaceMesh& mesh) : vertex_(soup.points.size()) {
    std::vector<bool> is_used(soup.points.size(), false);
    for (const std::int64_t corner : soup.corners) is_used[static_cast<std::size_t>(corner)] = true;
    for (std::size_t i = 0; i < soup.points.size(); ++i)
      if (is_used[i]) vertex_[i] = mesh.x.add(soup.points[i]);
  }
  [[nodiscard]] VertexId operator[](std::int64_t point) const {
    return vertex_[static_cast<std::size_t>(point)];
  }

 private:
  std::vector<VertexId> vertex_;
};

TaggedSurface triangulated(const PolygonSoup& soup, RepairReport& report) {
  TaggedSurface surface;
  const UsedPoints vertex(soup, surface.mesh);
  std::vector<Vec3> places;
  for (std::size_t f = 0; f < soup.num_faces(); ++f) {
    const std::span<const std::int64_t> face = soup.face(f);
    MENISCUS_ASSERT(face.size() >= 3, "a face of {} corners", face.size());
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      surface.mesh.faces.add({vertex[face[a]], vertex[face[b]], vertex[face[c]]});
      surface.tag.add(soup.tags.empty() ? 0 : soup.tags[f]);
    };
    if (face.size() == 3) {
      add(0, 1, 2);
      continue;
    }
    ++report.polygons;
    places.clear();
    for (const std::int64_t point : face)
      places.push_back(soup.points[static_cast<std::size_t>(point)]);
    for (const auto& [a, b, c] : cut_polygon(places)) add(a, b, c);
  }
  return surface;
}

/// For each of closed pieces, the largest of itself and those around it: what it lies in, and what
/// lies in no other.
std::vector<std::size_t> outermost(const std::vector<SurfaceMesh>& pieces,
                                   const std::vector<double>& volumes) {
  std::vector<SurfaceTree> trees(pieces.begin(), pieces.end());
  std::vector<std::size_t> outer(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    outer[i] = i;
    for (std::size_t j = 0; j < pieces.size(); ++j)
      if (std::abs(volumes[j]) > std::abs(volumes[outer[i]]) &&
          encloses(trees[j], pieces[i].x[VertexId{0}]))
        outer[i] = j;
  }
  return outer;
}

/// Turns over the closed pieces that are inside out and lie in no other, with all that lies in
/// them.
void turn_outward(SurfaceMesh& mesh) {
  const std::vector<SurfaceMesh> pieces = connected_pieces(mesh);
  std::vector<double> volumes;
  for (const SurfaceMesh& piece : pieces) volumes.push_back(enclosed_volume(piece));
  if (std::ranges::none_of(volumes, [](double volume) { return volume < 0.0; })) return;
  const std::vector<std::size_t> outer = outermost(pieces, volumes);
  const FaceField<std::int32_t> piece = face_pieces(mesh);
  for (const FaceId f : mesh.faces.ids())
    if (volumes[outer[static_cast<std::size_t>(piece[f])]] < 0.0)
      std::swap(mesh.faces[f][1], mesh.faces[f][2]);
}

/// Turns faces so that neighbours agree and pieces are not inside out. What is no closed manifold
/// stays as it is.
void orient(SurfaceMesh& mesh, RepairReport& report) {
  SurfaceMesh oriented = mesh;
  if (find_broken_connectivity(oriented) && !make_consistent(oriented)) return;
  if (find_broken_connectivity(oriented)) return;
  turn_outward(oriented);
  for (const FaceId f : mesh.faces.ids()) report.turned += oriented.faces[f] != mesh.faces[f];
  mesh = std::move(oriented);
}

bool is_sound(const SurfaceMesh& mesh) {
  return !find_degenerate_face(mesh) && !find_broken_connectivity(mesh) &&
         !find_self_intersection(mesh);
}

/// Tags of a mended surface: for each face that of the given face nearest to its middle.
FaceField<int> nearest_tags(const SurfaceMesh& mesh, const TaggedSurface& given) {
  if (std::set(given.tag.begin(), given.tag.end()).size() == 1)
    return FaceField<int>(mesh.num_faces(), given.tag[FaceId{0}]);
  const SurfaceTree tree(given.mesh);
  FaceField<int> tags;
  for (const FaceVertices& f : mesh.faces)
    tags.add(given.tag[tree.closest((mesh.x[f[0]] + mesh.x[f[1]] + mesh.x[f[2]]) / 3.0).face]);
  return tags;
}

}  // namespace

bool RepairReport::is_changed() const {
  return polygons + turned + merged_points + removed_faces + stitched_edges + filled_holes +
             crossing_faces >
         0;
}

std::string text_of(const RepairReport& report) {
  std::vector<std::string> parts;
  const auto add = [&](int count, const std::string& text) {
    if (count > 0) parts.push_back(fmt::format("{} {}", count, text));
  };
  add(report.polygons, "faces of more than three corners cut into triangles");
  add(report.turned, "faces turned over");
  add(report.merged_points, "points merged with others at their place");
  add(report.removed_faces, "faces removed that were doubled or without area");
  add(report.stitched_edges, "edges stitched");
  add(report.filled_holes,
      fmt::format("holes filled, the largest {:.3g} across", report.largest_hole));
  add(report.crossing_faces, "crossing faces replaced");
  return fmt::format("{}", fmt::join(parts, "; "));
}

std::string text_of(const Fault& fault, const RepairReport& report) {
  return report.left ? fmt::format("{}: {}", fault.text, report.left->text) : fault.text;
}

RepairedSurface surface_of(const PolygonSoup& soup, bool mends) {
  RepairReport report;
  TaggedSurface surface = triangulated(soup, report);
  orient(surface.mesh, report);
  if (mends && !is_sound(surface.mesh)) {
    SurfaceMesh closed = mended(surface.mesh, report);
    surface = {closed, nearest_tags(closed, surface)};
    orient(surface.mesh, report);
  }
  return {std::move(surface), std::move(report)};
}

}  // namespace meniscus
