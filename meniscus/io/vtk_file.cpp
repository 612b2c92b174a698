#include "meniscus/io/vtk_file.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

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

/// The points of a volume mesh's file. First come its vertices. A vertex whose corners have several
/// sets of values, such as pressures on two sides of an interface, has one more for each.
struct CornerPoints {
  std::vector<TetVertexId> vertex;      ///< of every point
  std::vector<std::size_t> corner;      ///< 4 c + k of one of its corners
  std::vector<std::int32_t> of_corner;  ///< the point of corner 4 c + k
};

bool has_same_values(std::span<const NamedArray> on_corners, std::size_t a, std::size_t b) {
  return std::ranges::all_of(on_corners, [&](const NamedArray& array) {
    const auto size = static_cast<std::size_t>(array.components);
    return std::equal(array.values.begin() + std::ptrdiff_t(size * a),
                      array.values.begin() + std::ptrdiff_t(size * (a + 1)),
                      array.values.begin() + std::ptrdiff_t(size * b));
  });
}

CornerPoints corner_points(const TetMesh& mesh, std::span<const NamedArray> on_corners) {
  constexpr std::int32_t kNone = -1;
  const auto vertices = mesh.x.ids();
  CornerPoints points{.vertex{vertices.begin(), vertices.end()}, .corner{}, .of_corner{}};
  std::vector<std::optional<std::size_t>> corner(points.vertex.size());
  std::vector<std::int32_t> next(points.vertex.size(), kNone);  // point of the same vertex
  for (const CellVertices& cell : mesh.cells)
    for (const TetVertexId v : cell) {
      const std::size_t own = points.of_corner.size();
      auto point = static_cast<std::size_t>(v.value);
      while (corner[point] && !has_same_values(on_corners, *corner[point], own)) {
        if (next[point] == kNone) {
          next[point] = static_cast<std::int32_t>(corner.size());
          points.vertex.push_back(v);
          corner.emplace_back();
          next.push_back(kNone);
        }
        point = static_cast<std::size_t>(next[point]);
      }
      if (!corner[point]) corner[point] = own;
      points.of_corner.push_back(static_cast<std::int32_t>(point));
    }
  for (const std::optional<std::size_t>& each : corner) points.corner.push_back(each.value_or(0));
  return points;
}

/// The values at points of an array on `num_elements` vertices or corners.
template <class ElementOfPoint>
NamedArray at_points(const NamedArray& array, std::size_t num_elements, std::size_t num_points,
                     const ElementOfPoint& element_of) {
  const auto size = static_cast<std::size_t>(array.components);
  MENISCUS_ASSERT(array.values.size() == num_elements * size, "array {} has {} values for {}",
                  array.name, array.values.size(), num_elements);
  NamedArray result{.name = array.name, .components = array.components, .values = {}};
  result.values.reserve(size * num_points);
  for (std::size_t point = 0; point < num_points; ++point) {
    const auto from = array.values.begin() + std::ptrdiff_t(size * element_of(point));
    result.values.insert(result.values.end(), from, from + array.components);
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

GridBuilder grid_of(const TetMesh& mesh, const CornerPoints& points, const CurvedEdges& curved) {
  GridBuilder grid(curved, points.vertex.size());
  for (const TetVertexId v : points.vertex) grid.add_point(mesh.x[v]);
  for (const CellId c : mesh.cells.ids()) {
    std::array<vtkIdType, 4> corners{};
    std::copy_n(points.of_corner.begin() + std::ptrdiff_t{4} * c.value, 4, corners.begin());
    grid.add_cell(numbers(mesh.cells[c]), corners);
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
  const CornerPoints points = corner_points(mesh, on_corners);
  const std::size_t num_points = points.vertex.size();
  std::vector<NamedArray> arrays;
  for (const NamedArray& array : data.on_vertices)
    arrays.push_back(at_points(array, mesh.x.span().size(), num_points, [&](std::size_t i) {
      return static_cast<std::size_t>(points.vertex[i].value);
    }));
  for (const NamedArray& array : on_corners)
    arrays.push_back(at_points(array, points.of_corner.size(), num_points,
                               [&](std::size_t i) { return points.corner[i]; }));
  write_grid(path, grid_of(mesh, points, curved), arrays, data.on_cells, t);
}

}  // namespace meniscus::io
