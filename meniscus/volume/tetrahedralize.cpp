#include "meniscus/volume/tetrahedralize.hpp"

#include <functional>
#include <vector>

#include <fmt/format.h>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/volume/facets.hpp"
#include "meniscus/volume/foreseen_cells.hpp"
#include "meniscus/volume/mesh_order.hpp"
#include "meniscus/volume/size_law.hpp"
#include "meniscus/volume/smooth_cells.hpp"
#include "meniscus/volume/tetgen_mesher.hpp"
#include "meniscus/volume/vertices_to_keep.hpp"

namespace meniscus {
namespace {

SurfaceComplex gather_surfaces(const Scene& scene) {
  SurfaceComplex complex;
  const auto append = [&](const SurfaceMesh& surface) {
    const auto first = static_cast<std::int32_t>(complex.x.size());
    complex.x.insert(complex.x.end(), surface.x.begin(), surface.x.end());
    for (const FaceVertices& f : surface.faces)
      complex.triangles.push_back({first + f[0].value, first + f[1].value, first + f[2].value});
  };
  for (const Interface& interface : scene.interfaces) append(interface.mesh);
  append(scene.boundary.mesh);
  return complex;
}

/// Names each surface's vertices and the cells on both sides of each of its faces, up to a face
/// that is no facet.
std::optional<Fault> embed(const SurfaceMesh& surface, std::int32_t first_vertex,
                           const FacetTable& facets, bool has_outside, EmbeddedSurface& embedded) {
  embedded = {{first_vertex},
              surface.num_vertices(),
              FaceField<EmbeddedSurface::Sides>(surface.num_faces())};
  for (const FaceId f : surface.faces.ids()) {
    const FaceVertices& v = surface.faces[f];
    const FacetVertices vertices{embedded.vertex(v[0]), embedded.vertex(v[1]),
                                 embedded.vertex(v[2])};
    embedded.sides[f] = {facets.find(vertices), facets.find_across(vertices)};
    const auto& [inside, outside] = embedded.sides[f];
    if (!inside.is_valid() || outside.is_valid() != has_outside) {
      const Vec3& x = surface.x[v[0]];
      return Fault{FaultKind::nonconforming,
                   fmt::format("the mesher lost the face {} near {}", f.value, text_of(x)), x};
    }
  }
  return {};
}

std::optional<Fault> embed_surfaces(const Scene& scene, const FacetTable& facets, TetMesh& mesh) {
  std::int32_t first = 0;
  mesh.interfaces.resize(scene.interfaces.size());
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
    const SurfaceMesh& surface = scene.interfaces[i].mesh;
    if (auto lost = embed(surface, first, facets, true, mesh.interfaces[i])) return lost;
    first += surface.num_vertices();
  }
  return embed(scene.boundary.mesh, first, facets, false, mesh.boundary);
}

/// Gives the cells next to each interface their regions and lets these spread across every facet
/// that has no region on its other side yet. Interfaces need no special care: both of their sides
/// are labelled before anything spreads.
void label_regions(const Scene& scene, const FacetTable& facets, TetMesh& mesh) {
  MENISCUS_ASSERT(mesh.interfaces.size() == scene.interfaces.size(), "{} {}",
                  mesh.interfaces.size(), scene.interfaces.size());
  mesh.region = CellField<RegionId>(mesh.num_cells());
  std::vector<CellId> front;
  const auto label = [&](CellId c, RegionId region) {
    if (mesh.region[c].is_valid()) return;
    mesh.region[c] = region;
    front.push_back(c);
  };
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i)
    for (const EmbeddedSurface::Sides& sides : mesh.interfaces[i].sides) {
      label(sides.inside, scene.interfaces[i].inside);
      label(sides.outside, scene.interfaces[i].outside);
    }
  for (const EmbeddedSurface::Sides& sides : mesh.boundary.sides) label(sides.inside, RegionId{0});
  while (!front.empty()) {
    const CellId c = front.back();
    front.pop_back();
    for (const CellId next : facets.neighbours(c))
      if (next.is_valid()) label(next, mesh.region[c]);
  }
}

/// One attempt: mesh, find the surfaces in it, label the regions, smooth, validate.
std::optional<Fault> try_to_mesh(const Scene& scene, const SurfaceComplex& complex,
                                 const std::string& switches, const CellTarget& target,
                                 bool curves_interfaces, TetMesh& mesh) {
  MesherResult result = run_tetgen(complex, switches, target);
  if (!result.failure.empty()) return Fault{FaultKind::mesher, std::move(result.failure)};
  order_by_neighbourhood(static_cast<std::int32_t>(complex.x.size()), result.x, result.cells);
  mesh = {};
  mesh.x = std::move(result.x);
  mesh.cells = std::move(result.cells);
  MENISCUS_ASSERT(mesh.num_vertices() >= static_cast<std::int32_t>(complex.x.size()), "{} {}",
                  mesh.num_vertices(), complex.x.size());
  const FacetTable facets(mesh);
  if (auto lost = embed_surfaces(scene, facets, mesh)) return lost;
  label_regions(scene, facets, mesh);
  if (curves_interfaces) smooth_cells(mesh);
  return find_defect(mesh, facets, scene);
}

std::optional<Fault> find_unfit_surface(const Scene& scene) {
  if (scene.is_unbounded) return Fault{FaultKind::regions, "an unbounded scene has no volume mesh"};
  if (auto fault = find_conflict(scene)) return fault;
  for (const Interface& interface : scene.interfaces)
    if (auto fault = find_self_intersection(interface.mesh))
      return with_context(fmt::format("drop {}", interface.drop), *std::move(fault));
  return {};
}

}  // namespace

void VolumeMeshOptions::validate() const {
  if (!(interior_growth >= 0.0 && interior_growth <= 10.0))
    reject_input("interior_growth = {} must lie between 0 and 10", interior_growth);
  // Below √2 Delaunay refinement has no guarantee to end; in practice it does from 1.1 on.
  if (!(radius_edge >= 1.1 && radius_edge <= 10.0))
    reject_input("radius_edge = {} must lie between 1.1 and 10", radius_edge);
  if (!(gap_layers >= 0.0 && gap_layers <= 100.0))
    reject_input("gap_layers = {} must lie between 0 and 100", gap_layers);
  if (!(cell_volume >= 0.1 && cell_volume <= 100.0))
    reject_input("cell_volume = {} must lie between 0.1 and 100", cell_volume);
}

VolumeMeshReport tetrahedralize(const Scene& scene, const VolumeMeshOptions& options,
                                TetMesh& mesh) {
  return tetrahedralize(scene, options, {}, mesh);
}

VolumeMeshReport tetrahedralize(const Scene& scene, const VolumeMeshOptions& options,
                                const TetMesh& before, TetMesh& mesh) {
  options.validate();
  VolumeMeshReport report;
  report.fault = find_unfit_surface(scene);
  if (!report.ok()) return report;
  const SizeLaw law(scene, options);
  const std::function<double(const Vec3&)> size = std::cref(law);
  const ForeseenCells foreseen = foresee_cells(scene, size, options.cell_volume);
  if (foreseen.is_too_many()) {
    report.fault = Fault{FaultKind::too_large, too_many(foreseen)};
    return report;
  }

  const SurfaceComplex complex = gather_surfaces(scene);
  CellTarget target{size, options.cell_volume, foreseen.number, law.at_surface_vertices(),
                    vertices_to_keep(before, law)};
  const std::vector<std::string> all_switches = tetgen_switches(options.radius_edge);
  TetMesh candidate;
  if (!target.vertices.empty()) {
    report.fault = try_to_mesh(scene, complex, all_switches.front(), target,
                               options.curves_interfaces, candidate);
    if (report.ok()) mesh = std::move(candidate);
    if (report.ok()) return report;
    target.vertices.clear();
  }
  for (const std::string& switches : all_switches) {
    report.fault =
        try_to_mesh(scene, complex, switches, target, options.curves_interfaces, candidate);
    if (report.ok()) {
      mesh = std::move(candidate);
      return report;
    }
    ++report.attempt;
  }
  return report;
}

}  // namespace meniscus
