#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/volume/facets.hpp"
#include "meniscus/volume/tetrahedralize.hpp"

namespace meniscus {
namespace {

Vec3 middle(const TetMesh& mesh, CellId c) {
  const CellVertices& v = mesh.cells[c];
  return 0.25 * (mesh.x[v[0]] + mesh.x[v[1]] + mesh.x[v[2]] + mesh.x[v[3]]);
}

/// The surfaces of a scene beside their images in a mesh, the outer boundary last.
struct SurfacePair {
  std::string name;
  const SurfaceMesh& surface;
  const EmbeddedSurface& embedded;
  RegionId inside, outside;  // outside is invalid for the outer boundary
};

std::vector<SurfacePair> surface_pairs(const TetMesh& mesh, const Scene& scene) {
  std::vector<SurfacePair> pairs;
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
    const Interface& interface = scene.interfaces[i];
    pairs.push_back({fmt::format("interface {}", i), interface.mesh, mesh.interfaces[i],
                     interface.inside, interface.outside});
  }
  pairs.push_back({"outer boundary", scene.boundary.mesh, mesh.boundary, RegionId{0}, RegionId{}});
  return pairs;
}

std::optional<Fault> find_wrong_size(const TetMesh& mesh, const Scene& scene) {
  if (mesh.interfaces.size() != scene.interfaces.size())
    return Fault{FaultKind::nonconforming,
                 fmt::format("mesh has {} interfaces, the scene {}", mesh.interfaces.size(),
                             scene.interfaces.size())};
  const auto is_region = [&](RegionId region) {
    return region.is_valid() && region.value <= static_cast<int>(scene.interfaces.size());
  };
  for (const Interface& interface : scene.interfaces)
    if (!is_region(interface.inside) || !is_region(interface.outside))
      return Fault{
          FaultKind::regions,
          fmt::format("drop {} lies between regions that the scene does not have", interface.drop)};
  if (mesh.region.size() != mesh.num_cells())
    return Fault{FaultKind::regions, "mesh has cells without a region"};
  for (const CellId c : mesh.cells.ids())
    for (const TetVertexId v : mesh.cells[c])
      if (v.value < 0 || v.value >= mesh.num_vertices())
        return Fault{FaultKind::nonconforming,
                     fmt::format("cell {} names a missing vertex", c.value)};
  return {};
}

/// Surface vertices come first, in order, exactly at the scene's coordinates.
std::optional<Fault> find_moved_vertex(const TetMesh& mesh, const std::vector<SurfacePair>& pairs) {
  std::int32_t first = 0;
  for (const SurfacePair& pair : pairs) {
    const SurfaceMesh& surface = pair.surface;
    if (pair.embedded.first_vertex.value != first ||
        pair.embedded.num_vertices != surface.num_vertices() ||
        pair.embedded.sides.size() != surface.num_faces() ||
        first + surface.num_vertices() > mesh.num_vertices())
      return Fault{FaultKind::nonconforming,
                   fmt::format("{}: the mesh numbers its vertices or faces otherwise", pair.name)};
    for (const VertexId v : surface.x.ids())
      if (mesh.x[pair.embedded.vertex(v)] != surface.x[v])
        return Fault{
            FaultKind::nonconforming,
            fmt::format("{}: vertex {} at {} is elsewhere in the mesh, at {}", pair.name, v.value,
                        text_of(surface.x[v]), text_of(mesh.x[pair.embedded.vertex(v)])),
            surface.x[v]};
    first += surface.num_vertices();
  }
  return {};
}

/// Every cell has positive volume; a bound of roundoff of its determinant separates positive from
/// flat.
std::optional<Fault> find_inverted_cell(const TetMesh& mesh) {
  for (const CellId c : mesh.cells.ids()) {
    const double volume = signed_volume(mesh, c);
    const CellVertices& v = mesh.cells[c];
    double longest = 0.0;
    for (std::size_t k = 1; k < 4; ++k)
      longest = std::max(longest, (mesh.x[v[k]] - mesh.x[v[0]]).norm());
    // Differences are exact to 1e-16 of the coordinates; 1e-14 leaves a factor of safety.
    if (!(volume > 1e-14 * longest * longest * longest))
      return Fault{FaultKind::inverted_cell,
                   fmt::format("cell {} near {} has volume {:.3g}", c.value,
                               text_of(middle(mesh, c)), volume),
                   middle(mesh, c)};
  }
  return {};
}

/// Each face of each surface is a facet of the two cells named as its sides; one on the outer
/// boundary. These lie in the right regions.
std::optional<Fault> find_wrong_face(const TetMesh& mesh, const FacetTable& facets,
                                     const SurfacePair& pair) {
  for (const FaceId f : pair.surface.faces.ids()) {
    const FaceVertices& v = pair.surface.faces[f];
    const FacetVertices vertices{pair.embedded.vertex(v[0]), pair.embedded.vertex(v[1]),
                                 pair.embedded.vertex(v[2])};
    const auto fault = [&](const char* what) {
      const Vec3& x = pair.surface.x[v[0]];
      return Fault{FaultKind::nonconforming,
                   fmt::format("{}: face {} near {} {}", pair.name, f.value, text_of(x), what), x};
    };
    const CellId inside = facets.find(vertices), outside = facets.find_across(vertices);
    const EmbeddedSurface::Sides& sides = pair.embedded.sides[f];
    if (!inside.is_valid() || outside.is_valid() != pair.outside.is_valid())
      return fault("is not a facet of the mesh");
    if (inside != sides.inside || outside != sides.outside)
      return fault("has other cells at its sides than the mesh says");
    if (mesh.region[sides.inside] != pair.inside) return fault("has the wrong region inside");
    if (outside.is_valid() && mesh.region[sides.outside] != pair.outside)
      return fault("has the wrong region outside");
  }
  return {};
}

/// Every facet belongs to one cell on each side. Regions change, and the mesh ends, on faces of
/// surfaces only: as many facets do as there are faces.
std::optional<Fault> find_wrong_facet(const TetMesh& mesh, const FacetTable& facets,
                                      const Scene& scene) {
  const auto fault = [&](CellId c, const char* what) {
    const Vec3 x = middle(mesh, c);
    return Fault{FaultKind::nonconforming,
                 fmt::format("cell {} near {} {}", c.value, text_of(x), what), x};
  };
  if (facets.overlapping().is_valid()) return fault(facets.overlapping(), "overlaps another cell");
  std::int64_t open = scene.boundary.mesh.num_faces(), between = 0;
  for (const Interface& interface : scene.interfaces)
    between += std::int64_t{2} * interface.mesh.num_faces();
  for (const CellId c : mesh.cells.ids())
    for (const CellId next : facets.neighbours(c)) {
      if (!next.is_valid() && --open < 0) return fault(c, "has a facet open to nothing");
      if (next.is_valid() && mesh.region[next] != mesh.region[c] && --between < 0)
        return fault(c, "has another region than its neighbour, and no interface between");
    }
  return {};
}

/// The volume of each region is what its surfaces enclose: that of its container less what the
/// interfaces within it take away.
std::optional<Fault> find_wrong_volume(const TetMesh& mesh, const Scene& scene) {
  const auto num_regions = static_cast<std::int32_t>(scene.interfaces.size()) + 1;
  Field<RegionId, double> meshed(num_regions, 0.0), enclosed(num_regions, 0.0);
  for (const CellId c : mesh.cells.ids()) {
    const RegionId region = mesh.region[c];
    if (!region.is_valid() || region.value >= num_regions)
      return Fault{FaultKind::regions,
                   fmt::format("cell {} near {} has no region", c.value, text_of(middle(mesh, c))),
                   middle(mesh, c)};
    meshed[region] += signed_volume(mesh, c);
  }
  const double total = enclosed_volume(scene.boundary.mesh);
  enclosed[RegionId{0}] += total;
  for (const Interface& interface : scene.interfaces) {
    const double volume = enclosed_volume(interface.mesh);
    enclosed[interface.inside] += volume;
    enclosed[interface.outside] -= volume;
  }
  for (const RegionId region : enclosed.ids())
    // Sums over 1e5 cells of roundoff 1e-16 of their coordinates.
    if (!(std::abs(meshed[region] - enclosed[region]) <= 1e-12 * total))
      return Fault{FaultKind::wrong_volume,
                   fmt::format("region {} has volume {:.15g}, its surfaces enclose {:.15g}",
                               region.value, meshed[region], enclosed[region])};
  return {};
}

}  // namespace

std::optional<Fault> find_defect(const TetMesh& mesh, const Scene& scene) {
  // A table of facets needs cells of vertices that are there.
  if (auto fault = find_wrong_size(mesh, scene)) return fault;
  return find_defect(mesh, FacetTable(mesh), scene);
}

std::optional<Fault> find_defect(const TetMesh& mesh, const FacetTable& facets,
                                 const Scene& scene) {
  if (auto fault = find_wrong_size(mesh, scene)) return fault;
  const std::vector<SurfacePair> pairs = surface_pairs(mesh, scene);
  if (auto fault = find_moved_vertex(mesh, pairs)) return fault;
  if (auto fault = find_inverted_cell(mesh)) return fault;
  for (const SurfacePair& pair : pairs)
    if (auto fault = find_wrong_face(mesh, facets, pair)) return fault;
  if (auto fault = find_wrong_facet(mesh, facets, scene)) return fault;
  return find_wrong_volume(mesh, scene);
}

}  // namespace meniscus
