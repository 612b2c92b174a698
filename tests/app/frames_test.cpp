#include "meniscus/app/frames.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "meniscus/case/case.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/io/vtk_file.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/report/mesh_cut.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/report/cut_area.hpp"

namespace meniscus {
namespace {

/// A case at its beginning.
Evolution solved(const std::string& text) {
  const Case c = parse_case(text, "case.toml");
  Evolution evolution(build_scene(c), c.evolution, make_flow_solver(c), make_moving_mesh(c));
  EXPECT_TRUE(evolution.prepare().ok());
  EXPECT_TRUE(evolution.solve().ok());
  return evolution;
}

const std::string kDrop = "[[drop]]\nradius = 1.0\nnodes = 110\n",
                  kBoundaryIntegrals =
                      "[domain]\nshape = \"unbounded\"\n"
                      "[solver]\nmethod = \"boundary-integral\"\n",
                  kWall = "[domain]\nshape = \"sphere\"\nradius = 4.0\n";

/// A drop at rest, or two of them; Ca is 1 where nothing flows.
Evolution at_rest(const std::string& more) {
  return solved("[flow]\nkind = \"quiescent\"\n" + kDrop + more);
}

Evolution in_shear(const std::string& more) {
  return solved("[flow]\nkind = \"simple-shear\"\ncapillary-number = 0.2\n" + kDrop + more);
}

io::SurfaceFrame resting_drop(const std::string& more) {
  const Evolution evolution = at_rest(more);
  const test::TemporaryFolder folder;
  return io::read_surface_frame(write_surface_frame(folder / "frame", evolution));
}

const io::NamedArray* find(const io::SurfaceFrame& frame, const std::string& name) {
  const auto found = std::ranges::find(frame.data.on_vertices, name, &io::NamedArray::name);
  return found == frame.data.on_vertices.end() ? nullptr : &*found;
}

/// Outer minus inner: −2/Ca for a sphere of radius 1 at rest. The balance of virtual work for a
/// uniform growth, Δp dV = σ dS, holds for the polyhedron as well: Δp = 2 S/(3 V), its own S and V.
TEST(SurfaceFrame, PressureJumpOfARestingDrop) {
  const io::SurfaceFrame frame = resting_drop(kWall);
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
  const io::SurfaceFrame frame = resting_drop(kBoundaryIntegrals);
  EXPECT_EQ(find(frame, "pressure_jump"), nullptr);
  EXPECT_NE(find(frame, "curvature"), nullptr);
  EXPECT_NE(find(frame, "normal_velocity"), nullptr);
}

const std::string kLinear = "[solver]\nelements = \"P1-P1\"\n";
const std::string kTwoDrops =
    "[[drop]]\nradius = 0.5\nnodes = 60\ncenter = [2.0, 0.0, 0.0]\n" + kWall;

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
  Evolution evolution = at_rest(kTwoDrops + kLinear);
  put_numbers(evolution);
  const test::TemporaryFolder folder;
  const std::filesystem::path file = write_surface_frame(folder / "frame", evolution);
  EXPECT_EQ(file.filename(), "frame.vtp");
  const vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  const SurfaceFields &a = evolution.scene().interfaces[0].fields,
                      &b = evolution.scene().interfaces[1].fields;
  expect_values(reader->GetOutput()->GetPointData()->GetArray("film"),
                values(a.on_vertices[0], b.on_vertices[0]));
  expect_values(reader->GetOutput()->GetCellData()->GetArray("coat"),
                values(a.on_faces[0], b.on_faces[0]));
}

// The two sides of an interface have points of their own there: the pressure jumps.
TEST(VolumeFrame, FieldsOpenInVtksOwnReader) {
  Evolution evolution = at_rest(kTwoDrops + kLinear);
  put_numbers(evolution);
  const test::TemporaryFolder folder;
  write_volume_frame(folder / "frame.vtu", evolution);
  const vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName((folder / "frame.vtu").c_str());
  reader->Update();
  const VolumeFields& fields = evolution.state().mesh->fields();
  const auto& dye = fields.on_cells[0].values;
  expect_values(reader->GetOutput()->GetCellData()->GetArray("dye"), {dye.begin(), dye.end()});
  const TetMesh& mesh = evolution.state().mesh->tetrahedra();
  const std::vector<double>& pressure = evolution.flow().bulk->corner_pressure;
  vtkUnstructuredGrid& grid = *reader->GetOutput();
  std::int32_t on_interfaces = 0;
  for (const Interface& interface : evolution.scene().interfaces)
    on_interfaces += interface.mesh.num_vertices();
  EXPECT_EQ(grid.GetNumberOfPoints(), mesh.num_vertices() + on_interfaces);
  for (const CellId c : mesh.cells.ids())
    for (int k = 0; k < 4; ++k) {
      const vtkIdType point = grid.GetCell(c.value)->GetPointId(k);
      EXPECT_EQ(grid.GetPointData()->GetArray("warmth")->GetComponent(point, 0),
                fields.on_vertices[0].values[mesh.cells[c][static_cast<std::size_t>(k)]]);
      EXPECT_EQ(grid.GetPointData()->GetArray("pressure")->GetComponent(point, 0),
                pressure[static_cast<std::size_t>(4 * c.value + k)]);
    }
}

TEST(VolumeFrame, CellsKnowTheirDrops) {
  const VolumeArrays arrays = volume_arrays(at_rest(kTwoDrops + kLinear));
  const auto values_of = [&](const char* name) {
    return std::ranges::find(arrays.data.on_cells, name, &io::NamedArray::name)->values;
  };
  const std::vector<double> region = values_of("region"), drop = values_of("drop");
  ASSERT_EQ(drop.size(), region.size());
  // Before any event ids are those of the case, as the order of interfaces is.
  for (std::size_t c = 0; c < drop.size(); ++c) EXPECT_EQ(drop[c], region[c] - 1.0) << c;
}

vtkSmartPointer<vtkUnstructuredGrid> grid_of(const std::filesystem::path& file) {
  const vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

std::map<int, int> count_types(vtkUnstructuredGrid& grid) {
  std::map<int, int> count;
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); ++c) ++count[grid.GetCellType(c)];
  return count;
}

/// The point and the value of an array's first component that VTK itself finds at a place of a
/// cell.
std::pair<Vec3, double> at_place(vtkUnstructuredGrid& grid, vtkIdType c, const char* array,
                                 double r, double s, double t) {
  vtkCell* cell = grid.GetCell(c);
  const double place[3] = {r, s, t};
  std::array<double, 10> weights{};
  Vec3 x = Vec3::Zero();
  int part = 0;
  cell->EvaluateLocation(part, place, x.data(), weights.data());
  double value = 0.0;
  for (int k = 0; k < cell->GetNumberOfPoints(); ++k)
    value += weights[static_cast<std::size_t>(k)] *
             grid.GetPointData()->GetArray(array)->GetComponent(cell->GetPointId(k), 0);
  return {x, value};
}

// A chord of these spheres, of edges up to 0.43 R0, lies up to 0.024 R0 below them.
TEST(SurfaceFrame, CurvedFacesAreQuadraticTriangles) {
  for (const std::string& method : {kWall, kBoundaryIntegrals}) {
    const Evolution evolution = in_shear(method);
    const test::TemporaryFolder folder;
    const std::filesystem::path file = write_surface_frame(folder / "frame", evolution);
    EXPECT_EQ(file.filename(), "frame.vtu");
    const vtkSmartPointer<vtkUnstructuredGrid> grid = grid_of(file);
    const int faces = evolution.scene().interfaces[0].mesh.num_faces();
    EXPECT_EQ(count_types(*grid), (std::map<int, int>{{VTK_QUADRATIC_TRIANGLE, faces}}));
    EXPECT_EQ(grid->GetNumberOfPoints(), faces / 2 + 2 + 3 * faces / 2);  // Euler's formula
    for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
      for (const auto& [r, s] : {std::pair(0.5, 0.0), {0.3, 0.7}, {1.0 / 3.0, 1.0 / 3.0}})
        EXPECT_NEAR(at_place(*grid, c, "velocity", r, s, 0.0).first.norm(), 1.0, 1e-3);
    const io::SurfaceFrame frame = io::read_surface_frame(file);
    EXPECT_EQ(frame.mesh, evolution.scene().interfaces[0].mesh);
    EXPECT_EQ(frame.data.on_vertices.size(), surface_arrays(evolution).on_vertices.size());
  }
}

// The drop's cells take its share of the section: those with flat faces lack 2.6 % of π.
TEST(VolumeFrame, CellsAtCurvedSurfacesAreQuadratic) {
  const Evolution evolution = in_shear(kWall);
  const test::TemporaryFolder folder;
  write_volume_frame(folder / "frame.vtu", evolution);
  const vtkSmartPointer<vtkUnstructuredGrid> grid = grid_of(folder / "frame.vtu");
  std::map<int, int> types = count_types(*grid);
  EXPECT_GT(types[VTK_TETRA], 0);
  EXPECT_GT(types[VTK_QUADRATIC_TETRA], 2 * evolution.scene().interfaces[0].mesh.num_faces());
  EXPECT_EQ(types.size(), 2U);
  const io::VolumeFrame frame = io::read_vtu(folder / "frame.vtu");
  int num_on_drop = 0, num_on_wall = 0;
  for (const auto& middles : frame.middles)
    for (const std::int32_t point : middles) {
      if (point < 0) continue;
      const double radius = frame.points[static_cast<std::size_t>(point)].norm();
      num_on_drop += std::abs(radius - 1.0) < 1e-3 ? 1 : 0;
      num_on_wall += std::abs(radius - 4.0) < 1e-12 ? 1 : 0;
    }
  EXPECT_GT(num_on_drop, 2 * evolution.scene().interfaces[0].mesh.num_faces());
  EXPECT_GT(num_on_wall, evolution.scene().boundary.mesh.num_faces());
  const report::MeshCut cut = report::cut_through_drops(frame, 2);
  double inside = 0.0;
  for (const report::CutPolygon& polygon : cut.polygons)
    if (polygon.region == 1) inside += test::area(cut, polygon);
  EXPECT_NEAR(inside, std::numbers::pi, 0.003 * std::numbers::pi);
  // The wall moves as given, v = (y, 0, 0).
  vtkDataArray* velocity = grid->GetPointData()->GetArray("velocity");
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
    if (const Vec3 x(grid->GetPoint(i)); std::abs(x.norm() - 4.0) < 1e-12) {
      EXPECT_NEAR(velocity->GetComponent(i, 0), x.y(), 1e-9);
    }
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
  Evolution evolution = at_rest(kWall);
  const test::TemporaryFolder folder;
  const std::filesystem::path of_surface = write_surface_frame(folder / "surface", evolution);
  write_volume_frame(folder / "frame.vtu", evolution);
  const SurfaceMesh& surface = evolution.scene().interfaces[0].mesh;
  for (const std::string& name : names(io::read_surface_frame(of_surface).data)) {
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
