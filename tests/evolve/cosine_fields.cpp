#include "tests/evolve/cosine_fields.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "meniscus/mesh/surface_measures.hpp"

namespace meniscus::test {
namespace {

double cosine(const Vec3& x) { return 2.0 + std::cos(2.0 * x.x() + x.y() - 0.5 * x.z()); }

Vec3 center(const SurfaceMesh& mesh, FaceId f) {
  const FaceVertices& v = mesh.faces[f];
  return (mesh.x[v[0]] + mesh.x[v[1]] + mesh.x[v[2]]) / 3.0;
}

}  // namespace

SurfaceFields cosines(const SurfaceMesh& mesh) {
  VertexField<double> at_vertices;
  for (const Vec3& x : mesh.x) at_vertices.add(cosine(x));
  FaceField<double> on_faces;
  for (const FaceId f : mesh.faces.ids()) on_faces.add(cosine(center(mesh, f)));
  return {{{"gamma", "", FieldTransfer::conserved, at_vertices},
           {"label", "", FieldTransfer::interpolated, at_vertices}},
          {{"load", "", FieldTransfer::conserved, on_faces}}};
}

VolumeFields cosines(const TetMesh& mesh) {
  Field<TetVertexId, double> at_vertices;
  for (const Vec3& x : mesh.x) at_vertices.add(cosine(x));
  CellField<double> on_cells;
  for (const CellVertices& c : mesh.cells)
    on_cells.add(cosine(0.25 * (mesh.x[c[0]] + mesh.x[c[1]] + mesh.x[c[2]] + mesh.x[c[3]])));
  return {{{"temperature", "", FieldTransfer::interpolated, at_vertices}},
          {{"species", "", FieldTransfer::conserved, on_cells}}};
}

void put_cosines(Evolution& evolution) {
  std::vector<SurfaceFields> fields;
  for (const Interface& interface : evolution.scene().interfaces)
    fields.push_back(cosines(interface.mesh));
  evolution.set_interface_fields(std::move(fields));
  if (evolution.state().mesh)
    evolution.set_bulk_fields(cosines(evolution.state().mesh->tetrahedra()));
}

Amounts amounts(const State& state) {
  Amounts sum;
  for (const Interface& interface : state.scene.interfaces) {
    const VertexField<double> areas = vertex_areas(interface.mesh);
    const VertexField<double>& gamma = interface.fields.on_vertices[0].values;
    for (const VertexId v : areas.ids()) sum.on_vertices += areas[v] * gamma[v];
    const FaceField<double>& load = interface.fields.on_faces[0].values;
    for (const FaceId f : load.ids())
      sum.on_faces += face_area_vector(interface.mesh, f).norm() * load[f];
  }
  if (!state.mesh) return sum;
  const TetMesh& mesh = state.mesh->tetrahedra();
  const CellField<double>& species = state.mesh->fields().on_cells[0].values;
  sum.in_cells.assign(static_cast<std::size_t>(state.scene.liquids.size()), 0.0);
  for (const CellId c : mesh.cells.ids())
    sum.in_cells[static_cast<std::size_t>(mesh.region[c].value)] +=
        signed_volume(mesh, c) * species[c];
  return sum;
}

void expect_kept(const Amounts& now, const Amounts& before, double tolerance) {
  EXPECT_NEAR(now.on_vertices, before.on_vertices, tolerance * before.on_vertices);
  EXPECT_NEAR(now.on_faces, before.on_faces, tolerance * before.on_faces);
  ASSERT_EQ(now.in_cells.size(), before.in_cells.size());
  for (std::size_t r = 0; r < now.in_cells.size(); ++r)
    EXPECT_NEAR(now.in_cells[r], before.in_cells[r], tolerance * before.in_cells[r]) << r;
}

void step(Evolution& evolution) {
  ASSERT_TRUE(evolution.solve().ok());
  const Report report = evolution.advance();
  ASSERT_TRUE(report.ok()) << report.text();
}

}  // namespace meniscus::test
