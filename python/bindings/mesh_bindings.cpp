#include <cmath>
#include <numbers>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "meniscus/case/words.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/io/surface_file.hpp"
#include "meniscus/io/table.hpp"
#include "meniscus/io/vtk_file.hpp"
#include "meniscus/mesh/surface_check.hpp"
#include "meniscus/solids/remesh_target.hpp"
#include "meniscus/solids/solid_check.hpp"
#include "meniscus/volume/tetrahedralize.hpp"
#include "python/bindings/arrays.hpp"

namespace meniscus::python {

SurfaceMesh surface_of(const py::array_t<double>& points, const py::array_t<std::int32_t>& faces) {
  SurfaceMesh mesh;
  const auto x = points.unchecked<2>();
  const auto f = faces.unchecked<2>();
  for (py::ssize_t i = 0; i < x.shape(0); ++i) mesh.x.add({x(i, 0), x(i, 1), x(i, 2)});
  for (py::ssize_t i = 0; i < f.shape(0); ++i)
    mesh.faces.add({VertexId{f(i, 0)}, VertexId{f(i, 1)}, VertexId{f(i, 2)}});
  return mesh;
}

namespace {

namespace fs = std::filesystem;

py::tuple arrays_of(SurfaceMesh mesh) {
  const auto kept = std::make_shared<const SurfaceMesh>(std::move(mesh));
  return py::make_tuple(points_view(kept, kept->x), corners_view(kept, kept->faces));
}

/// The faces as a file of them would be read: turned and, with `mends`, mended.
RepairedSurface repaired(const SurfaceMesh& given, bool mends) {
  PolygonSoup soup;
  soup.points.assign(given.x.begin(), given.x.end());
  for (const FaceVertices& face : given.faces) {
    for (const VertexId v : face) soup.corners.push_back(v.value);
    soup.end_face();
  }
  return meniscus::surface_of(soup, mends);
}

/// Remeshes to `value` vertices, of mean edge, or of chordal error, as `by` says; by nodes without
/// a value to as many as there are. Returns points, triangles and what was done and reached.
py::tuple remesh(const py::array_t<double>& points, const py::array_t<std::int32_t>& triangles,
                 const std::string& by, std::optional<double> value, double edge_floor,
                 double gradation, bool repair) {
  using By = RemeshTarget::By;
  RepairedSurface solid = repaired(surface_of(points, triangles), repair);
  SurfaceMesh& mesh = solid.mesh;
  if (const auto fault = find_solid_defect(mesh))
    reject_input("the surface: {}", text_of(*fault, solid.report));
  const RemeshTarget target{
      .by = by == "nodes"         ? By::nodes
            : by == "edge_length" ? By::edge_length
                                  : By::chordal_error,
      .value = value.value_or(std::max<double>(mesh.num_vertices(), RemeshTarget::kFewestNodes)),
      .edge_floor = edge_floor,
      .gradation = gradation};
  target.validate();
  TargetReport report;
  {
    const py::gil_scoped_release others_go_on;
    report = remesh_to(mesh, target);
  }
  if (!report.ok()) throw RunFailure("the surface could not be remeshed: " + report.text());
  const py::tuple arrays = arrays_of(std::move(mesh));
  py::dict facts;
  facts["repairs"] = text_of(solid.report);
  facts["reached"] = report.reached;
  facts["is_met"] = report.is_met;
  facts["passes"] = report.passes;
  facts["are_creases_rounded"] = report.are_creases_rounded;
  facts["are_creases_kept"] = report.are_creases_kept;
  return py::make_tuple(arrays[0], arrays[1], facts);
}

using Surface = std::pair<py::array_t<double>, py::array_t<std::int32_t>>;

SurfaceMesh sound_surface(const Surface& given, const std::string& name) {
  SurfaceMesh mesh = surface_of(given.first, given.second);
  if (const auto fault = find_defect(mesh)) reject_input("{}: {}", name, fault->text);
  return mesh;
}

/// The interfaces within the boundary, each with a liquid of its own.
Scene scene_of(const std::vector<Surface>& surfaces, const Surface& boundary) {
  Scene scene;
  scene.boundary.mesh = sound_surface(boundary, "boundary");
  scene.boundary.patch = FaceField<PatchId>(scene.boundary.mesh.num_faces(), PatchId{0});
  scene.boundary.patches.add({"boundary", NoPenetration{}});
  scene.liquids.add({});
  for (const Surface& surface : surfaces) {
    Interface interface;
    interface.drop = static_cast<int>(scene.interfaces.size());
    interface.mesh = sound_surface(surface, fmt::format("surfaces[{}]", interface.drop));
    interface.C0 = interface.mesh.num_vertices() / (4.0 * std::numbers::pi);
    scene.interfaces.push_back(std::move(interface));
    scene.liquids.add({});
  }
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (const auto fault = find_intersection(scene.interfaces[j].mesh, scene.interfaces[i].mesh))
        reject_input("surfaces[{}] and surfaces[{}]: {}", j, i, fault->text);
  assign_regions(scene);
  if (const auto fault = find_conflict(scene)) reject_input("surfaces: {}", fault->text);
  return scene;
}

py::tuple volume_mesh(const std::vector<Surface>& surfaces, const Surface& boundary,
                      const std::string& grading, const py::dict& numbers) {
  VolumeMeshOptions options;
  bool is_known = false;
  for (const auto& [word, meaning] : words::gradings)
    if (word == grading) {
      options.grading = meaning;
      is_known = true;
    }
  if (!is_known)
    reject_input("grading = \"{}\" must be one of {}", grading,
                 schema::quoted_list(words::list(words::gradings)));
  options.interior_growth = numbers["interior_growth"].cast<double>();
  options.radius_edge = numbers["radius_edge"].cast<double>();
  options.gap_layers = numbers["gap_layers"].cast<double>();
  options.cell_volume = numbers["cell_volume"].cast<double>();
  options.validate();
  const Scene scene = scene_of(surfaces, boundary);
  TetMesh mesh;
  VolumeMeshReport report;
  {
    const py::gil_scoped_release others_go_on;
    report = tetrahedralize(scene, options, mesh);
  }
  if (!report.ok()) throw RunFailure("the volume could not be meshed: " + report.text());
  const auto kept = std::make_shared<const TetMesh>(std::move(mesh));
  return py::make_tuple(points_view(kept, kept->x), corners_view(kept, kept->cells),
                        view(kept, kept->region.empty() ? nullptr : &kept->region.begin()->value,
                             {kept->region.size()}));
}

py::tuple read_surface_frame(const fs::path& file) {
  const auto kept = std::make_shared<const io::SurfaceFrame>(io::read_surface_frame(file));
  const auto vertices = static_cast<std::size_t>(kept->mesh.num_vertices()),
             faces = static_cast<std::size_t>(kept->mesh.num_faces());
  return py::make_tuple(
      points_view(kept, kept->mesh.x), corners_view(kept, kept->mesh.faces),
      arrays_view(kept, kept->data.on_vertices, 0, vertices),
      arrays_view(kept, kept->data.on_cells, 0, faces),
      view(kept, kept->middles.empty() ? nullptr : kept->middles.begin()->front().data(),
           {static_cast<py::ssize_t>(kept->middles.size()), 3, 3}));
}

py::tuple read_volume_frame(const fs::path& file) {
  const auto kept = std::make_shared<const io::VolumeFrame>(io::read_vtu(file));
  const std::size_t points = kept->points.size(), cells = kept->cells.size();
  return py::make_tuple(view(kept, points == 0 ? nullptr : kept->points.front().data(),
                             {static_cast<py::ssize_t>(points), 3}),
                        view(kept, cells == 0 ? nullptr : kept->cells.front().data(),
                             {static_cast<py::ssize_t>(cells), 4}),
                        arrays_view(kept, kept->data.on_vertices, 0, points),
                        arrays_view(kept, kept->data.on_cells, 0, cells));
}

py::tuple read_surface(const fs::path& file) { return arrays_of(io::read_surface(file).mesh); }

py::tuple read_table(const fs::path& file) {
  io::Table table = io::read_table(file);
  return py::make_tuple(std::move(table.columns), std::move(table.rows));
}

std::vector<std::pair<double, std::string>> read_frames(const fs::path& pvd) {
  std::vector<std::pair<double, std::string>> frames;
  for (const io::PvdEntry& entry : io::read_pvd(pvd)) frames.emplace_back(entry.t, entry.file);
  return frames;
}

}  // namespace

void bind_meshes(py::module_& m) {
  m.def("remesh", remesh, py::arg("points"), py::arg("triangles"), py::arg("by"), py::arg("value"),
        py::arg("edge_floor"), py::arg("gradation"), py::arg("repair"));
  m.def("volume_mesh", volume_mesh, py::arg("surfaces"), py::arg("boundary"), py::arg("grading"),
        py::arg("numbers"));
  m.def("read_surface", read_surface, py::arg("file"));
  m.def("read_surface_frame", read_surface_frame, py::arg("file"));
  m.def("read_volume_frame", read_volume_frame, py::arg("file"));
  m.def("read_table", read_table, py::arg("file"));
  m.def("read_frames", read_frames, py::arg("pvd"));
}

}  // namespace meniscus::python
