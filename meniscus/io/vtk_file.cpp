#include "meniscus/io/vtk_file.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "meniscus/core/error.hpp"
#include "meniscus/io/atomic_file.hpp"
#include "meniscus/io/vtk_grid.hpp"

namespace meniscus::io {
namespace {

namespace fs = std::filesystem;

vtkNew<vtkDoubleArray> to_vtk(const NamedArray& array) {
  MENISCUS_ASSERT(array.components > 0, "array {} has {} components", array.name, array.components);
  vtkNew<vtkDoubleArray> result;
  result->SetName(array.name.c_str());
  result->SetNumberOfComponents(array.components);
  result->SetNumberOfTuples(static_cast<vtkIdType>(array.values.size()) / array.components);
  std::ranges::copy(array.values, result->GetPointer(0));
  return result;
}

void add_arrays(vtkFieldData& fields, std::span<const NamedArray> arrays,
                [[maybe_unused]] vtkIdType num_elements) {
  for (const NamedArray& array : arrays) {
    MENISCUS_ASSERT(static_cast<vtkIdType>(array.values.size()) == num_elements * array.components,
                    "array {} has {} values for {} elements", array.name, array.values.size(),
                    num_elements);
    fields.AddArray(to_vtk(array));
  }
}

/// The field by which VTK's tools know the time of a file that stands alone.
void add_time(vtkDataObject& data, double t) {
  data.GetFieldData()->AddArray(to_vtk({.name = "TimeValue", .components = 1, .values = {t}}));
}

/// The bytes of the file, compressed; through a text in memory, because VTK's own files swallow
/// the errors of a full disk.
template <class Writer>
std::string to_xml(vtkDataObject& data) {
  vtkNew<Writer> writer;
  writer->SetInputData(&data);
  writer->SetCompressorTypeToZLib();
  writer->SetCompressionLevel(1);  // fastest; higher levels save some 1 % of a frame's bytes
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->WriteToOutputStringOn();
  if (writer->Write() != 1) throw RunFailure("VTK could not write a mesh");
  return writer->GetOutputString();
}

vtkNew<vtkPolyData> to_poly_data(std::span<const SurfaceMesh* const> surfaces,
                                 const MeshData& data) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> faces;
  faces->Use32BitStorage();  // ids of ours have 32 bits
  vtkIdType first = 0;
  for (const SurfaceMesh* surface : surfaces) {
    for (const Vec3& x : surface->x) points->InsertNextPoint(x.data());
    for (const FaceVertices& f : surface->faces) {
      faces->InsertNextCell({first + f[0].value, first + f[1].value, first + f[2].value});
    }
    first += surface->num_vertices();
  }
  vtkNew<vtkPolyData> poly;
  poly->SetPoints(points);
  poly->SetPolys(faces);
  add_arrays(*poly->GetPointData(), data.on_vertices, poly->GetNumberOfPoints());
  add_arrays(*poly->GetCellData(), data.on_cells, poly->GetNumberOfCells());
  return poly;
}

/// Values at the vertices, given to every corner of every cell.
NamedArray spread_to_corners(const TetMesh& mesh, const NamedArray& array) {
  MENISCUS_ASSERT(array.values.size() == static_cast<std::size_t>(mesh.num_vertices()) *
                                             static_cast<std::size_t>(array.components),
                  "array {} has {} values", array.name, array.values.size());
  NamedArray result{.name = array.name, .components = array.components, .values = {}};
  for (const CellVertices& cell : mesh.cells) {
    for (const TetVertexId v : cell) {
      const auto first = array.values.begin() + std::ptrdiff_t{v.value} * array.components;
      result.values.insert(result.values.end(), first, first + array.components);
    }
  }
  return result;
}

std::array<std::int32_t, 3> numbers(const FaceVertices& face, std::int32_t first) {
  return {first + face[0].value, first + face[1].value, first + face[2].value};
}

std::array<std::int32_t, 4> numbers(const CellVertices& cell) {
  return {cell[0].value, cell[1].value, cell[2].value, cell[3].value};
}

GridBuilder grid_of(std::span<const SurfaceMesh* const> surfaces, const CurvedEdges& curved) {
  std::size_t num_vertices = 0;
  for (const SurfaceMesh* surface : surfaces) num_vertices += surface->x.span().size();
  GridBuilder grid(curved, num_vertices);
  std::int32_t first = 0;
  for (const SurfaceMesh* surface : surfaces) {
    for (const Vec3& x : surface->x) grid.add_point(x);
    for (const FaceVertices& face : surface->faces) {
      const auto vertices = numbers(face, first);
      grid.add_cell(vertices, {vertices[0], vertices[1], vertices[2]});
    }
    first += surface->num_vertices();
  }
  return grid;
}

/// The cells; with corners of their own, point 4 c + k is corner k of cell c.
GridBuilder grid_of(const TetMesh& mesh, bool has_own_corners, const CurvedEdges& curved) {
  GridBuilder grid(curved, static_cast<std::size_t>(has_own_corners ? 4 * mesh.num_cells()
                                                                    : mesh.num_vertices()));
  if (!has_own_corners)
    for (const Vec3& x : mesh.x) grid.add_point(x);
  for (const CellId c : mesh.cells.ids()) {
    const auto vertices = numbers(mesh.cells[c]);
    std::array<vtkIdType, 4> corners{vertices[0], vertices[1], vertices[2], vertices[3]};
    if (has_own_corners) {
      for (const TetVertexId v : mesh.cells[c]) grid.add_point(mesh.x[v]);
      std::iota(corners.begin(), corners.end(), vtkIdType{4} * c.value);
    }
    grid.add_cell(vertices, corners);
  }
  return grid;
}

void write_grid(const fs::path& path, const GridBuilder& builder,
                std::span<const NamedArray> at_corner_points, std::span<const NamedArray> on_cells,
                double t) {
  const vtkNew<vtkUnstructuredGrid> grid = builder.grid();
  std::vector<NamedArray> at_points;
  for (const NamedArray& array : at_corner_points)
    at_points.push_back(builder.at_all_points(array));
  add_arrays(*grid->GetPointData(), at_points, grid->GetNumberOfPoints());
  add_arrays(*grid->GetCellData(), on_cells, grid->GetNumberOfCells());
  add_time(*grid, t);
  write_file(path, to_xml<vtkXMLUnstructuredGridWriter>(*grid));
}

}  // namespace

void write_vtp(const fs::path& path, std::span<const SurfaceMesh* const> surfaces,
               const MeshData& data, double t) {
  const vtkNew<vtkPolyData> poly = to_poly_data(surfaces, data);
  add_time(*poly, t);
  write_file(path, to_xml<vtkXMLPolyDataWriter>(*poly));
}

void write_surface_vtu(const fs::path& path, std::span<const SurfaceMesh* const> surfaces,
                       const MeshData& data, double t, const CurvedEdges& curved) {
  write_grid(path, grid_of(surfaces, curved), data.on_vertices, data.on_cells, t);
}

void write_vtu(const fs::path& path, const TetMesh& mesh, const MeshData& data, double t,
               std::span<const NamedArray> on_corners, const CurvedEdges& curved) {
  const bool has_own_corners = !on_corners.empty();
  std::vector<NamedArray> at_corner_points = data.on_vertices;
  if (has_own_corners) {
    for (NamedArray& array : at_corner_points) array = spread_to_corners(mesh, array);
    at_corner_points.insert(at_corner_points.end(), on_corners.begin(), on_corners.end());
  }
  write_grid(path, grid_of(mesh, has_own_corners, curved), at_corner_points, data.on_cells, t);
}

}  // namespace meniscus::io
