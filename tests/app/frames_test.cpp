#include "meniscus/app/frames.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "meniscus/case/case.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/io/vtk_file.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "tests/io/temporary_folder.hpp"

namespace meniscus {
namespace {

/// A drop at rest, or two of them; Ca is 1 where nothing flows.
Evolution at_rest(const std::string& more) {
  const Case c = parse_case(
      "[flow]\nkind = \"quiescent\"\n[[drop]]\nradius = 1.0\nnodes = 110\n" + more, "case.toml");
  Evolution evolution(build_scene(c), c.evolution, make_flow_solver(c), make_moving_mesh(c));
  EXPECT_TRUE(evolution.prepare().ok());
  EXPECT_TRUE(evolution.solve().ok());
  return evolution;
}

io::SurfaceFrame resting_drop(const std::string& more) {
  const Evolution evolution = at_rest(more);
  const test::TemporaryFolder folder;
  write_surface_frame(folder / "frame.vtp", evolution);
  return io::read_vtp(folder / "frame.vtp");
}

const io::NamedArray* find(const io::SurfaceFrame& frame, const std::string& name) {
  const auto found = std::ranges::find(frame.data.on_vertices, name, &io::NamedArray::name);
  return found == frame.data.on_vertices.end() ? nullptr : &*found;
}

/// Outer minus inner: −2/Ca for a sphere of radius 1 at rest. The balance of virtual work for a
/// uniform growth, Δp dV = σ dS, holds for the polyhedron as well: Δp = 2 S/(3 V), its own S and V.
TEST(SurfaceFrame, PressureJumpOfARestingDrop) {
  const io::SurfaceFrame frame = resting_drop("[domain]\nshape = \"sphere\"\nradius = 4.0\n");
  const io::NamedArray* jump = find(frame, "pressure_jump");
  ASSERT_NE(jump, nullptr);
  ASSERT_EQ(jump->values.size(), static_cast<std::size_t>(frame.mesh.num_vertices()));
  double mean = 0.0;
  for (const double value : jump->values) mean += value / static_cast<double>(jump->values.size());
  const double expected = -2.0 * surface_area(frame.mesh) / (3.0 * enclosed_volume(frame.mesh));
  EXPECT_NEAR(expected, -2.0, 0.04 * 2.0);  // chords of edges of 0.36 R0: S by h²/6 or so
  // The mesh is not quite even, so its curvatures scatter by some per cent: h² = 0.13 bounds that.
  EXPECT_NEAR(mean, expected, 0.03 * 2.0);
  for (const double value : jump->values) EXPECT_NEAR(value, expected, 0.13 * 2.0);
}

TEST(SurfaceFrame, BoundaryIntegralsHaveNoPressure) {
  const io::SurfaceFrame frame =
      resting_drop("[domain]\nshape = \"unbounded\"\n[solver]\nmethod = \"boundary-integral\"\n");
  EXPECT_EQ(find(frame, "pressure_jump"), nullptr);
  EXPECT_NE(find(frame, "curvature"), nullptr);
  EXPECT_NE(find(frame, "normal_velocity"), nullptr);
}

const std::string kTwoDrops =
    "[[drop]]\nradius = 0.5\nnodes = 60\ncenter = [2.0, 0.0, 0.0]\n"
    "[domain]\nshape = \"sphere\"\nradius = 4.0\n";

template <class IdType>
CarriedField<IdType> numbered(const std::string& name, std::int32_t size, double first) {
  CarriedField<IdType> field{name, "", FieldTransfer::conserved, Field<IdType, double>(size)};
  for (const IdType id : field.values.ids()) field.values[id] = first + 1.0 / (1.0 + id.value);
  return field;
}

void put_numbers(Evolution& evolution) {
  std::vector<SurfaceFields> fields;
  for (const Interface& interface : evolution.scene().interfaces)
    fields.push_back(
        {{numbered<VertexId>("film", interface.mesh.num_vertices(), interface.drop)},
         {numbered<FaceId>("coat", interface.mesh.num_faces(), 10.0 * interface.drop)}});
  evolution.set_interface_fields(std::move(fields));
  const TetMesh& mesh = evolution.state().mesh->tetrahedra();
  VolumeFields bulk{{numbered<TetVertexId>("warmth", mesh.num_vertices(), 3.0)},
                    {numbered<CellId>("dye", mesh.num_cells(), -2.0)}};
  bulk.on_vertices[0].transfer = FieldTransfer::interpolated;
  evolution.set_bulk_fields(std::move(bulk));
}

/// The values of the fields of both drops, one after the other.
std::vector<double> values(const auto& first, const auto& second) {
  std::vector<double> all(first.values.begin(), first.values.end());
  all.insert(all.end(), second.values.begin(), second.values.end());
  return all;
}

void expect_values(vtkDataArray* array, const std::vector<double>& expected) {
  ASSERT_NE(array, nullptr);
  ASSERT_EQ(array->GetNumberOfComponents(), 1);
  ASSERT_EQ(array->GetNumberOfTuples(), static_cast<vtkIdType>(expected.size()));
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_EQ(array->GetTuple1(static_cast<vtkIdType>(i)), expected[i]) << i;
}

TEST(SurfaceFrame, FieldsOpenInVtksOwnReader) {
  Evolution evolution = at_rest(kTwoDrops);
  put_numbers(evolution);
  const test::TemporaryFolder folder;
  write_surface_frame(folder / "frame.vtp", evolution);
  const vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((folder / "frame.vtp").c_str());
  reader->Update();
  const SurfaceFields &a = evolution.scene().interfaces[0].fields,
                      &b = evolution.scene().interfaces[1].fields;
  expect_values(reader->GetOutput()->GetPointData()->GetArray("film"),
                values(a.on_vertices[0], b.on_vertices[0]));
  expect_values(reader->GetOutput()->GetCellData()->GetArray("coat"),
                values(a.on_faces[0], b.on_faces[0]));
}

// Points are corners of cells there: the pressure jumps.
TEST(VolumeFrame, FieldsOpenInVtksOwnReader) {
  Evolution evolution = at_rest(kTwoDrops);
  put_numbers(evolution);
  const test::TemporaryFolder folder;
  write_volume_frame(folder / "frame.vtu", evolution);
  const vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((folder / "frame.vtu").c_str());
  reader->Update();
  const VolumeFields& fields = evolution.state().mesh->fields();
  const auto& dye = fields.on_cells[0].values;
  expect_values(reader->GetOutput()->GetCellData()->GetArray("dye"), {dye.begin(), dye.end()});
  std::vector<double> at_corners;
  for (const CellVertices& cell : evolution.state().mesh->tetrahedra().cells)
    for (const TetVertexId v : cell) at_corners.push_back(fields.on_vertices[0].values[v]);
  expect_values(reader->GetOutput()->GetPointData()->GetArray("warmth"), at_corners);
}

/// Expects a field to be refused by its name.
void expect_taken(const Evolution& evolution, const std::string& name) {
  try {
    check_field_names(evolution);
    FAIL() << "\"" << name << "\" is accepted";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("field \"" + name + "\""), std::string::npos)
        << error.what();
  }
}

std::vector<std::string> names(const io::MeshData& data) {
  std::vector<std::string> all;
  for (const auto* arrays : {&data.on_vertices, &data.on_cells})
    for (const io::NamedArray& array : *arrays) all.push_back(array.name);
  return all;
}

// The names are those that a frame without fields has: the list cannot lag behind.
TEST(Frames, RefuseFieldsNamedLikeTheirOwnArrays) {
  Evolution evolution = at_rest("[domain]\nshape = \"sphere\"\nradius = 4.0\n");
  const test::TemporaryFolder folder;
  write_surface_frame(folder / "frame.vtp", evolution);
  write_volume_frame(folder / "frame.vtu", evolution);
  const SurfaceMesh& surface = evolution.scene().interfaces[0].mesh;
  for (const std::string& name : names(io::read_vtp(folder / "frame.vtp").data)) {
    evolution.set_interface_fields({{{}, {numbered<FaceId>(name, surface.num_faces(), 0.0)}}});
    expect_taken(evolution, name);
    evolution.set_interface_fields({{{numbered<VertexId>(name, surface.num_vertices(), 0.0)}, {}}});
    expect_taken(evolution, name);
  }
  evolution.set_interface_fields({SurfaceFields()});
  for (const std::string& name : names(io::read_vtu(folder / "frame.vtu").data)) {
    evolution.set_bulk_fields(
        {{}, {numbered<CellId>(name, evolution.state().mesh->tetrahedra().num_cells(), 0.0)}});
    expect_taken(evolution, name);
  }
  evolution.set_bulk_fields({});
  put_numbers(evolution);
  EXPECT_NO_THROW(check_field_names(evolution));
}

}  // namespace
}  // namespace meniscus
